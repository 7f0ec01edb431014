"""Arrays of whole reports, and what solvers need of contact points."""

import numpy as np
import pytest
import tact
from shapes import grid, tetrahedron


@pytest.fixture
def draped():
    """A sheet over two tetrahedra, its report, all positions and the first row of each body."""
    world = tact.World(tact.Settings(points=True, patches=True, threads=1))
    meshes = [(grid(12, 3.0), tact.Surface.sheet), (tetrahedron(0.3), tact.Surface.closed), (tetrahedron(1.0), tact.Surface.closed)]
    x, first = np.zeros((0, 3)), {}
    for (positions, facets), surface in meshes:
        positions = positions + ([0.01, 0.02, 0.05] if surface == tact.Surface.closed else [0, 0, 0])
        positions += np.random.default_rng(3).uniform(-2e-3, 2e-3, positions.shape)  # no two features just touch
        first[world.add_body(positions, facets, surface=surface, margin=0.04)] = len(x)
        x = np.concatenate([x, positions])
    return world, world.detect(), x, first


def test_points_of_the_report_are_those_of_its_contacts(draped):
    _, report, _, _ = draped
    points = report.points
    assert len(points) > 5
    for name in ("kinds", "a_vertices", "b_vertices", "a_weights", "b_weights", "normals", "gaps", "ids"):
        expected = np.concatenate([getattr(contact.points, name) for contact in report.contacts])
        np.testing.assert_array_equal(getattr(points, name), expected, err_msg=name)
    for row, contact in zip(points.bodies, np.array(report.contacts)[points.contacts]):
        assert tuple(row) == (contact.a.index, contact.b.index)
    of_patches = [contact.patches[patch].id for contact in report.contacts for patch in contact.points.patches]
    np.testing.assert_array_equal(points.patch_ids, of_patches)
    with pytest.raises(ValueError, match="read-only"):
        points.gaps[0] = 0


def test_facet_pairs_of_the_report_are_those_of_its_contacts(draped):
    _, report, _, _ = draped
    pairs = report.facet_pairs
    assert len(pairs) > 0 and len(pairs) == report.stats["facet_pairs"]
    np.testing.assert_array_equal(pairs.facets, np.concatenate([contact.facet_pairs for contact in report.contacts]))
    for row, contact in zip(pairs.bodies, np.array(report.contacts)[pairs.contacts]):
        assert tuple(row) == (contact.a.index, contact.b.index)


def test_stencils_have_the_gaps_of_points(draped):
    _, report, x, first = draped
    stencils, points = report.stencils(first), report.points
    np.testing.assert_array_equal(stencils.ids, points.ids)
    between = np.einsum("nk,nkd->nd", stencils.weights, x[np.maximum(stencils.vertices, 0)])
    np.testing.assert_allclose(between, points.gaps[:, None] * points.normals, atol=1e-12)
    values, gradients, hessians = stencils.evaluate_gaps(x)
    np.testing.assert_allclose(values, points.gaps, atol=1e-12)
    assert gradients.shape == (len(points), 4, 3) and hessians.shape == (len(points), 12, 12)


def test_energies_have_their_gradients_and_hessians(draped):
    _, report, x, first = draped
    stencils, n = report.stencils(first), len(x)
    step = 1e-6 * np.random.default_rng(1).normal(size=x.shape)
    for energy in (lambda at: stencils.penalties(at, 0.08), lambda at: stencils.friction(at - x, np.full(len(stencils), 2.0), 1e-3)):
        before, here, after = energy(x - step), energy(x), energy(x + step)
        sums = [stencils.add_gradients(one[1], n) for one in (before, here, after)]
        assert (after[0].sum() - before[0].sum()) / 2 == pytest.approx((sums[1] * step).sum(), rel=1e-4, abs=1e-15)
        rows, columns, values = stencils.triplets(here[2], n)
        hessian = np.zeros((3 * n, 3 * n))
        np.add.at(hessian, (rows, columns), values)
        np.testing.assert_allclose(hessian, hessian.T, atol=1e-9)
        assert np.linalg.eigvalsh(hessian).min() > -1e-9


def test_colors_share_no_vertex(draped):
    _, report, _, first = draped
    stencils, moving = report.stencils(first), 100
    colors = stencils.colors(moving)
    for color in range(colors.max() + 1):
        vertices = stencils.vertices[colors == color]
        vertices = vertices[(vertices >= 0) & (vertices < moving)]
        assert len(set(vertices)) == len(vertices)
    assert np.all(np.isfinite(stencils.effective_masses(np.ones(len(stencils.vertices) * 100))))


