"""The filter over series of ours and of meshio: what it finds is what the program finds. Run by pvpython."""

import json
import pathlib
import subprocess
import sys
import tempfile
import os

import numpy as np
from paraview import simple
from vtkmodules.util import numpy_support

HERE = pathlib.Path(__file__).resolve()
PROGRAM = os.environ["TACT_PROGRAM"]


def ball(around=16, across=8, radius=0.5):
    turn, tilt = np.meshgrid(2 * np.pi * np.arange(around) / around, np.pi * np.arange(1, across) / across)
    ring = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], -1).reshape(-1, 3)
    top, bottom = len(ring), len(ring) + 1
    a = np.arange((across - 2) * around)
    b = a - a % around + (a + 1) % around
    first = np.arange(around)
    last = first + (across - 2) * around
    next = (first + 1) % around
    facets = [np.stack([a, a + around, b], 1), np.stack([b, a + around, b + around], 1), np.stack([np.full(around, top), first, next], 1), np.stack([np.full(around, bottom), last - first + next, last], 1)]
    return radius * np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]]), np.concatenate(facets)


def write_obj(path, places, facets):
    path.parent.mkdir(exist_ok=True)
    path.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in places.tolist()) + "".join(f"f {a} {b} {c}\n" for a, b, c in (facets + 1).tolist()))


def checked(*words):
    printed = subprocess.run([PROGRAM, "check", *map(str, words), "--json", "-"], capture_output=True, text=True, check=True).stdout
    return json.loads(printed)


def fields(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    return array.GetValue(0)


def column(attributes, name):
    return numpy_support.vtk_to_numpy(attributes.GetArray(name))


def compare(filter, times, frames):
    """Steps in order, each beside the program's frame."""
    for number, (time, frame) in enumerate(zip(times, frames)):
        filter.UpdatePipeline(time)
        points = filter.GetClientSideObject().GetOutputDataObject(0)
        surfaces = filter.GetClientSideObject().GetOutputDataObject(1)
        assert fields(points, "tact_hash") == frame["hash"], number
        assert fields(points, "tact_carried") == (number > 0)
        gaps = [point["gap"] for pair in frame["pairs"] for point in pair["points"]]
        assert column(points.GetPointData(), "gap").tolist() == gaps
        normals = [point["normal"] for pair in frame["pairs"] for point in pair["points"]]
        assert column(points.GetPointData(), "normal").tolist() == normals
        patches = [int(pair["patches"][point["patch"]]["id"], 16) for pair in frame["pairs"] for point in pair["points"]]
        assert column(points.GetPointData(), "patch").tolist() == patches
        assert fields(points, "tact_facet_pairs") == sum(len(pair["facet_pairs"]) for pair in frame["pairs"])
        crossing = sum(int(column(surfaces.GetBlock(block).GetCellData(), "tact_crossing").sum()) for block in range(surfaces.GetNumberOfBlocks()))
        assert crossing == len({(pair["ab"[side]], facets[side]) for pair in frame["pairs"] for facets in pair["facet_pairs"] for side in range(2)})
        least = np.concatenate([column(surfaces.GetBlock(block).GetPointData(), "tact_gap") for block in range(surfaces.GetNumberOfBlocks())])
        assert (np.nanmin(least) if gaps else None) == (min(gaps) if gaps else None)
        if "impacts" in frame:
            assert fields(points, "tact_impacts") == len(frame["impacts"])


def a_series_of_ours(folder):
    places, facets = ball()
    write_obj(folder / "still.obj", places, facets)
    for frame in range(6):
        write_obj(folder / "mover" / f"f_{frame}.obj", places + [1.1 - 0.1 * frame, 0.1, 0.05], facets)
    first = checked(folder / "still.obj", folder / "mover", "--margin", "0.05", "--points", "--impacts", "--vtk", folder / "ours")
    reader = simple.PVDReader(FileName=str(folder / "ours" / "check.pvd"))
    filter = simple.TactContacts(Input=[reader], Margin=0.05, Impacts=1)
    times = list(reader.TimestepValues)
    compare(filter, times, first["frames"])
    assert [fields(filter.GetClientSideObject().GetOutputDataObject(0), "tact_bodies")] == ["input 0:0"]
    # Jumped: what meets is the same, nothing is carried on, and the filter says so.
    filter.UpdatePipeline(times[2])
    points = filter.GetClientSideObject().GetOutputDataObject(0)
    assert fields(points, "tact_carried") == 0
    gaps = [point["gap"] for pair in first["frames"][2]["pairs"] for point in pair["points"]]
    assert column(points.GetPointData(), "gap").tolist() == gaps
    filter.UpdatePipeline(times[3])
    assert fields(filter.GetClientSideObject().GetOutputDataObject(0), "tact_carried") == 1


def a_series_by_meshio(folder):
    import meshio

    places, facets = ball()
    for frame in range(5):
        meshio.Mesh(places + [0.9 - 0.1 * frame, 0.1, 0.05], [("triangle", facets)]).write(folder / f"by_{frame}.vtu")
        write_obj(folder / "by" / f"f_{frame}.obj", places + [0.9 - 0.1 * frame, 0.1, 0.05], facets)
    frames = checked(folder / "still.obj", folder / "by", "--sheet", "still", "--margin", "by=0.03", "--points")["frames"]
    meshio.Mesh(places, [("triangle", facets)]).write(folder / "still.vtu")
    still = simple.XMLUnstructuredGridReader(FileName=[str(folder / "still.vtu")])
    moving = simple.XMLUnstructuredGridReader(FileName=[str(folder / f"by_{frame}.vtu") for frame in range(5)])
    filter = simple.TactContacts(Input=[moving, still], Bodies="input 0: margin 0.03\ninput 1: sheet")
    swapped = checked(folder / "by", folder / "still.obj", "--sheet", "still", "--margin", "by=0.03", "--points")["frames"]
    assert [len(frame["pairs"]) for frame in swapped] == [len(frame["pairs"]) for frame in frames]
    compare(filter, list(moving.TimestepValues), swapped)


def main():
    simple.LoadPlugin(str(HERE.parents[2] / "bindings/paraview/tact_paraview.xml"), ns=vars(simple))
    with tempfile.TemporaryDirectory() as folder:
        a_series_of_ours(pathlib.Path(folder))
        a_series_by_meshio(pathlib.Path(folder))
    print("the filter finds what the program finds")


main()
sys.stdout.flush()
