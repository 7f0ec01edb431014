"""Meshes and series from files, tact.check() beside the program, and what notebooks show."""

import json
import os
import subprocess

import numpy as np
import pytest
import tact

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
FACETS = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def write_obj(path, places, facets=FACETS):
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in places.tolist()] + [f"f {a} {b} {c}" for a, b, c in (facets + 1).tolist()]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture
def moving(tmp_path):
    """A tetrahedron that stands, and one that moves into it."""
    write_obj(tmp_path / "still.obj", CORNERS)
    for frame in range(4):
        write_obj(tmp_path / "mover" / f"f_{frame}.obj", CORNERS + [1.3 - 0.3 * frame, 0.1, 0.1])
    return tmp_path


def without_times(text):
    whole = json.loads(text)
    for frame in whole["frames"]:
        del frame["times_ms"]
    return whole


def test_check_finds_what_the_program_finds(moving):
    paths = [moving / "still.obj", moving / "mover"]
    result = tact.check(*paths, margins={"mover": 0.05}, selves="still", points=True, impacts=True, threads=2, json=True)
    program = os.environ.get("TACT_PROGRAM")
    if program:
        options = ["--margin", "mover=0.05", "--self", "still", "--points", "--impacts", "--threads", "2", "--json", "-"]
        printed = subprocess.run([program, "check", *paths, *options], capture_output=True, text=True, check=True).stdout
        assert without_times(result.json) == without_times(printed)
    frames = without_times(result.json)["frames"]
    assert [frame["hash"] for frame in frames] == [frame.hash for frame in result.frames]
    assert result.crossing_frames == [2, 3]
    last = result[3]
    assert last.facet_pairs.facets.tolist() == frames[3]["pairs"][0]["facet_pairs"]
    assert last.points.gaps.tolist() == [point["gap"] for point in frames[3]["pairs"][0]["points"]]
    assert last.least_gap == last.points.gaps.min() < 0
    assert sum(len(frame.impacts) for frame in result.frames[1:]) == sum(len(frame["impacts"]) for frame in frames[1:]) > 0
    assert np.flatnonzero(last.crossing(1)).tolist() == sorted({b for _, b in frames[3]["pairs"][0]["facet_pairs"]})
    assert last.gaps(0).min() == last.least_gap and np.isinf(result[0].gaps(0)).all()


def test_series_are_read_as_the_program_writes_them(moving):
    program = os.environ.get("TACT_PROGRAM")
    if not program:
        pytest.skip("the program is not here")
    found = moving / "found"
    options = ["--margin", "0.05", "--points", "--vtk", found]
    subprocess.run([program, "check", moving / "still.obj", moving / "mover", *options], check=True, stdout=subprocess.DEVNULL)
    series = tact.read_sequence(found / "check.pvd")
    assert [one.name for one in series] == ["check.pvd:0", "check.pvd:1"]
    assert series[0].times == [0.0, 1.0, 2.0, 3.0]
    assert np.array_equal(series[1].positions[3], CORNERS + [1.3 - 0.3 * 3, 0.1, 0.1])
    again = tact.check(found / "check.pvd", margins=0.05, points=True)
    direct = tact.check(moving / "still.obj", moving / "mover", margins=0.05, points=True)
    assert [frame.hash for frame in again.frames] == [frame.hash for frame in direct.frames]
    assert [frame.time for frame in again.frames] == [0.0, 1.0, 2.0, 3.0]
    with pytest.raises(ValueError, match="several bodies.*check.pvd:0, check.pvd:1"):
        tact.read(found / "check.pvd")


def test_arrays_are_checked_as_files_are(moving):
    mover = tact.MeshSequence("mover", [CORNERS + [1.3 - 0.3 * frame, 0.1, 0.1] for frame in range(4)], FACETS)
    result = tact.check(tact.Mesh("still", CORNERS, FACETS), mover, margins=0.05)
    files = tact.check(moving / "still.obj", moving / "mover", margins=0.05)
    assert [frame.hash for frame in result.frames] == [frame.hash for frame in files.frames]
    with pytest.raises(ValueError, match="frame 1: body 'bad': vertex 0 .*finite"):
        tact.check(tact.MeshSequence("bad", [CORNERS, np.full((4, 3), np.nan)], FACETS))
    with pytest.raises(ValueError, match="same number"):
        tact.check(mover, tact.MeshSequence("short", [CORNERS, CORNERS], FACETS))


def test_trouble_names_file_line_and_body(moving):
    with pytest.raises(FileNotFoundError):
        tact.read(moving / "none.obj")
    (moving / "bad.obj").write_text("v 0 0 0\nv 1 x 0\n")
    with pytest.raises(ValueError, match=r"bad.obj:2: vertex 1: expected a number"):
        tact.read(moving / "bad.obj")
    with pytest.raises(ValueError, match="sheets cloth: no body has this name; the bodies are: still.obj"):
        tact.check(moving / "still.obj", sheets="cloth")
    with pytest.raises(ValueError, match="at least"):
        tact.check()


