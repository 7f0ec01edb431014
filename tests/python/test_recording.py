"""Recordings, messages, meshes read back and drawings."""

import numpy as np
import pytest
import tact
from shapes import grid, tetrahedron


def play(world):
    """Two tetrahedra that come closer; the hashes of the steps."""
    left = world.add_body(*tetrahedron(0.0), name="left")
    world.add_body(*tetrahedron(0.9), name="right")
    hashes = []
    for step in range(3):
        world.set_positions(left, tetrahedron(0.05 * step)[0])
        hashes.append(world.detect().hash())
    return hashes


def test_a_recording_plays_again(tmp_path):
    world = tact.World()
    world.record(tmp_path / "r")
    hashes = play(world)
    world.stop_recording()
    player = tact.RecordingPlayer(tmp_path / "r", threads=1)
    steps = list(player)
    assert [step.recorded for step in steps] == hashes
    assert all(step.same for step in steps)
    assert player.cut_at is None
    assert player.recorded_by == tact.__version__
    assert len(player.world) == 2


def test_a_cut_recording_plays_as_far_as_it_goes(tmp_path):
    world = tact.World()
    world.record(tmp_path / "r")
    play(world)
    world.stop_recording()
    whole = (tmp_path / "r").read_bytes()
    (tmp_path / "r").write_bytes(whole[:-3])
    player = tact.RecordingPlayer(tmp_path / "r")
    steps = list(player)
    assert [step.recorded is not None for step in steps] == [True, True, False]
    assert player.cut_at == len(whole) - 9


def test_a_world_outlives_its_player(tmp_path):
    world = tact.World()
    world.record(tmp_path / "r")
    play(world)
    world.stop_recording()
    player = tact.RecordingPlayer(tmp_path / "r")
    list(player)
    played = player.world
    del player
    assert played.detect().contacts[0].depth == world.detect().contacts[0].depth


def test_wrong_use_of_recordings(tmp_path):
    world = tact.World()
    with pytest.raises(OSError):
        world.record(tmp_path / "none" / "r")
    with pytest.raises(OSError):
        tact.RecordingPlayer(tmp_path / "none")
    (tmp_path / "r").write_bytes(b"solid")
    with pytest.raises(tact.Error, match="byte 0: not a recording") as refused:
        tact.RecordingPlayer(tmp_path / "r")
    assert refused.value.code == tact.ErrorCode.bad_recording
    play(world)
    with pytest.raises(tact.Error, match="before the first body"):
        world.record(tmp_path / "r")


def test_meshes_are_read_back():
    world = tact.World()
    positions, facets = grid(4)
    body = world.add_body(positions, facets, surface=tact.Surface.sheet, margin=0.5)
    assert (world.positions(body) == positions).all()
    assert (world.facets(body) == facets).all()
    lower, upper = world.bounds(body)
    assert np.allclose(lower, [-0.5, -0.5, -0.5]) and np.allclose(upper, [0.8, 0.8, 0.5])


class Sketch:
    def __init__(self):
        self.lines, self.triangles, self.texts = [], [], []

    def line(self, p, q, color):
        self.lines.append((p, q, color))

    def triangle(self, p, q, r, color):
        self.triangles.append(color)

    def text(self, at, words, color):
        self.texts.append(words)


def test_what_was_found_is_drawn():
    world = tact.World()
    play(world)
    report = world.detect()
    sketch = Sketch()
    world.debug_draw(report, sketch)
    assert len(sketch.lines) > 24 and len(sketch.triangles) > 0
    assert sketch.texts[:2] == ["left", "right"]
    options = tact.DebugDrawOptions(boxes=False, names=False, meeting=tact.DebugColor(red=0.25))
    sketch = Sketch()
    world.debug_draw(report, sketch, options)
    assert sketch.triangles[0] == (0.25, 0.0, 0.0, 1.0)
    options = tact.DebugDrawOptions(kept_facets=True, facet_pairs=False, kept=tact.DebugColor(green=0.5))
    sketch = Sketch()
    world.debug_draw(report, sketch, options)
    contact = report.contacts[0]
    assert sketch.triangles == [(0.0, 0.5, 0.0, 1.0)] * (contact.kept_facets_a + contact.kept_facets_b)
    with pytest.raises(AttributeError):
        tact.DebugDrawOptions(boxen=True)
    with pytest.raises(AttributeError):
        world.debug_draw(report, object())
    world.detect()
    with pytest.raises(tact.StaleReportError):
        world.debug_draw(report, sketch)


def test_messages_tell_of_limits():
    told = []
    world = tact.World(tact.Settings(iteration_limit=1, on_message=lambda message: told.append(message.text)))
    rng = np.random.default_rng(3)
    corners, facets = tetrahedron()
    bodies = [world.add_body(corners, facets, name=f"b{i}") for i in range(8)]
    limits = 0
    for _ in range(60):
        for body in bodies:
            axes, _ = np.linalg.qr(rng.normal(size=(3, 3)))
            world.set_positions(body, corners @ axes * [3, 1, 0.3] + rng.normal(size=3) * 0.3)
        report = world.detect()
        limits += sum(contact.limit_reached for contact in report.contacts)
    assert limits > 0
    assert [message for message in told if "body " not in message] == []
    assert len(told) == limits
