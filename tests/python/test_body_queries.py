"""Distances, sweeps, overlaps and kept reports."""

import threading

import numpy as np
import pytest

import tact


def two_boxes():
    """Unit cubes, 2 m apart."""
    world = tact.World()
    positions = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    facets = np.array([[q[0], q[k], q[k + 1]] for q in quads for k in (1, 2)], dtype=np.int32)
    a = world.add_body(positions, facets)
    b = world.add_body(positions + [3.0, 0.0, 0.0], facets)
    return world, a, b, positions


def test_distances_and_neighbours():
    world, a, b, positions = two_boxes()
    found = world.distances([a, b], [b, a])
    assert len(found) == 2 and found.distances.tolist() == [2.0, 2.0]
    assert found.bodies.tolist() == [[0, 1], [1, 0]] and (found.facets >= 0).all()
    assert found.a_barycentric.sum() == pytest.approx(2.0)
    assert world.distances([a], [b], within=1.0).distances[0] == np.inf
    near = world.nearest_bodies(a, count=4)
    assert near.bodies[:, 1].tolist() == [b.index] and near.containments[0] == tact.Containment.none.value
    with pytest.raises(ValueError, match="lengths"):
        world.distances([a], [a, b])


def test_signed_distances():
    world, a, b, positions = two_boxes()
    found = world.signed_distances([[0.5, 0.5, 0.25], [2.0, 0.5, 0.5]])
    assert found.distances.tolist() == [-0.25, 1.0]


def test_sweeps():
    world, a, b, positions = two_boxes()
    hits = world.sweeps([a, a, a], [[4.0, 0.0, 0.0], [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    assert hits.bodies.tolist() == [b.index, -1, -1]
    assert hits.fractions[0] == pytest.approx(0.5, abs=1e-12) and hits.fractions[0] <= 0.5
    turned = world.sweeps([a], angles=[np.pi], centers=[[2.0, 0.0, 0.0]])
    assert turned.bodies[0] == b.index and 0.0 < turned.fractions[0] < 1.0
    with pytest.raises(ValueError, match="rows"):
        world.sweeps([a], np.zeros((2, 3)))


def test_overlap():
    world, a, b, positions = two_boxes()
    world.set_positions(b, positions + [0.5, 0.0, 0.0])
    both = world.overlap(a, b)
    assert both.volume == pytest.approx(0.5, abs=1e-14) and both.area == pytest.approx(4.0, abs=1e-14)


def test_a_kept_report_stays():
    world, a, b, positions = two_boxes()
    world.set_positions(b, positions + [0.5, 0.25, 0.125])
    report = world.detect()
    kept, value = report.keep(), report.hash()
    world.set_positions(b, positions + [9.0, 0.0, 0.0])
    seen = []
    reader = threading.Thread(target=lambda: seen.append(kept.hash()))
    reader.start()
    world.detect()
    reader.join()
    assert seen == [value] and len(kept) == 1 and len(kept.contacts[0].facet_pairs) > 0
    with pytest.raises(tact.StaleReportError):
        report.hash()


def test_two_kept_reports_in_turns():
    world, a, b, positions = two_boxes()
    turns, hashes, seen, readers = [None, None], [], {}, []
    for step in range(6):
        world.set_positions(b, positions + [0.5 + 0.01 * step, 0.25, 0.125])
        report = world.detect()
        for reader in readers[-1:]:
            reader.join()
        kept = turns[step % 2] = report.keep(turns[step % 2])
        hashes.append(report.hash())
        readers.append(threading.Thread(target=lambda kept=kept, step=step: seen.update({step: kept.hash()})))
        readers[-1].start()  # while the next step runs
    readers[-1].join()
    assert [seen[step] for step in range(6)] == hashes
    last, before = turns[1], turns[0]
    contact = last.contacts[0]
    again = before.keep(last)
    assert again.hash() == before.hash() and again.keep(again).hash() == again.hash()
    with pytest.raises(tact.StaleReportError):
        last.hash()
    with pytest.raises(tact.StaleReportError):
        contact.depth
    with pytest.raises(tact.Error, match="kept"):
        again.keep(world.detect())
    live = world.detect()
    with pytest.raises(tact.Error, match="kept"):  # of the same world, too: it would be no copy
        live.keep(live)


class Lines:
    def __init__(self):
        self.lines, self.texts = [], []

    def line(self, p, q, color):
        self.lines.append(np.linalg.norm(np.subtract(p, q)))

    def triangle(self, p, q, r, color):
        pass

    def text(self, at, words, color):
        self.texts.append(words)


def test_answers_are_drawn():
    world, a, b, positions = two_boxes()
    drawn = Lines()
    world.debug_draw_distances(world.distances([a], [b]), drawn)
    assert drawn.lines == [2.0] and drawn.texts == ["2 m"]
    world = tact.World(tact.Settings(points=True, patches=True))
    facets = np.array([[0, 1, 2]])
    first, second = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), np.array([[0.1, 0.1, 0.05], [0.9, 0.1, 0.3], [0.1, 0.9, 0.3]])
    ids = [world.add_body(x, facets, margin=0.1) for x in (first, second)]
    report = world.detect()
    stencils = report.stencils({ids[0]: 0, ids[1]: 3})
    drawn = Lines()
    stencils.debug_draw(np.concatenate([first, second]), drawn)
    assert len(drawn.lines) >= 2 * len(stencils) > 0
    sums = world.sum_contacts(report, stencils.ids, np.tile([0.0, 0.0, 1.0], (len(stencils), 1)))
    drawn = Lines()
    world.debug_draw_sums(sums, drawn)
    assert len(drawn.lines) > 6


def test_joined_minima():
    world = tact.World(tact.Settings(points=True))
    x = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    quad = np.array([[0, 1, 2], [0, 2, 3]])
    for shift in ([-1, 0, 0], [0, 0, 0]):
        world.add_body(x + shift, quad, motion=tact.Motion.fixed, margin=0.05)
    world.add_body(0.2 * x + [0.02, 0.4, 0.01], quad, margin=0.05)
    report = world.detect()
    minima, normals = world.joined_minima(report), report.points.normals
    assert minima.dtype == bool and len(minima) == len(report.points)
    assert (np.abs(normals[report.points.minima == 1][:, :2]) > 0.1).any()
    assert minima.any() and not (np.abs(normals[minima][:, :2]) > 1e-6).any()
    with pytest.raises(tact.Error, match="within"):
        world.joined_minima(report, within=-1.0)
