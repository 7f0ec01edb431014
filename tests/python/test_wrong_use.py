"""Wrong use is a clear exception, and the world is as it was."""

import subprocess
import sys

import numpy as np
import pytest
import tact
from shapes import tetrahedron

POSITIONS, FACETS = tetrahedron()


@pytest.fixture
def world():
    return tact.World()


@pytest.mark.parametrize(
    "given, exception, says",
    [
        ([[0, 0, 0]], TypeError, "list"),
        (POSITIONS.astype(int), TypeError, "int64"),
        (POSITIONS.T, ValueError, "transpose"),
        (POSITIONS.ravel(), ValueError, r"\(12,\)"),
        (np.asfortranarray(POSITIONS), ValueError, "ascontiguousarray"),
        (POSITIONS[::-1], ValueError, "ascontiguousarray"),
        (POSITIONS.astype(">f8"), TypeError, ">f8"),
        (POSITIONS * np.nan, tact.Error, "vertex 0 has x"),
        (POSITIONS[:3], tact.Error, "3 positions"),
    ],
)
def test_bad_positions_are_refused(world, given, exception, says):
    body = world.add_body(POSITIONS, FACETS)
    other = world.add_body(POSITIONS + [0.5, 0, 0], FACETS)
    before = world.detect().hash()
    with pytest.raises(exception, match=says):
        world.set_positions(body, given)
    with pytest.raises(exception, match=says):
        world.set_positions({other: POSITIONS, body: given})
    assert world.detect().hash() == before


@pytest.mark.parametrize(
    "given, exception, says",
    [
        (FACETS.astype(float), TypeError, "float64"),
        (FACETS[:, :2], ValueError, r"\(4, 2\)"),
        (FACETS.astype(np.int64) + 2**40, ValueError, "facet 0 names vertex"),
        (FACETS + 100, tact.Error, "facet 0 names vertex"),
        (-FACETS, tact.Error, "facet 0 names vertex"),
    ],
)
def test_bad_facets_are_refused(world, given, exception, says):
    with pytest.raises(exception, match=says):
        world.add_body(POSITIONS, given)
    assert len(world) == 0


def test_integers_of_every_width_are_taken(world):
    for numbers in (np.int8, np.uint8, np.uint16, np.int64, np.uint64):
        world.add_body(POSITIONS, FACETS.astype(numbers))
    assert len(world) == 5


def test_errors_have_a_code(world):
    body = world.add_body(POSITIONS, FACETS)
    world.remove_body(body)
    with pytest.raises(tact.Error) as raised:
        world.name(body)
    assert raised.value.code == tact.ErrorCode.stale_body
    with pytest.raises(tact.Error) as raised:
        tact.World().name(tact.World().add_body(POSITIONS, FACETS))
    assert raised.value.code == tact.ErrorCode.foreign_body
    with pytest.raises(tact.Error) as raised:
        tact.World(tact.Settings(threads=-1))
    assert raised.value.code == tact.ErrorCode.bad_settings


def test_a_report_kept_over_a_step_says_so(world):
    world.add_body(POSITIONS, FACETS)
    world.add_body(POSITIONS + [0.5, 0, 0], FACETS)
    report = world.detect()
    contact = report.contacts[0]
    world.detect()
    for use in (lambda: report.contacts, lambda: contact.depth, lambda: contact.facet_pairs, lambda: repr(contact), lambda: len(report)):
        with pytest.raises(tact.StaleReportError, match="earlier step"):
            use()
    report = world.detect()
    world.set_settings(tact.Settings())
    with pytest.raises(tact.StaleReportError):
        report.hash()


def test_a_report_keeps_its_world_alive():
    world = tact.World()
    for x in (0.0, 0.5):
        world.add_body(*tetrahedron(x))
    report = world.detect()
    del world
    assert report.contacts[0].depth > 0


def test_an_array_may_change_or_go_after_it_was_given(world):
    positions = POSITIONS.copy()
    world.add_body(positions, FACETS)
    other = POSITIONS + [0.5, 0, 0]
    world.add_body(other, FACETS)
    before = world.detect().hash()
    positions[:] = np.nan
    del positions, other
    assert world.detect().hash() == before


def test_the_interpreter_ends_with_worlds_alive():
    program = (
        "import numpy as np, tact, threading\n"
        "world = tact.World(tact.Settings(threads=2))\n"
        "facets = np.array([[0, 1, 2]])\n"
        "for k in range(50): world.add_body(np.random.default_rng(k).random((3, 3)), facets, surface=tact.Surface.sheet)\n"
        "report = world.detect()\n"
        "kept = [contact.facet_pairs for contact in report.contacts], report.contacts\n"
        "threading.Thread(target=lambda: [world.detect() for k in range(1000)], daemon=True).start()\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
