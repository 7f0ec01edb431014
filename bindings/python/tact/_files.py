"""Meshes and series from files: by the program's readers, else by meshio."""

import importlib.util
import os
import pathlib
import re
import xml.etree.ElementTree

import numpy as np

from . import _tact
from ._progress import progress_over

OWN = (".obj", ".off", ".ply", ".stl", ".vtp", ".vtk")
EVERY = 2**31 - 1


class Mesh:
    """A surface as a file gives it."""

    __slots__ = ("name", "positions", "facets", "vertices")

    def __init__(self, name, positions, facets, vertices=None):
        self.name, self.positions, self.facets = name, positions, facets
        self.vertices = np.arange(len(positions), dtype=np.int32) if vertices is None else vertices

    def __repr__(self):
        return f"<tact.Mesh {self.name}: {len(self.positions)} vertices, {len(self.facets)} facets>"


class MeshSequence:
    """A surface that moves, a frame at a time. Iterate over its meshes."""

    __slots__ = ("name", "positions", "facets", "vertices", "times", "files")

    def __init__(self, name, positions, facets, vertices=None, times=(), files=()):
        self.name, self.positions, self.facets = name, list(positions), facets
        if not self.positions:
            raise ValueError(f"{name}: it has no frames")
        self.vertices = np.arange(len(self.positions[0]), dtype=np.int32) if vertices is None else vertices
        self.times, self.files = list(times), list(files)

    def __len__(self):
        return len(self.positions)

    def __getitem__(self, frame):
        return Mesh(self.name, self.positions[frame], self.facets, self.vertices)

    def __repr__(self):
        return f"<tact.MeshSequence {self.name}: {len(self)} frames of {len(self.positions[0])} vertices, {len(self.facets)} facets>"


def read(path, *, displacement=None):
    """A surface from a file. Cells that have a volume give their surface: `vertices` has the number of each vertex in the file.

    The program's readers take .obj, .off, .ply, .stl, .vtp and .vtk; meshio, where it is installed, takes .vtu, .xdmf and
    whatever else it knows. `displacement` names point data to add to the positions. Errors: ValueError, with the file and
    the place in it; OSError; ImportError, where meshio is wanted and missing.
    """
    bodies = read_sequence(path, frames=1, displacement=displacement, progress=False)
    if len(bodies) != 1:
        names = ", ".join(body.name for body in bodies)
        raise ValueError(f"{os.fspath(path)}: it holds several bodies, which tact.read_sequence() gives: {names}")
    return bodies[0][0]


def read_sequence(*paths, frames=None, displacement=None, progress=True):
    """The bodies of files, folders and series as a list, each with the positions of all its frames.

    A folder is one body: its mesh files in the order of their names. A collection (.pvd) gives its parts and, where its
    files tell, their bodies; an .xdmf file its steps. `frames`: the first so many. All frames of a body have the facets of
    the first. Errors as of read().
    """
    most = _most(frames)
    for path in paths:
        os.stat(path)
    if displacement is None and all(_is_own(path) for path in paths):
        return [_sequence_of(body) for body in _read_own(paths, most, progress)]
    bodies = []
    for path in paths:
        if displacement is None and _is_own(path):
            bodies += [_sequence_of(body) for body in _read_own([path], most, progress)]
        else:
            bodies += _read_by_meshio(path, most, displacement, progress)
    _make_names_differ(bodies)
    return bodies


def _most(frames):
    if frames is not None and frames < 1:
        raise ValueError(f"frames is {frames}, not at least 1")
    return EVERY if frames is None else frames


def _sequence_of(body):
    return MeshSequence(body.name, body.positions, body.facets, body.vertices, body.times, body.files)


def _read_own(paths, most, progress):
    with progress_over(None, "reading", "file", progress) as line:

        def tell(done, all):
            line.total = all
            line.update(done - line.n)

        return _tact._read_bodies(list(paths), most, tell)


def _make_names_differ(bodies):
    taken, last = set(), {}
    for body in bodies:
        name = body.name
        number = last.get(name, 1)
        while body.name in taken:
            number += 1
            body.name = f"{name}#{number}"
        last[name] = number
        taken.add(body.name)