def test_check_loses_no_file(moving):
    still = moving / "still.obj"
    before = still.read_bytes()
    for option in ("json", "record"):
        with pytest.raises(ValueError, match=f"{option}: .*still.obj is read, and would be lost"):
            tact.check(still, **{option: still})
    with pytest.raises(ValueError, match="json and record: both would be"):
        tact.check(still, json=moving / "out", record=f"{moving}/./out")
    with pytest.raises(FileNotFoundError):
        tact.check(still, moving / "mover", json=moving / "no" / "out.json")
    assert still.read_bytes() == before and not (moving / "out").exists()
    result = tact.check(still, json=moving / "out.json")
    assert (moving / "out.json").read_text() == result.json
    assert sorted(path.name for path in moving.iterdir()) == ["mover", "out.json", "still.obj"]


def test_sequences_that_do_not_fit_are_refused():
    cases = [
        (lambda: tact.MeshSequence("x", [], FACETS), "x: it has no frames"),
        (lambda: tact.check(tact.MeshSequence("x", [CORNERS, CORNERS], FACETS, files=["a"])), "x: 1 files for 2 frames"),
        (lambda: tact.check(tact.MeshSequence("x", [CORNERS] * 3, FACETS, times=[0, 1])), "x: 2 times for 3 frames"),
        (lambda: tact.check(tact.Mesh("x", CORNERS, FACETS, np.arange(3))), "x: vertices has 3 numbers for 4 vertices"),
        (lambda: tact.check(tact.Mesh("x", CORNERS, FACETS), frames=0), "frames is 0"),
        (lambda: tact.check(tact.Mesh("x", CORNERS, FACETS), accuracy="foo"), "accuracy is 'foo', not one of: .*exact"),
    ]
    for call, says in cases:
        with pytest.raises(ValueError, match=says):
            call()


def test_bodies_keep_the_numbers_of_their_vertices(moving):
    of_part = tact.Mesh("part", CORNERS, FACETS, np.array([7, 3, 5, 1], dtype=np.int32))
    assert tact.check(of_part).bodies[0].vertices.tolist() == [7, 3, 5, 1]
    twice = tact.Mesh("twice", np.concatenate([CORNERS, CORNERS]), np.concatenate([FACETS[:2], FACETS[2:] + 4]), np.arange(8) + 10)
    assert tact.check(twice, weld=True).bodies[0].vertices.tolist() == [10, 11, 12, 13]
    points = "0 0 0 5 0 0 1 0 0 0 1 0 6 0 0 5 1 0"
    (moving / "two.vtp").write_text(f"""<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="6" NumberOfPolys="2"><PointData><DataArray type="Int32" Name="body" format="ascii">0 1 0 0 1 1</DataArray>
</PointData><Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">{points}</DataArray></Points><Polys>
<DataArray type="Int32" Name="connectivity" format="ascii">0 2 3 1 4 5</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6</DataArray></Polys></Piece></PolyData></VTKFile>""")
    assert [body.vertices.tolist() for body in tact.read_sequence(moving / "two.vtp")] == [[0, 2, 3], [1, 4, 5]]


def test_bodies_are_counted_from_the_end_as_in_lists(moving):
    frame = tact.check(moving / "still.obj", moving / "mover", margins=0.05, points=True)[3]
    assert frame.crossing(-1).tolist() == frame.crossing(1).tolist() and frame.crossing(1).any()
    assert frame.gaps(-2).tolist() == frame.gaps(0).tolist()
    with pytest.raises(IndexError):
        frame.gaps(-3)


def test_names_may_be_any_bytes(tmp_path):
    path = os.path.join(os.fsencode(tmp_path), b"\xff\xfe.obj")
    with open(path, "wb") as file:
        file.write(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    mesh = tact.read(os.fsdecode(path))
    assert os.fsencode(mesh.name) == b"\xff\xfe.obj"
    result = tact.check(mesh, sheets=mesh.name)
    assert result.world.name(result.ids[0]) == mesh.name
    with open(path, "ab") as file:
        file.write(b"f 1 2 9\n")
    with pytest.raises(ValueError, match=r"\\xff\\xfe.obj:5"):
        tact.read(os.fsdecode(path))


def test_cells_with_a_volume_give_their_surface(tmp_path):
    meshio = pytest.importorskip("meshio")
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)] + [[9, 9, 9]], float)
    cube = [[0, 1, 3, 2, 4, 5, 7, 6]]
    tetrahedra = [[0, 1, 3, 5], [0, 3, 2, 6], [0, 5, 4, 6], [3, 5, 6, 7], [0, 5, 3, 6]]  # turned either way
    for kind, cells in (("hexahedron", cube), ("tetra", tetrahedra)):
        meshio.Mesh(corners, [(kind, np.array(cells))]).write(tmp_path / f"{kind}.vtu")
        mesh = tact.read(tmp_path / f"{kind}.vtu")
        assert len(mesh.facets) == 12 and mesh.vertices.tolist() == list(range(8))
        places = mesh.positions[mesh.facets]
        volume = np.linalg.det(places).sum() / 6
        assert volume == pytest.approx(1.0)
        world = tact.World()
        assert world.check_surface(world.add_body(mesh.positions, mesh.facets)).is_solid()
    meshio.Mesh(corners, [("line", np.array([[0, 1]]))]).write(tmp_path / "line.vtu")
    with pytest.raises(ValueError, match="line.vtu: no cells with a surface; its cells are: line"):
        tact.read(tmp_path / "line.vtu")


