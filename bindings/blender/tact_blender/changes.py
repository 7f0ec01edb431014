"""What the add-on changes in a file, each where a user asks for it: attributes, a selection, a shape key."""

import numpy as np

from .surfaces import key_of, to_world

ATTRIBUTES = {"tact_gap": ("FLOAT", "POINT"), "tact_crossing": ("BOOLEAN", "FACE")}


def _meshes_of(found):
    """The user's own meshes that what was found can be told in: [(mesh, [body])], and why others cannot."""
    meshes, told = {}, []
    for body, surface in enumerate(found.surfaces):
        object = surface.object
        if object is None:
            told.append(f"{surface.name} is gone")
            continue
        mesh = object.data
        if object.type != "MESH" or surface.is_instance:
            told.append(f"{surface.name} is no mesh of its own")
        elif mesh.library is not None:
            told.append(f"{surface.name} is linked from another file")
        elif not surface.fits(mesh):
            told.append(f"modifiers give {surface.name} other faces")
        else:
            meshes.setdefault(mesh.name, (mesh, []))[1].append(body)
    return list(meshes.values()), told


def _crossing_faces(found, mesh, bodies):
    faces = np.zeros(len(mesh.polygons), bool)
    for body in bodies:
        faces[found.surfaces[body].polygons[found.crossing.get(body, np.empty(0, np.int64))]] = True
    return faces


def write_attributes(found):
    """tact_gap at vertices, infinite where no contact point is, and tact_crossing at faces. Tells what has none."""
    meshes, told = _meshes_of(found)
    for mesh, bodies in meshes:
        gaps = np.full(len(mesh.vertices), np.inf)
        for body in bodies:
            if body in found.nearest:
                gaps = np.minimum(gaps, found.nearest[body])
        for (name, (kind, domain)), values in zip(ATTRIBUTES.items(), (gaps.astype(np.float32), _crossing_faces(found, mesh, bodies))):
            attribute = mesh.attributes.get(name)
            if attribute is not None and (attribute.data_type, attribute.domain) != (kind, domain):
                mesh.attributes.remove(attribute)
                attribute = None
            if attribute is None:
                attribute = mesh.attributes.new(name, kind, domain)
            attribute.data.foreach_set("value", values)
        mesh.update()
    return len(meshes), told


def select_crossing(found):
    """Selects the faces that meet others, and nothing else of their meshes. Returns how many, and tells what has none."""
    meshes, told = _meshes_of(found)
    count = 0
    for mesh, bodies in meshes:
        faces = _crossing_faces(found, mesh, bodies)
        of_loop = np.repeat(faces, _numbers(mesh.polygons, "loop_total"))
        for collection, corner in ((mesh.vertices, "vertex_index"), (mesh.edges, "edge_index")):
            mask = np.zeros(len(collection), bool)
            mask[_numbers(mesh.loops, corner)[of_loop]] = True
            collection.foreach_set("select", mask)
        mesh.polygons.foreach_set("select", faces)
        mesh.update()
        count += int(faces.sum())
    return count, told


def _numbers(collection, name):
    numbers = np.empty(len(collection), np.int32)
    collection.foreach_get(name, numbers)
    return numbers


class Untangled:
    """Shape keys that push objects out of what they cross, a pass at a time."""

    KEY = "tact untangled"

    def __init__(self, objects):
        self.keys = {}
        for object in objects:
            if object.data.shape_keys is None:
                object.shape_key_add(name="Basis", from_mix=False)
            key = object.shape_key_add(name=self.KEY, from_mix=False)  # moves nothing yet
            key.value = 1.0
            self.keys[key_of(object)] = key

    def push(self, checker, surfaces, clearance):
        """Moves vertices by the contact points of the last step that are nearer than `clearance`. Returns the farthest."""
        number = {body.index: i for i, body in enumerate(checker.ids)}
        moves = [np.zeros_like(surface.positions) if surface.key in self.keys and not surface.is_instance else None for surface in surfaces]
        shares = [np.zeros(len(surface.positions)) for surface in surfaces]
        for contact in checker.report.contacts:
            a, b, points = number[contact.a.index], number[contact.b.index], contact.points
            near = points.gaps < clearance
            missing = np.where(near, clearance - points.gaps, 0.0)
            sides = [(body, vertices, weights, sign) for body, vertices, weights, sign in ((a, points.a_vertices, points.a_weights, -1.0), (b, points.b_vertices, points.b_weights, 1.0)) if moves[body] is not None]
            squares = sum((np.where(vertices >= 0, weights, 0.0) ** 2).sum(axis=1) for _, vertices, weights, _ in sides)
            for body, vertices, weights, sign in sides:
                for column in range(3):
                    used = near & (vertices[:, column] >= 0)
                    at, weight = vertices[used, column], weights[used, column]
                    np.add.at(moves[body], at, (sign * weight * missing[used] / squares[used])[:, None] * points.normals[used])
                    np.add.at(shares[body], at, weight)
        return max((self._move(surface, move / np.maximum(share, 1.0)[:, None]) for surface, move, share in zip(surfaces, moves, shares) if move is not None), default=0.0)

    def _move(self, surface, world):
        key, turn = self.keys[surface.key], np.linalg.inv(surface.matrix)
        turn[:3, 3] = 0.0  # a direction
        places = np.empty(3 * len(key.data), np.float32)
        key.data.foreach_get("co", places)
        key.data.foreach_set("co", (places.reshape(-1, 3) + to_world(turn, world)).astype(np.float32).ravel())
        surface.object.data.update()
        return float(np.sqrt((world**2).sum(axis=1)).max()) if len(world) else 0.0


def untangle(run, objects, passes, clearance):
    """Pushes objects out, a few passes. Returns the first and the last of what was found, and how many passes."""
    first = last = run.step()
    meshes, _ = _meshes_of(first)
    fitting = [object for object in objects if any(object.data == mesh and object.data.users == 1 for mesh, _ in meshes)]
    if not fitting:
        return first, first, 0
    made = Untangled(fitting)
    done = 0
    while done < passes and (last.facet_pairs or (last.least_gap is not None and last.least_gap < clearance)):
        if made.push(run.checker, last.surfaces, clearance) == 0.0:
            break
        run.context.view_layer.update()
        last, done = run.step(), done + 1
    return first, last, done
