"""Steps a world over frames, and keeps what was found in each."""

from dataclasses import dataclass, field

import numpy as np
import tact

KINDS = {
    0: "vertex-facet",
    1: "facet-vertex",
    2: "edge-edge",
    3: "vertex-edge",
    4: "edge-vertex",
    5: "vertex-vertex",
    6: "vertex-plane",
    7: "plane-vertex",
}


@dataclass
class Found:
    """What a step found, with places in world space. Bodies are numbers of `surfaces`."""

    surfaces: list
    facet_pairs: int = 0
    self_pairs: int = 0
    crossing: dict = field(default_factory=dict)  # body: its facets that meet another
    points_a: np.ndarray = None  # (N, 3): the point of a of each contact point
    points_b: np.ndarray = None
    normals: np.ndarray = None
    gaps: np.ndarray = None  # (N,)
    nearest: dict = field(default_factory=dict)  # body: for each vertex the least gap of its contact points
    impacts: int = 0
    first_time: float = None
    restarted: bool = False  # faces are others than in the step before: nothing was carried on

    @property
    def least_gap(self):
        return float(self.gaps.min()) if len(self.gaps) else None

    def crossing_names(self):
        return [self.surfaces[body].name for body in sorted(self.crossing)]


class Checker:
    """One world over the frames of a scene. `settings(surface)` gives what add_body() takes besides the mesh."""

    def __init__(self, settings, *, accuracy="exact", points=True, threads=0):
        self.settings = settings
        self.world_settings = tact.Settings(threads=threads, accuracy=getattr(tact.Accuracy, accuracy), points=points, patches=points)
        self.world, self.ids, self.shapes = None, [], []

    def step(self, surfaces, *, impacts=False):
        """Finds what meets now; with `impacts` also what met on the way from the last step, if faces are the same."""
        restarted = self._place(surfaces)
        motion = self.world.detect_motion() if impacts and not restarted else None
        self.report, self.motion = self.world.detect(), motion
        found = self._found(surfaces)
        found.restarted = restarted and len(self.shapes) > 0 and self.steps > 0
        self.steps += 1
        return found

    def _place(self, surfaces):
        shapes = [(surface.name, surface.facets, len(surface.positions)) for surface in surfaces]
        if self.world is not None and _same_shapes(shapes, self.shapes):
            self.world.set_positions({body: surface.positions for body, surface in zip(self.ids, surfaces)})
            return False
        self.steps = 0 if self.world is None else self.steps
        self.world = tact.World(self.world_settings)
        self.ids = [self.world.add_body(s.positions, s.facets, name=s.name, **self.settings(s)) for s in surfaces]
        self.shapes = shapes
        return True

    def _found(self, surfaces):
        number = {body.index: i for i, body in enumerate(self.ids)}
        found = Found(surfaces)
        parts = [[], [], [], []]
        for contact in self.report.contacts:
            a, b = number[contact.a.index], number[contact.b.index]
            pairs = contact.facet_pairs
            found.facet_pairs += len(pairs)
            found.self_pairs += len(pairs) if a == b else 0
            for body, column in ((a, 0), (b, 1)):
                if len(pairs):
                    found.crossing[body] = np.union1d(found.crossing.get(body, np.empty(0, np.int32)), pairs[:, column])
            points = contact.points
            if len(points):
                for part, array in zip(parts, (_places(surfaces[a], points.a_vertices, points.a_weights), _places(surfaces[b], points.b_vertices, points.b_weights), points.normals, points.gaps)):
                    part.append(array)
                _keep_least(found.nearest, a, len(surfaces[a].positions), points.a_vertices, points.gaps)
                _keep_least(found.nearest, b, len(surfaces[b].positions), points.b_vertices, points.gaps)
        found.points_a, found.points_b, found.normals = (np.concatenate(part) if part else np.empty((0, 3)) for part in parts[:3])
        found.gaps = np.concatenate(parts[3]) if parts[3] else np.empty(0)
        if self.motion is not None:
            found.impacts = len(self.motion)
            found.first_time = _first_time(self.motion)
        return found


def _same_shapes(first, second):
    return len(first) == len(second) and all(a[0] == b[0] and a[2] == b[2] and (a[1] is b[1] or np.array_equal(a[1], b[1])) for a, b in zip(first, second))


def _places(surface, vertices, weights):
    corners = surface.positions[np.maximum(vertices, 0)]
    return (corners * np.where(vertices >= 0, weights, 0.0)[:, :, None]).sum(axis=1)