def test_wrong_use_is_said(draped):
    _, report, x, first = draped
    stencils = report.stencils(first)
    with pytest.raises(ValueError, match="in a stencil"):
        stencils.evaluate_gaps(x[:3])
    with pytest.raises(KeyError, match="first row"):
        report.stencils({})
    with pytest.raises(ValueError, match="limits"):
        stencils.friction(x, [1.0], 1e-3)
    with pytest.raises(ValueError, match="gradients has shape"):
        stencils.add_gradients(np.zeros(5), 3)


def test_first_rows_are_of_the_bodies_of_the_report():
    positions, facets = tetrahedron()
    for others in range(4):
        world = tact.World(tact.Settings(points=True))
        old, b = (world.add_body(positions + [way, way, way], facets, margin=0.1) for way in (0.0, 0.2))
        foreign = tact.World().add_body(positions, facets)
        world.remove_body(old)
        a = world.add_body(positions, facets, margin=0.1)
        first = {old: 0, b: 4, a: 8, foreign: 50}
        for k in range(others):  # so that hashes of ids fall otherwise
            first[world.add_body(positions + [50 * k + 50, 0, 0], facets)] = 100 + k
        report = world.detect()
        expected = report.stencils({a: 8, b: 4}).vertices.tolist()
        assert report.stencils(first).vertices.tolist() == expected
        assert min(min(v for v in row if v >= 0) for row in expected) >= 4


def test_planes_need_no_first_row():
    positions, facets = tetrahedron()
    world = tact.World(tact.Settings(points=True))
    body = world.add_body(positions, facets, margin=0.1)
    world.add_plane([0, 0, 1], 0.0, margin=0.1)
    report = world.detect()
    assert len(report.points) == 3
    assert len(report.stencils({body: 0})) == 0


def test_numbers_that_are_none_are_refused(draped):
    world, report, x, first = draped
    stencils = report.stencils(first)
    n = len(stencils)
    ones = np.ones((n, 4, 3))
    masked = np.ma.array(ones, mask=True)
    impulses = np.ones((n, 3))
    cases = [
        (lambda: stencils.add_gradients(masked, len(x)), ValueError, "masked"),
        (lambda: stencils.add_gradients(ones * 1j, len(x)), TypeError, "complex"),
        (lambda: stencils.add_gradients(ones.astype(str), len(x)), TypeError, "U"),
        (lambda: stencils.add_gradients(ones.reshape(n, 3, 4), len(x)), ValueError, "shape"),
        (lambda: stencils.add_gradients(ones, -8), ValueError, "moving is -8"),
        (lambda: stencils.colors(-1), ValueError, "moving is -1"),
        (lambda: stencils.effective_masses(np.ma.array(np.ones(len(x)), mask=True)), ValueError, "masked"),
        (lambda: world.sum_contacts(report, report.points.ids, impulses.ravel()), ValueError, "shape"),
        (lambda: world.sum_contacts(report, report.points.ids, np.ma.array(impulses, mask=True)), ValueError, "masked"),
        (lambda: world.sum_contacts(report, [-1], [[0, 0, 0]]), ValueError, "-1"),
        (lambda: tact.nearest_rotation(np.eye(3) * 1j), TypeError, "complex"),
        (lambda: tact.rotation_of_quaternion(["0", "0", "0", "1"]), TypeError, "U1"),
        (lambda: world.add_body([np.ma.array(p, mask=True) for p in x[:3]], [[0, 1, 2]]), ValueError, "masked"),
        (lambda: world.labels(next(iter(first)), [0, 1, 2]), ValueError, "vertices has shape"),
    ]
    for call, exception, says in cases:
        with pytest.raises(exception, match=says):
            call()


def test_rotations_of_float_engines_are_taken():
    world = tact.World()
    body = world.add_body(*tetrahedron(), motion=tact.Motion.rigid)
    q = np.random.default_rng(1).normal(size=(1000, 4)).astype(np.float32)
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    rotations = tact.rotation_of_quaternion(q)
    nearest = tact.nearest_rotation(rotations.astype(np.float32))
    assert rotations.shape == nearest.shape == (1000, 3, 3)
    for r in (rotations, nearest):
        np.testing.assert_allclose(r @ np.swapaxes(r, 1, 2), np.broadcast_to(np.eye(3), r.shape), atol=2e-15)
    np.testing.assert_allclose(rotations, nearest, atol=1e-6)
    for r in nearest:
        world.set_pose(body, r, np.zeros(3))
    assert tact.rotation_of_quaternion([0, 0, 0, 1]).tolist() == np.eye(3).tolist()
    for wrong in (2 * np.eye(3), -np.eye(3)):
        with pytest.raises(tact.Error) as raised:
            tact.nearest_rotation(wrong)
        assert raised.value.code == tact.ErrorCode.not_a_rotation
    with pytest.raises(ValueError, match="shape"):
        tact.nearest_rotation(np.zeros((4, 4)))
    assert tact.nearest_rotation(np.zeros((0, 3, 3))).shape == (0, 3, 3)


