"""tact.mpi: the stubs name what the module has, and the example answers the same on one rank and on two."""

import ast
import json
import os
import pathlib
import shutil
import subprocess
import sys

import pytest
import tact

pytest.importorskip("mpi4py")
PACKAGE = pathlib.Path(tact.__file__).parent
if not list(PACKAGE.glob("_tact_mpi*")):
    pytest.skip("tact was built without MPI", allow_module_level=True)
if shutil.which("mpirun") is None:
    pytest.skip("mpirun is missing", allow_module_level=True)

ROOT = pathlib.Path(__file__).resolve().parents[2]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def run(ranks, *program):
    command = ["mpirun", "--oversubscribe", "-n", str(ranks), sys.executable, *program]
    done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_example_prints_the_same_on_any_number_of_ranks():
    example = str(ROOT / "examples/python/ranks.py")
    one = run(1, example)
    assert one.count("hash") == 4
    assert run(2, example) == one


def test_exceptions_of_a_callback_end_the_call_on_all_ranks():
    program = """
from mpi4py import MPI
import sys, tact, tact.mpi
world = tact.mpi.World(MPI.COMM_WORLD)
world.add_body([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], key=world.rank, surface=tact.Surface.sheet)
def pack(key): raise ValueError("no bytes for you")
world.set_body_state(pack, lambda key, data: None, lambda key: None)
if world.rank == 0: world.set_owner(0, 1)
try: world.move_bodies()
except RuntimeError as error: sys.stdout.write(f"{'no bytes for you' in str(error)} {world.bodies == [world.rank]}\\n")
"""
    assert run(2, "-c", program).split() == ["True"] * 4


def test_excluded_labels_of_two_ranks():
    program = """
from mpi4py import MPI
import sys, tact, tact.mpi
world = tact.mpi.World(MPI.COMM_WORLD)
corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
if world.rank == 1: corners = [[0.2, 0.2, -1], [0.2, 0.2, 1], [0.2, 1, 0]]
world.add_body(corners, [[0, 1, 2]], key=world.rank, surface=tact.Surface.sheet)
world.set_feature_settings(world.rank, facet_labels=[4])
found = [any(contact.touching for contact in world.detect().contacts)]
for excluded in [True, False]:
    if world.rank == 0: world.set_excluded_labels(0, 4, 1, 4, excluded)
    found.append(any(contact.touching for contact in world.detect().contacts))
sys.stdout.write(f"{found == [True, False, True]}\\n")
"""
    assert run(2, "-c", program).split() == ["True"] * 2


def test_poses_as_arrays():
    program = """
from mpi4py import MPI
import numpy, sys, tact, tact.mpi
world = tact.mpi.World(MPI.COMM_WORLD)
corners, keys = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [2 * world.rank, 2 * world.rank + 1]
for key in keys:
    world.add_body(corners, [[0, 1, 2]], key=key, surface=tact.Surface.sheet, motion=tact.Motion.rigid)
turn, moves = numpy.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), numpy.array([[0, 0, 1], [0, 2, 0]])
world.set_poses(keys, numpy.array([turn, numpy.eye(3)]), moves)
same = [(world.positions(keys[0]) == corners @ turn.T + moves[0]).all(), (world.positions(keys[1]) == corners + moves[1]).all()]
try: world.set_poses(keys, numpy.array([turn]), moves)
except ValueError as error: same.append("rotations" in str(error))
sys.stdout.write(f"{len(same) == 3 and all(same)}\\n")
"""
    assert run(2, "-c", program).split() == ["True"] * 2


def names_in(body):
    return {node.name for node in body if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name[0] != "_"}


def test_stubs_name_what_the_module_has():
    program = """
import json, tact.mpi
public = lambda of: [name for name in dir(of) if name[0] != "_"]
print(json.dumps({name: public(getattr(tact.mpi, name)) for name in public(tact.mpi)}))
"""
    found = json.loads(run(1, "-c", program))  # in a process of its own, as MPI starts once in each
    stubs = ast.parse((PACKAGE / "mpi.pyi").read_text())
    classes = {node.name: node for node in stubs.body if isinstance(node, ast.ClassDef)}
    assert {name for name in classes if name[0] != "_"} == set(found)
    for name, members in found.items():
        stub = names_in(classes[name].body)
        for base in classes[name].bases:
            stub |= names_in(classes[base.id].body)
        stub |= {node.target.id for node in classes[name].body if isinstance(node, ast.AnnAssign)}
        assert stub == set(members) | ({"name", "value"} if name == "Partitioner" else set()), name