def _is_own(path):
    """Whether the program's readers are to take it."""
    path = pathlib.Path(path)
    if path.is_dir():
        return not _meshio_files(path) or any(one.suffix.lower() in OWN for one in path.iterdir())
    if path.suffix.lower() == ".pvd":
        return all(pathlib.Path(file).suffix.lower() in OWN for _, _, file in _collection(path))
    if path.suffix.lower() == ".vtk":
        return not _is_grid(path) or importlib.util.find_spec("meshio") is None
    return path.suffix.lower() in OWN


def _is_grid(path):
    """Whether a legacy file of VTK may have cells with a volume."""
    with open(path, "rb") as file:
        return re.search(rb"DATASET\s+POLYDATA", file.read(4096), re.IGNORECASE) is None


def _meshio_files(folder):
    number = lambda name: [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]
    files = [one for one in folder.iterdir() if one.is_file() and not one.name.startswith(".") and one.suffix.lower() in (".vtu", ".xdmf", ".msh", ".vtk", ".med", ".exo", ".e", ".inp", ".bdf", ".mesh")]
    return sorted(files, key=lambda one: number(one.name))


def _collection(path):
    """[(part, time, file)] of a .pvd file, by time."""
    try:
        tree = xml.etree.ElementTree.parse(path)
    except xml.etree.ElementTree.ParseError as error:
        raise ValueError(f"{path}: {error}") from None
    entries = []
    for entry in tree.iter("DataSet"):
        if "file" not in entry.attrib:
            raise ValueError(f"{path}: a DataSet names no file")
        try:
            time = float(entry.get("timestep", 0))
        except ValueError:
            raise ValueError(f"{path}: the timestep is {entry.get('timestep')!r}, not a number") from None
        entries.append((entry.get("part", "0"), time, entry.get("file")))
    if not entries:
        raise ValueError(f"{path}: the collection names no file")
    return sorted(entries, key=lambda entry: entry[1])


def _read_by_meshio(path, most, displacement, progress):
    try:
        import meshio
    except ImportError:
        ending = pathlib.Path(path).suffix or "this folder"
        raise ImportError(f"{os.fspath(path)}: {ending} is read by meshio, which is not here (Debian: python3-meshio)") from None
    path = pathlib.Path(path)
    if path.is_dir():
        return [_frames_by_meshio(path.name, _meshio_files(path)[:most], [], displacement, progress)]
    if path.suffix.lower() == ".pvd":
        entries, bodies = _collection(path), []
        for part in dict.fromkeys(entry[0] for entry in entries):
            of_part = [entry for entry in entries if entry[0] == part][:most]
            files, times = [path.parent / entry[2] for entry in of_part], [entry[1] for entry in of_part]
            bodies.append(_frames_by_meshio(path.name, files, times, displacement, progress))
        return bodies
    if path.suffix.lower() in (".xdmf", ".xmf"):
        series = _xdmf_series(meshio, path, most, displacement)
        if series is not None:
            return [series]
    return [_frames_by_meshio(path.name, [path], [], displacement, False)]


def _read_one(path):
    import meshio

    try:
        return meshio.read(path)
    except (SystemExit, Exception) as error:  # meshio leaves the program where it knows no reader
        if isinstance(error, OSError):
            raise
        reason = "it knows no reader for it" if isinstance(error, SystemExit) else error
        raise ValueError(f"{path}: meshio cannot read it: {reason}") from None


def _frames_by_meshio(name, files, times, displacement, progress):
    positions, facets, vertices, cells = [], None, None, None
    for path in progress_over(files, "reading", "file", progress):
        mesh = _read_one(path)
        points = _moved(mesh.points, mesh.point_data, displacement, path)
        if facets is None:
            cells = mesh.cells
            facets, vertices = _surface(points, cells, path)
            count = len(points)
        elif not _same_cells(cells, mesh.cells) or len(points) != count:
            raise ValueError(f"{path}: other cells than in the first frame, {files[0]}")
        positions.append(points[vertices])
    return MeshSequence(name, positions, facets, vertices, times, [str(path) for path in files])


def _same_cells(first, second):
    return len(first) == len(second) and all(a.type == b.type and np.array_equal(a.data, b.data) for a, b in zip(first, second))


