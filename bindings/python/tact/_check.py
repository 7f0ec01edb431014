"""What `tact check` does, as a function: the same bodies, steps and numbers."""

import os
import warnings

import numpy as np

from . import _tact
from ._files import Mesh, MeshSequence, _is_own, _make_names_differ, _most, _read_own, _sequence_of, read_sequence
from ._progress import progress_over


class CheckFrame:
    """What a frame holds. Bodies are numbers, counted from 0, in the order of CheckResult.bodies."""

    __slots__ = ("number", "time", "files", "hash", "candidate_pairs", "bodies", "directions", "depths", "facet_pairs", "points", "impacts", "stats", "_sizes")

    def __init__(self, number, time, files, report, motion, sizes):
        self.number, self.time, self.files = number, time, files
        self.hash = f"{report.hash():016x}"
        self.candidate_pairs = [(a.index, b.index, overlap) for a, b, overlap in report.candidate_pairs]
        self.bodies, self.directions, self.depths = report.bodies, report.directions, report.depths
        self.facet_pairs, self.points, self.impacts, self.stats = report.facet_pairs, report.points, motion, report.stats
        self._sizes = sizes

    @property
    def least_gap(self):
        """the least gap of its contact points, metres; None without points"""
        return float(self.points.gaps.min()) if len(self.points) else None

    def gaps(self, body):
        """(V,): for each vertex of a body the least gap of its contact points, metres; infinity where there is none"""
        body = self._number(body)
        least = np.full(self._sizes[body][0], np.inf)
        for side, vertices in enumerate((self.points.a_vertices, self.points.b_vertices)):
            here = self.points.bodies[:, side] == body
            corners, gaps = vertices[here], self.points.gaps[here]
            for column in corners.T:
                np.minimum.at(least, column[column >= 0], gaps[column >= 0])
        return least

    def crossing(self, body):
        """(F,): for each facet of a body whether it meets another"""
        body = self._number(body)
        meets = np.zeros(self._sizes[body][1], bool)
        for side in range(2):
            meets[self.facet_pairs.facets[self.facet_pairs.bodies[:, side] == body, side]] = True
        return meets

    def _number(self, body):
        """counted from 0; as in lists, -1 is the last one"""
        return range(len(self._sizes))[body]

    def __repr__(self):
        return f"<tact.CheckFrame {self.number}: {len(self.facet_pairs)} facet pairs, {len(self.points)} points>"


class CheckResult:
    """What check() found: its frames, and the bodies that it stepped."""

    __slots__ = ("bodies", "frames", "world", "ids", "json")

    def __init__(self, bodies, frames, world, ids, json):
        self.bodies, self.frames, self.world, self.ids, self.json = bodies, frames, world, ids, json

    def __len__(self):
        return len(self.frames)

    def __getitem__(self, frame):
        return self.frames[frame]

    @property
    def crossing_frames(self):
        """the numbers of the frames in which facets meet"""
        return [frame.number for frame in self.frames if len(frame.facet_pairs)]

    def __repr__(self):
        return f"<tact.CheckResult of {len(self.bodies)} bodies, {len(self.frames)} frames, {len(self.crossing_frames)} with facets that meet>"