def _keep_least(nearest, body, count, vertices, gaps):
    least = nearest.setdefault(body, np.full(count, np.inf))
    for column in vertices.T:
        there = column >= 0
        np.minimum.at(least, column[there], gaps[there])


def frame_json(frame, checker):
    """What `tact check --json` writes of a frame."""
    report, world = checker.report, checker.world
    with_facets = checker.world_settings.accuracy != tact.Accuracy.hulls
    with_points = checker.world_settings.points
    contacts = {(contact.a.index, contact.b.index): contact for contact in report.contacts}
    pairs = [_pair_json(a.index, b.index, overlap, contacts.get((a.index, b.index)), with_facets, with_points) for a, b, overlap in report.candidate_pairs]
    pairs += [_pair_json(a, b, None, contact, with_facets, with_points) for (a, b), contact in contacts.items() if a == b]
    pairs.sort(key=lambda pair: (pair["a"], pair["b"]))
    stats = report.stats
    json = {
        "frame": frame,
        "hash": f"{report.hash():016x}",
        "pairs": pairs,
        "stats": {name: value for name, value in stats.items() if not name.endswith("_ms")},
        "times_ms": {name[:-3]: value for name, value in stats.items() if name.endswith("_ms")},
    }
    if checker.motion is not None:
        json["impacts"] = _impacts_json(checker.motion)
        json["first_time"] = _first_time(checker.motion)
    return json


def head_json(checker):
    """What `tact check --json` writes before the frames."""
    world = checker.world
    return {
        "tact": tact.__version__,
        "accuracy": world.settings.accuracy.name,
        "threads": world.settings.threads,
        "bodies": [{"name": world.name(body), "vertices": world.vertex_count(body), "facets": world.facet_count(body), "surface": world.surface(body).name} for body in world.bodies],
    }


def _pair_json(a, b, overlap, contact, with_facets, with_points):
    pair = {"a": a, "b": b}
    if overlap is not None:
        pair["hulls_overlap"] = overlap
        if contact is not None:
            pair |= {
                "direction": contact.direction.tolist(),
                "depth": contact.depth,
                "source": contact.source.name,
                "iterations": contact.iterations,
                "limit_reached": contact.limit_reached,
                "kept_facets": [contact.kept_facets_a, contact.kept_facets_b],
            }
            if contact.containment != tact.Containment.none:
                pair["contained"] = contact.containment.name[0]
    pair["facet_pairs"] = None if not with_facets else [] if contact is None else contact.facet_pairs.tolist()
    if with_points:
        if overlap is None:  # of a body with itself
            pair["point_limit_reached"] = contact.point_limit_reached
        pair["points"] = [] if contact is None else _points_json(contact.points)
        pair["patches"] = [] if contact is None else [_patch_json(patch) for patch in contact.patches]
    return pair


def _features(vertices, *weights):
    """Rows without the -1 that fills them up, and the weights of as many vertices."""
    counts = (vertices >= 0).sum(axis=1)
    return [[row[:count] for row, count in zip(rows.tolist(), counts)] for rows in (vertices, *weights)]


def _points_json(points):
    a, a_weights = _features(points.a_vertices, points.a_weights)
    b, b_weights = _features(points.b_vertices, points.b_weights)
    columns = zip(points.kinds.tolist(), a, b, a_weights, b_weights, points.normals.tolist(), points.gaps.tolist(), points.minima.tolist(), points.patches.tolist())
    names = ("kind", "a", "b", "a_weights", "b_weights", "normal", "gap", "minimum", "patch")
    return [dict(zip(names, (KINDS[row[0]], *row[1:]))) for row in columns]


def _patch_json(patch):
    return {
        "id": f"{patch.id:016x}",
        "point": patch.point.tolist(),
        "direction": patch.direction.tolist(),
        "depth": patch.depth,
        "area": patch.area,
        "points": patch.points.tolist(),
        "spanning": patch.spanning.tolist(),
    }


def _first_time(motion):
    return motion.first_time if motion.first_time <= 1.0 else None


def _impacts_json(motion):
    (a,), (b,) = _features(motion.a_vertices), _features(motion.b_vertices)
    rows = zip(motion.bodies.tolist(), motion.kinds.tolist(), a, b, motion.times.tolist(), motion.stops.tolist())
    return [{"bodies": bodies, "kind": KINDS[kind], "a": of_a, "b": of_b, "time": time, "stops": stops} for bodies, kind, of_a, of_b, time, stops in rows]