def _xdmf_series(meshio, path, most, displacement):
    """The steps of an .xdmf file; None if it is no series."""
    try:
        with meshio.xdmf.TimeSeriesReader(path) as reader:
            points, cells = reader.read_points_cells()
            steps = [reader.read_data(step) for step in range(min(reader.num_steps, most))]
    except (meshio.ReadError, KeyError, AttributeError):
        return None
    if not steps:
        return None
    facets, vertices = _surface(_moved(points, {}, None, path), cells, path)
    positions = [_moved(points, data, displacement, path)[vertices] for _, data, _ in steps]
    return MeshSequence(path.name, positions, facets, vertices, [float(step[0]) for step in steps], [str(path)] * len(steps))


def _moved(points, data, displacement, path):
    points = np.asarray(points, float)
    if points.ndim != 2 or points.shape[1] > 3:
        raise ValueError(f"{path}: points of the shape {points.shape}")
    points = np.pad(points, ((0, 0), (0, 3 - points.shape[1])))
    if displacement is None:
        return points
    if displacement not in data:
        raise ValueError(f"{path}: no point data are called {displacement!r}; there are: {', '.join(data) or 'none'}")
    moves = np.asarray(data[displacement], float).reshape(len(points), -1)
    if moves.shape[1] not in (2, 3):
        raise ValueError(f"{path}: {displacement!r} has {moves.shape[1]} components, not 2 or 3")
    return points + np.pad(moves, ((0, 0), (0, 3 - moves.shape[1])))


# The corners of cells, whatever their order: what else they have are points on their edges and faces.
FLAT = {"triangle": 3, "quad": 4}
FACES = {
    "tetra": ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)),
    "pyramid": ((0, 1, 2, 3), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    "wedge": ((0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    "hexahedron": ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
}


def _surface(points, cells, path):
    """The facets of the surface, and the vertices that it keeps."""
    if not np.isfinite(points).all():
        vertex = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise ValueError(f"{path}: vertex {vertex} is not finite")
    for block in cells:
        corners = np.asarray(block.data)
        if corners.dtype != object and corners.size and not 0 <= corners.min() <= corners.max() < len(points):
            wrong = corners.min() if corners.min() < 0 else corners.max()
            raise ValueError(f"{path}: a {block.type} names vertex {wrong} of {len(points)}")
    outer = _boundary(points, cells)
    if outer:
        used = np.unique(np.concatenate([face.ravel() for face in outer]))
        number = np.full(len(points), -1, np.int32)
        number[used] = np.arange(len(used), dtype=np.int32)
        return _triangles(path, points[used], [number[face] for face in outer]), used.astype(np.int32)
    flat = []
    for block in cells:
        kind = block.type.rstrip("0123456789")
        if kind == "polygon" or kind in FLAT:
            flat.append(np.asarray(block.data)[:, : FLAT.get(kind)])
    if not flat:
        kinds = ", ".join(sorted({block.type for block in cells})) or "none"
        raise ValueError(f"{path}: no cells with a surface; its cells are: {kinds}")
    return _triangles(path, points, flat), np.arange(len(points), dtype=np.int32)


def _triangles(path, points, polygons):
    if all(faces.shape[1] == 3 for faces in polygons):
        return np.ascontiguousarray(np.concatenate(polygons), np.int32)
    sizes = np.concatenate([np.full(len(faces), faces.shape[1], np.int32) for faces in polygons])
    corners = np.concatenate([np.ascontiguousarray(faces, np.int32).ravel() for faces in polygons])
    return _tact._split_polygons(str(path), points, sizes, corners)


def _boundary(points, cells):
    """Faces of one cell alone, seen counter-clockwise from outside: arrays of triangles and of quadrilaterals."""
    found = {3: [], 4: []}
    for block in cells:
        faces = FACES.get(block.type.rstrip("0123456789"))
        if faces is None:
            continue
        data = np.asarray(block.data)
        corners = 1 + max(max(face) for face in faces)
        middle = points[data[:, :corners]].mean(axis=1)
        for face in faces:
            found[len(face)].append(_outward(points, data[:, face], middle))
    outer = []
    for size, parts in found.items():
        if parts:
            faces = np.concatenate(parts)
            _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
            outer.append(faces[np.sort(first[count == 1])])
    return [faces for faces in outer if len(faces)]


def _outward(points, faces, middle):
    corners = points[faces]
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, -1] - corners[:, 1]) if faces.shape[1] == 4 else np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = ((corners.mean(axis=1) - middle) * across).sum(axis=1) < 0
    return np.where(inward[:, None], faces[:, ::-1], faces)