def test_series_of_meshio_move(tmp_path):
    meshio = pytest.importorskip("meshio")
    cells = [("triangle", FACETS)]
    entries = ""
    for frame in range(3):
        meshio.Mesh(CORNERS + [0.5 * frame, 0, 0], cells, point_data={"u": np.ones((4, 3)), "t": np.ones(4)}).write(tmp_path / f"f{frame}.vtu")
        entries += f'<DataSet timestep="{0.1 * frame}" file="f{frame}.vtu"/>'
    (tmp_path / "run.pvd").write_text(f'<VTKFile type="Collection"><Collection>{entries}</Collection></VTKFile>')
    (series,) = tact.read_sequence(tmp_path / "run.pvd")
    assert len(series) == 3 and series.times == [0.0, 0.1, 0.2]
    assert np.array_equal(series.positions[2], CORNERS + [1.0, 0, 0])
    assert np.array_equal(tact.read(tmp_path / "f1.vtu", displacement="u").positions, CORNERS + [1.5, 1, 1])
    with pytest.raises(ValueError, match="f1.vtu: 't' has 1 components, not 2 or 3"):
        tact.read(tmp_path / "f1.vtu", displacement="t")
    meshio.Mesh(CORNERS, [("triangle", FACETS + 5)]).write(tmp_path / "wrong.vtu")
    with pytest.raises(ValueError, match="wrong.vtu: a triangle names vertex 8 of 4"):
        tact.read(tmp_path / "wrong.vtu")
    with meshio.xdmf.TimeSeriesWriter(tmp_path / "steps.xdmf", data_format="XML") as writer:
        writer.write_points_cells(CORNERS, cells)
        for step in range(3):
            writer.write_data(0.5 * step, point_data={"u": np.full((4, 3), float(step))})
    (series,) = tact.read_sequence(tmp_path / "steps.xdmf", displacement="u")
    assert series.times == [0.0, 0.5, 1.0] and np.array_equal(series.positions[2], CORNERS + 2.0)


def test_pages_show_a_world_and_a_recording(moving):
    result = tact.check(moving / "still.obj", moving / "mover", points=True, margins=0.05, record=moving / "run.tactrec")
    before = result.world.save()
    page = tact.view(result.world, title="two & two")
    assert result.world.save() == before
    assert page.html.startswith("<!") and "two & two" in page.html
    cell = page._repr_html_()
    assert cell.startswith("<iframe sandbox") and "<script" not in cell
    played = tact.view(moving / "run.tactrec", stop=2)
    assert '"steps":3' in played.html
    page.save(moving / "page.html")
    assert (moving / "page.html").read_text() == page.html
    with pytest.raises(ValueError, match="still.obj: byte 0: not a recording"):
        tact.view(moving / "still.obj")


def test_wrong_steps_of_a_page_are_refused(moving):
    tact.check(moving / "still.obj", moving / "mover", record=moving / "run.rec")
    for options, says in [({"every": 0}, "every is 0"), ({"start": -1}, "start is -1"), ({"start": 2, "stop": 1}, "stop is 1, before start, 2")]:
        with pytest.raises(ValueError, match=says):
            tact.view(moving / "run.rec", **options)
    with pytest.raises(TypeError, match="for recordings"):
        tact.view(tact.World(), points=True)
    with pytest.raises(FileNotFoundError):
        tact.RecordingPlayer(moving / "nope")
    with pytest.raises(FileNotFoundError):
        tact.World().record(str(moving / "no" / "x"))


def test_notebooks_show_tables(moving):
    result = tact.check(moving / "still.obj", moving / "mover", points=True, margins=0.05)
    report = result.world.detect()
    for shown in (result, result[3], report, report.contacts[0]):
        assert shown._repr_html_().startswith("<table>")
    assert "<td>still.obj" not in result._repr_html_() and "still.obj, mover" in result._repr_html_()