def test_sums_are_those_of_loops(draped):
    world, report, x, first = draped
    points = report.points
    impulses = np.random.default_rng(2).normal(size=(len(points), 3))
    sums = world.sum_contacts(report, points.ids, impulses)
    whole = np.flatnonzero(sums.kinds == tact.SumKind.contact.value)
    assert len(whole) == len(report.contacts) and sums.first_vertices[-1] == len(sums.vertices)
    for row, contact in zip(whole, report.contacts):
        chosen = (points.bodies == [contact.a.index, contact.b.index]).all(axis=1)
        assert sums.points[row] == chosen.sum() and sums.deepest_gaps[row] == points.gaps[chosen].min()
        np.testing.assert_allclose(sums.forces[row], impulses[chosen].sum(axis=0), atol=1e-12)
        np.testing.assert_allclose(sums.normals[row], points.normals[chosen].mean(axis=0), atol=1e-12)
        np.testing.assert_allclose(sums.areas[row], sum(patch.area for patch in contact.patches), atol=1e-15)
    bodies = sums.kinds == tact.SumKind.body.value
    np.testing.assert_allclose(sums.forces[bodies].sum(axis=0), 0, atol=1e-12)
    np.testing.assert_array_equal(sums.bodies[bodies, 1], -1)
    assert len(world.sum_contacts(report)) == len(sums)
    with pytest.raises(ValueError, match="impulses has shape"):
        world.sum_contacts(report, points.ids, impulses[1:])


def test_barriers_within_reach_are_those_of_their_distances():
    world = tact.World(tact.Settings(within_reach=True))
    positions, facets = grid(4)
    a = world.add_body(positions, facets, surface=tact.Surface.sheet, margin=0.05)
    b = world.add_body(positions + [0.03, 0.02, 0.06], facets, surface=tact.Surface.sheet, margin=0.05)
    report = world.detect()
    pairs = report.stencils_within_reach({a: 0, b: len(positions)})
    assert len(pairs) == sum(len(contact.within_reach) for contact in report.contacts) > 0
    x = np.concatenate([positions, positions + [0.03, 0.02, 0.06]])
    values, gradients, hessians = pairs.barriers(x, 0.1)
    without = pairs.barriers(x, 0.1, hessians=False)
    assert np.array_equal(without[0], values) and np.array_equal(without[1], gradients)
    assert without[2].shape == (0, 12, 12)
    assert (pairs.whole.kinds == tact.StencilKind.edge_edge).any()  # enumerations compare with the numbers of arrays
    d = pairs.closest.gaps
    assert values == pytest.approx(np.where(d < 0.1, -((d - 0.1) ** 2) * np.log(d / 0.1), 0.0), rel=1e-9)
    assert pairs.whole.add_gradients(gradients, len(x)).sum(axis=0) == pytest.approx([0, 0, 0], abs=1e-9)
    with pytest.raises(KeyError):
        report.stencils_within_reach({a: 0})


def test_impacts_are_constraints():
    positions, facets = grid(6, 1.0)
    world = tact.World()
    low = world.add_body(positions, facets, surface=tact.Surface.sheet)
    high = world.add_body(positions + [0.03, 0.02, 0.2], facets, surface=tact.Surface.sheet)
    world.detect()
    begin = np.concatenate([positions, positions + [0.03, 0.02, 0.2]])
    end = begin - np.repeat([[0, 0, 0], [0, 0, 0.5]], len(positions), 0)
    world.set_positions(high, end[len(positions) :])
    motion = world.detect_motion()
    stencils = motion.stencils({low: 0, high: len(positions)}, begin, end)
    assert len(stencils) == motion.stops.sum() > 0
    np.testing.assert_allclose(np.abs(stencils.normals), np.tile([0, 0, 1], (len(stencils), 1)), atol=1e-9)
    np.testing.assert_allclose(stencils.gap_rates(end - begin), -0.5, atol=1e-9)
    with pytest.raises(KeyError, match="first row"):
        motion.stencils({low: 0}, begin, end)
    with pytest.raises(tact.Error, match="rows"):
        motion.stencils({low: 0, high: len(positions)}, begin[:5], end[:5])