def check(
    *meshes,
    sheets=(),
    margins=None,
    selves=(),
    exclude=(),
    weld=False,
    points=False,
    curves=False,
    within_reach=False,
    impacts=False,
    surfaces=False,
    accuracy="exact",
    threads=0,
    frames=None,
    json=False,
    record=None,
    progress=True,
):
    """Finds which bodies touch, frame by frame: what `tact check` does, with the same numbers, as arrays.

    `meshes`: files, folders and series, as read_sequence() takes them, and what read() and read_sequence() gave. Bodies are
    named by their files; `sheets`, `selves` ("all": every one), `exclude` (pairs) and `margins`, metres for all of them or
    by name, take names with the ending or without. `json`: True keeps the text that `tact check --json` writes in the
    result, a path writes it there, too. `record`: a file for `tact replay` and view(). Errors: ValueError, with the file
    and the place in it or the name that is no body's; OSError; Error.
    """
    bodies = _bodies_of(meshes, _most(frames), progress)
    for body in bodies:
        for text in body.warnings:
            warnings.warn(text, stacklevel=2)
    count = _frame_count(bodies, frames)
    steps = _tact._CheckSteps(
        _tact.Settings(
            threads=threads,
            accuracy=_accuracy(accuracy),
            points=points,
            patches=points,
            curves=curves,
            within_reach=within_reach,
            on_message=_warn_of_surfaces,
        ),
        bodies,
        sheets=_names(sheets),
        selves=_names(selves),
        exclude=[tuple(_names(pair)) for pair in exclude],
        margin=None if margins is None or hasattr(margins, "items") else float(margins),
        margins=[(os.fsencode(name), float(margin)) for name, margin in margins.items()] if hasattr(margins, "items") else [],
        weld=weld,
        impacts=impacts,
        json=bool(json),
        json_file="" if isinstance(json, bool) else os.fspath(json),
        surfaces=surfaces,
        record="" if record is None else os.fspath(record),
    )
    json_file = _WholeFile(json) if json and not isinstance(json, bool) else None
    times = next((body.times for body in steps.bodies if len(body.times) > 1), None)
    sizes = [(steps.world.vertex_count(body), steps.world.facet_count(body)) for body in steps.ids]
    found = []
    for number in progress_over(range(count), "tact check", "frame", progress):
        time = times[number] if times else None
        report, motion = steps.step(number, time)
        found.append(CheckFrame(number, time, steps.files_of(number), report, motion, sizes))
    if record is not None:
        steps.world.stop_recording()
    text = steps.finish_json() if json else None
    if json_file is not None:
        json_file.finish(text)
    return CheckResult([_sequence_of(body) for body in steps.bodies], found, steps.world, steps.ids, text)


class _WholeFile:
    """A file that is there when it is whole. That it can be written is seen at once."""

    def __init__(self, path):
        self.path = os.path.realpath(path)
        is_device = os.path.exists(self.path) and not os.path.isfile(self.path)
        self.part = self.path if is_device else f"{self.path}.{os.getpid()}.part"
        if not is_device:
            with open(self.part, "w"):
                pass
            os.remove(self.part)

    def finish(self, text):
        with open(self.part, "w", encoding="utf-8") as file:
            file.write(text)
        if self.part != self.path:
            os.replace(self.part, self.path)


def _accuracy(given):
    if not isinstance(given, str):
        return given
    known = _tact.Accuracy.__members__
    if given not in known:
        raise ValueError(f"accuracy is {given!r}, not one of: {', '.join(known)}")
    return known[given]


def _names(given):
    return [os.fsencode(name) for name in ([given] if isinstance(given, str) else given)]


def _warn_of_surfaces(message):
    if message.kind in (_tact.MessageKind.open_surface, _tact.MessageKind.inside_out):
        warnings.warn(message.text, stacklevel=2)


def _bodies_of(meshes, most, progress):
    if not meshes:
        raise ValueError("check() wants a mesh at least")
    given = [isinstance(mesh, (Mesh, MeshSequence)) for mesh in meshes]
    for mesh, is_mesh in zip(meshes, given):
        if not is_mesh:
            os.stat(mesh)
    if not any(given) and all(_is_own(path) for path in meshes):
        return _read_own(meshes, most, progress)
    sequences = []
    for mesh in meshes:
        if isinstance(mesh, Mesh):
            mesh = MeshSequence(mesh.name, [mesh.positions], mesh.facets, mesh.vertices)
        if isinstance(mesh, MeshSequence):
            sequences.append(MeshSequence(mesh.name, mesh.positions[:most], mesh.facets, mesh.vertices, mesh.times[:most], mesh.files[:most]))
        else:
            sequences += read_sequence(mesh, frames=most, progress=progress)
    _make_names_differ(sequences)
    return [_tact._BodyFrames(one.name, one.positions, one.facets, one.vertices, one.times, one.files) for one in sequences]


def _frame_count(bodies, frames):
    """Those that move have as many frames; without one, `frames` steps, or one."""
    moving = [body for body in bodies if body.moves]
    for body in moving[1:]:
        if body.frame_count != moving[0].frame_count:
            raise ValueError(f"{body.name} has {body.frame_count} frames, but {moving[0].name} has {moving[0].frame_count}: all that move must have the same number")
    return moving[0].frame_count if moving else frames or 1
