"""The surfaces that Blender shows, as tact takes them: evaluated meshes in world space."""

import ctypes
from dataclasses import dataclass

import numpy as np

KINDS = {"MESH", "CURVE", "SURFACE", "META", "FONT"}


@dataclass
class ShownSurface:
    """A surface of one frame."""

    name: str
    key: tuple  # of the user's own object, which holds the settings
    positions: np.ndarray  # (V, 3) float64, metres, in world space
    facets: np.ndarray  # (F, 3) int32: Blender's own triangles of the first frame, counter-clockwise seen from outside
    polygons: np.ndarray  # (F,) int32: the face that each is a part of
    matrix: np.ndarray  # (4, 4): from the mesh to the world
    is_instance: bool

    @property
    def object(self):
        """The user's object, or None if it is gone."""
        return object_of(self.key)

    def fits(self, mesh):
        """Whether vertices and faces are those of a mesh of the user's, so that what is found can be told there."""
        faces = int(self.polygons.max()) + 1 if len(self.polygons) else 0
        return not self.is_instance and len(mesh.vertices) == len(self.positions) and len(mesh.polygons) == faces


def key_of(object):
    """What names an object for longer than Blender keeps it where it is: undo moves it."""
    return object.name, object.library.filepath if object.library is not None else None


def object_of(key):
    """The object that is named, or None."""
    import bpy

    try:
        return bpy.data.objects[key]
    except KeyError:
        return None


def shown_surfaces(depsgraph, objects, kept):
    """The surfaces of objects, and of what they are instancers of, in the order of the objects; and what is left out.

    `kept` holds the triangles of every object: they stay while its faces are the same, as Blender cuts a quad otherwise where it
    bends, and a step that is to be carried on, or a motion, needs the same facets.
    """
    place = {object: i for i, object in enumerate(objects)}
    found, told, meshes = [], [], {}
    for instance in depsgraph.object_instances:
        chosen = instance.parent.original if instance.is_instance else instance.object.original
        if chosen not in place or instance.object.type not in KINDS or not instance.show_self:
            continue
        original = instance.object.original
        mesh = _mesh_of(instance.object, meshes, kept)
        name = f"{original.name} of {chosen.name}" if instance.is_instance else original.name
        key = (place[chosen], instance.is_instance, original.name, tuple(instance.persistent_id))
        if len(mesh[1]):
            found.append((key, _surface(name, original, mesh, instance)))
        else:
            told.append(f"{name} has no faces")
    found.sort(key=lambda one: one[0])
    surfaces = [surface for _, surface in found]
    _number_names(surfaces)
    seen = {chosen for chosen, *_ in (key for key, _ in found)}
    for object, i in place.items():
        if i not in seen and not any(text.startswith(object.name + " ") for text in told):
            told.append(f"{object.name} {'is hidden' if object.type in KINDS else 'has no surface'}")
    return surfaces, told


def _mesh_of(object, meshes, kept):
    """Vertices in the object's space, triangles and their faces, once for objects that share an evaluated mesh."""
    key = object.data.as_pointer() if object.type == "MESH" else None
    if key in meshes:
        return meshes[key]
    mesh = object.to_mesh()
    try:
        corners = _numbers(mesh.vertices, "co", 3, np.float32)
        triangles = _triangles_of(mesh, kept.setdefault(key_of(object.original), []))
    finally:
        object.to_mesh_clear()
    made = corners, *triangles
    if key is not None:
        meshes[key] = made
    return made


@dataclass
class _KnownFaces:
    """Faces and their triangles, and the bytes in which Blender held them: equal bytes are the same faces."""

    faces: tuple
    triangles: tuple
    held: tuple


def _triangles_of(mesh, known):
    """Triangles and the face of each, of the first time that the mesh had these faces."""
    held = _bytes_of(mesh.polygons), _bytes_of(mesh.loops)
    for one in known:
        if all(map(np.array_equal, held, one.held)):
            return one.triangles
    faces = _numbers(mesh.polygons, "loop_total", 1, np.int32), _numbers(mesh.loops, "vertex_index", 1, np.int32)
    for one in known:
        if all(map(np.array_equal, faces, one.faces)):
            one.held = tuple(map(np.copy, held))
            return one.triangles
    mesh.calc_loop_triangles()
    triangles = _numbers(mesh.loop_triangles, "vertices", 3, np.int32), _numbers(mesh.loop_triangles, "polygon_index", 1, np.int32).ravel()
    known.append(_KnownFaces(faces, triangles, tuple(map(np.copy, held))))
    return triangles


def _bytes_of(collection):
    """The memory of a collection's items. To read them by foreach_get() takes 80 ns each, longer than all the rest."""
    count = len(collection)
    first, second, last = (collection[place].as_pointer() for place in (0, 1, count - 1)) if count > 1 else (0, 0, 0)
    if second <= first or last - first != (second - first) * (count - 1):
        return np.full(1, np.nan)  # which is equal to nothing
    return np.ctypeslib.as_array(ctypes.cast(first, ctypes.POINTER(ctypes.c_uint8)), ((second - first) * count,))


def _numbers(collection, name, width, kind):
    numbers = np.empty(width * len(collection), kind)
    collection.foreach_get(name, numbers)
    return numbers.reshape(-1, width)


def to_world(matrix, corners):
    """Products in doubles, one after the other: the same bits with every library behind numpy."""
    x, y, z = corners.T.astype(np.float64, order="C")
    placed = np.empty((len(corners), 3))
    for axis, (row, move) in enumerate(zip(matrix[:3, :3], matrix[:3, 3])):
        sums = x * row[0]
        sums += y * row[1]
        sums += z * row[2]
        sums += move
        placed[:, axis] = sums
    return placed


def _surface(name, original, mesh, instance):
    corners, triangles, polygons = mesh
    matrix = np.array(instance.matrix_world, dtype=np.float64)
    mirrored = np.linalg.det(matrix[:3, :3]) < 0
    facets = np.ascontiguousarray(triangles[:, ::-1]) if mirrored else triangles
    return ShownSurface(name, key_of(original), to_world(matrix, corners), facets, polygons, matrix, instance.is_instance)


def _number_names(surfaces):
    """A repeated name gets #2 and so on, as `tact check` has it."""
    count = {}
    for surface in surfaces:
        count[surface.name] = count.get(surface.name, 0) + 1
        if count[surface.name] > 1:
            surface.name = f"{surface.name}#{count[surface.name]}"
