"""The package gives what the engine finds."""

import threading

import numpy as np
import pytest
import tact
from shapes import grid, tetrahedron


@pytest.fixture
def two():
    """A world of two tetrahedra that reach 0.1 m into each other, and their ids."""
    world = tact.World(tact.Settings(threads=2))
    ids = [world.add_body(*tetrahedron(x), name=name) for x, name in ((0.0, "left"), (0.9, "right"))]
    return world, *ids


def test_a_contact_has_the_closed_form_of_two_tetrahedra(two):
    world, left, right = two
    (contact,) = world.detect().contacts
    assert (contact.a, contact.b) == (left, right)
    assert contact.depth == pytest.approx(0.1 / np.sqrt(3.0), abs=1e-15)
    np.testing.assert_allclose(contact.direction, np.full(3, 1 / np.sqrt(3.0)), atol=1e-15)
    assert contact.touching and len(contact.facet_pairs) > 0
    assert contact.facet_pairs.dtype == np.int32 and contact.facet_pairs.shape[1] == 2


def test_a_body_inside_another_is_contained_and_has_negative_gaps():
    world = tact.World(tact.Settings(points=True))
    positions, facets = tetrahedron(0.0)
    middle = positions.mean(axis=0)
    inner = middle + 0.1 * (positions - middle)
    world.add_body(positions, facets), world.add_body(inner, facets)
    (contact,) = world.detect().contacts
    assert contact.containment == tact.Containment.b_in_a and contact.touching
    assert len(contact.points) == 4 and np.all(contact.points.gaps < 0)
    assert -contact.points.gaps.min() == pytest.approx(contact.depth)


def test_lists_of_the_report_agree_with_its_contacts(two):
    world, left, right = two
    report = world.detect()
    contact = report.contacts[0]
    np.testing.assert_array_equal(report.bodies, [[left.index, right.index]])
    np.testing.assert_array_equal(report.directions, [contact.direction])
    np.testing.assert_array_equal(report.depths, [contact.depth])
    assert report.candidate_pairs == [(left, right, True)]
    assert report.began == [(left, right)] and report.ended == []
    assert report.find_contact(right, left).depth == contact.depth
    assert report.stats["contacts"] == 1 and report.stats["total_ms"] > 0
    assert len(report) == 1


def test_arrays_stay_valid_after_the_step(two):
    world, left, right = two
    pairs = world.detect().contacts[0].facet_pairs
    kept = pairs.copy()
    for step in range(20):
        world.set_positions(right, tetrahedron(0.9 + step)[0])
        world.detect()
    np.testing.assert_array_equal(pairs, kept)


def test_ids_outlive_other_numbers():
    world = tact.World(tact.Settings(points=True))
    flat = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    facets = np.array([[0, 1, 2], [0, 2, 3]])
    cloth = world.add_body(flat + [0, 0, 0.01], facets, surface=tact.Surface.sheet, margin=0.01)
    world.add_body(4 * flat - [1, 1, 0], facets, surface=tact.Surface.sheet, margin=0.01)
    before = {int(i): int(v) for i, v in zip(*ids_and_first_vertices(world.detect()))}
    assert len(before) >= 4
    order = np.array([3, 2, 1, 0, 0, 2])  # turned round, and cut along an edge
    world.set_facets(cloth, flat[order] + [0, 0, 0.01], [[3, 2, 1], [4, 5, 0]], order)
    report = world.detect()
    after = {int(i): int(order[v]) for i, v in zip(*ids_and_first_vertices(report))}
    assert report.began == [] and report.ended == []
    assert {i: after[i] for i in before} == before and len(after) > len(before)


def ids_and_first_vertices(report):
    points = report.contacts[0].points
    return points.ids, points.a_vertices[:, 0]


def test_arrays_of_the_report_cannot_be_written_to(two):
    contact = two[0].detect().contacts[0]
    for array in (contact.facet_pairs, contact.direction):
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_the_hash_does_not_depend_on_threads(threads):
    def run(count):
        world = tact.World(tact.Settings(threads=count, zones=True, patches=True))
        positions, facets = grid(20)
        sheets = [world.add_body(positions + [0, 0, 0.02 * k], facets, surface=tact.Surface.sheet) for k in range(4)]
        hashes = []
        for step in range(5):
            wave = 0.05 * np.sin(3 * positions[:, :1] + step)
            world.set_positions({sheet: positions + wave * [0, 0, 1 + k] for k, sheet in enumerate(sheets)})
            hashes.append(world.detect().hash())
        return hashes

    assert run(threads) == run(1)


def test_float32_and_strided_rows_give_what_float64_gives(two):
    world, left, right = two
    positions = tetrahedron(0.875)[0]  # exact in 32 bits
    wide = np.zeros((4, 5))
    wide[:, 1:4] = positions
    hashes = set()
    for given in (positions, positions.astype(np.float32), wide[:, 1:4]):
        world.set_positions(right, given)
        hashes.add(world.detect().hash())
    assert len(hashes) == 1


def test_settings_zones_and_patches():
    world = tact.World(tact.Settings(zones=True, patches=True, accuracy=tact.Accuracy.paper))
    world.add_body(*tetrahedron(0.0))
    world.add_body(*tetrahedron(0.9))
    (contact,) = world.detect().contacts
    assert contact.zone_a.radius >= 0 and contact.zone_a.center.shape == (3,)
    assert sum(len(patch.facet_pairs) for patch in contact.patches) == len(contact.facet_pairs)
    world.set_settings(tact.Settings(accuracy=tact.Accuracy.hulls))
    assert world.settings.accuracy == tact.Accuracy.hulls
    assert not world.detect().contacts[0].touching


def test_intersection_curves_are_lines_of_points():
    world = tact.World(tact.Settings(curves=True))
    assert world.settings.curves
    positions, facets = grid(5, 1.0)
    sheet = world.add_body(positions, facets, surface=tact.Surface.sheet)
    corners = np.array([[1.4, 1.6, -0.5], [2, 2, 1], [1, 2, 1], [1.5, 1, 1]])
    body = world.add_body(corners, np.array([[0, 1, 3], [0, 2, 1], [0, 3, 2], [1, 2, 3]]))
    contact = world.detect().find_contact(sheet, body)
    (curve,) = contact.curves
    assert curve.closed and len(curve) == len(curve.positions) == len(contact.facet_pairs)
    assert np.all(curve.positions[:, 2] == 0) and sorted(curve.facet_pairs) == list(range(len(contact.facet_pairs)))
    for i, (place, edge, fraction) in enumerate(zip(curve.positions, curve.edges, curve.fractions)):
        p, q = (corners if curve.edges_of_b[i] else positions)[edge]
        np.testing.assert_allclose(p + fraction * (q - p), place, atol=1e-14)


def test_contact_points_of_bodies_with_margins():
    world = tact.World(tact.Settings(points=True))
    positions, facets = grid(5, 1.0)
    floor = world.add_body(positions, facets, surface=tact.Surface.sheet, margin=0.05)
    corners = np.array([[1.4, 1.6, 0.08], [2, 2, 1], [1, 2, 1], [1.5, 1, 1]])
    body = world.add_body(corners, np.array([[0, 1, 3], [0, 2, 1], [0, 3, 2], [1, 2, 3]]), margin=0.05, self_contact=True)
    points = world.detect().find_contact(floor, body).points
    assert points.minima.tolist() == [True] and world.detect().points.minima.tolist() == [1]
    assert len(points) == 1 and points.kinds[0] == tact.FeaturePair.facet_vertex.value
    assert points.gaps[0] == pytest.approx(0.08, abs=1e-15)
    np.testing.assert_allclose(points.normals[0], [0, 0, 1], atol=1e-15)
    np.testing.assert_allclose(points.a_weights[0] @ positions[points.a_vertices[0]], [1.4, 1.6, 0], atol=1e-14)
    assert (world.margin(body), world.self_contact(body), world.self_contact(floor)) == (0.05, True, False)
    world.set_margin(body, 0.0)
    world.set_self_contact(body, False)
    assert world.detect().find_contact(floor, body) is None
    with pytest.raises(tact.Error, match="margin"):
        world.set_margin(body, -1.0)


def test_bodies_and_what_they_are(two):
    world, left, right = two
    assert world.bodies == [left, right] and len(world) == world.body_count == 2
    assert (world.name(left), world.vertex_count(left), world.facet_count(left)) == ("left", 4, 4)
    assert world.surface(left) == tact.Surface.closed and world.motion(left) == tact.Motion.deformable
    world.set_layers(left, 2, 4)
    assert (world.layer(left), world.mask(left)) == (2, 4)
    assert world.detect().contacts == []
    world.set_motion(left, tact.Motion.fixed)
    assert world.motion(left) == tact.Motion.fixed
    world.remove_body(right)
    assert not world.contains(right) and left != right and len({left, right}) == 2


def test_other_threads_run_while_a_step_is_computed():
    world = tact.World(tact.Settings(threads=1))
    positions, facets = grid(60)
    bodies = [world.add_body(positions + [0, 0, 0.001 * k], facets, surface=tact.Surface.sheet) for k in range(4)]
    done, steps = threading.Event(), []

    def step():
        while not done.is_set():
            world.set_positions({body: positions + [0, 0, 0.001 * len(steps)] for body in bodies})
            steps.append(world.detect().stats["total_ms"])

    stepping = threading.Thread(target=step)
    stepping.start()
    try:
        # Sooner or later this thread comes to its turn in the middle of a step, and is refused.
        with pytest.raises(tact.Error, match="another thread") as raised:
            while True:
                world.body_count  # noqa: B018
    finally:
        done.set()
        stepping.join()
    assert raised.value.code == tact.ErrorCode.wrong_order and steps


def test_texts_say_what_a_thing_is(two):
    world = two[0]
    report = world.detect()
    assert repr(world) == "<tact.World of 2 bodies>"
    assert repr(report).startswith("<tact.Report of 1 contacts")
    assert repr(report.contacts[0]).startswith("<tact.Contact of bodies 0 and 1")
    assert "index=0" in repr(two[1]) and "threads=2" in repr(world.settings)


def test_motion_tells_when_a_body_passes_through_a_sheet():
    world = tact.World(tact.Settings(threads=2))
    positions, facets = tetrahedron(0.0)
    flying = world.add_body(positions + [0.1, 0.2, 1.0], facets)
    sheet = world.add_body(*grid(8, 4.0), surface=tact.Surface.sheet)
    world.detect()
    target = positions + [0.1, 0.2, -3.0]
    world.set_positions(flying, target)
    motion = world.detect_motion()
    assert len(motion) > 3 and motion.stats["impacts"] == len(motion)
    assert motion.first_time == motion.times.min()
    np.testing.assert_array_equal(motion.bodies, np.tile([flying.index, sheet.index], (len(motion), 1)))
    assert motion.a_vertices.shape == motion.b_vertices.shape == (len(motion), 3)
    first = world.detect_motion(tact.Impacts.first)
    assert len(first) == 1 and first.first_time == motion.first_time
    start = positions + [0.1, 0.2, 1.0]
    world.set_positions(flying, start + 0.999 * motion.first_time * (target - start))
    assert world.detect_motion().first_time == np.inf
    assert len(world.detect()) == 0


def test_queries_have_the_answers_of_closed_forms(two):
    world, left, right = two
    hits = world.cast_rays(np.array([[0.1, 0.1, 5.0], [9.0, 9.0, 5.0]]), np.array([[0.1, 0.1, -5.0], [9.0, 9.0, -5.0]]))
    assert hits.bodies[0] == left.index and hits.bodies[1] == hits.facets[1] == -1
    assert 5.0 - 10.0 * hits.fractions[0] == pytest.approx(0.8, abs=1e-12)
    assert len(world.cast_ray_all([0.1, 0.1, 5.0], [0.1, 0.1, -5.0])) == 2
    closest = world.closest_points(np.array([[0.1, 0.1, -2.0]]))
    assert closest.distances[0] == pytest.approx(2.0, abs=1e-14) and closest.barycentric[0].sum() == pytest.approx(1.0)
    assert closest.bodies[0] == left.index
    assert world.closest_points(np.array([[0.1, 0.1, -2.0]]), within=1.0).facets[0] == -1
    assert world.bodies_containing([0.1, 0.1, 0.1]) == [left]
    assert world.bodies_containing([0.92, 0.02, 0.02]) == [left, right]
    assert world.bodies_containing([0.92, 0.02, 0.02], mask=0) == []
    np.testing.assert_array_equal(np.unique(world.overlap_box([-1, -1, -1], [2, 2, 2])[:, 0]), [left.index, right.index])
    with pytest.raises(tact.Error, match="query 0: the beginning of a ray has x = nan"):
        world.cast_rays(np.array([[np.nan, 0, 0]]), np.zeros((1, 3)))


def test_rigid_bodies_move_by_poses():
    positions, facets = tetrahedron()
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    world, other = tact.World(), tact.World()
    rigid = [world.add_body(positions, facets, motion=tact.Motion.rigid) for _ in range(2)]
    plain = [other.add_body(positions, facets) for _ in range(2)]
    world.set_poses({rigid[0]: (turn, [0.5, 0.25, 0.0]), rigid[1]: (np.eye(3), [0.25, 0.25, 0.25])})
    other.set_positions(plain[0], np.ascontiguousarray(positions @ turn.T + [0.5, 0.25, 0.0]))
    other.set_positions(plain[1], positions + 0.25)
    np.testing.assert_array_equal(world.positions(rigid[0]), other.positions(plain[0]))
    assert world.detect().hash() == other.detect().hash()
    before = world.detect().hash()
    world.set_poses(rigid, np.array([np.eye(3), turn]), np.zeros((2, 3)))
    np.testing.assert_array_equal(world.positions(rigid[1]), positions @ turn.T)
    assert world.detect().hash() != before
    world.set_poses(rigid[::-1], np.array([np.eye(3), turn]), [[0.25, 0.25, 0.25], [0.5, 0.25, 0.0]])
    np.testing.assert_array_equal(world.positions(rigid[0]), other.positions(plain[0]))
    world.set_pose(rigid[0], np.eye(3), [9, 0, 0])
    assert len(world.detect().contacts) == 0
    assert world.motion(rigid[0]) == tact.Motion.rigid
    for pose, code in [((2 * np.eye(3), [0, 0, 0]), "not_a_rotation"), ((np.eye(3), [np.nan, 0, 0]), "non_finite_position")]:
        with pytest.raises(tact.Error) as error:
            world.set_pose(rigid[0], *pose)
        assert error.value.code.name == code
    with pytest.raises(tact.Error, match="is rigid"):
        world.set_positions(rigid[0], positions)
    with pytest.raises(tact.Error, match="is not rigid"):
        other.set_pose(plain[0], np.eye(3), [0, 0, 0])


def test_many_queries_at_once(two):
    world, left, right = two
    lower, upper = np.array([[-1.0, -1, -1], [50, 50, 50]]), np.array([[2.0, 2, 2], [51, 51, 51]])
    answers = world.overlap_boxes(lower, upper)
    np.testing.assert_array_equal(answers[0], world.overlap_box(lower[0], upper[0]))
    assert len(answers[0]) > 0 and answers[1].shape == (0, 2)
    assert world.bodies_containing_each(np.array([[0.1, 0.1, 0.1], [0.92, 0.02, 0.02], [9, 9, 9]])) == [[left], [left, right], []]


def test_a_restored_world_goes_on_as_the_one_that_was_saved(two):
    world, left, right = two
    world.detect()
    saved = world.save()
    assert isinstance(saved, bytes)
    world.remove_body(left)
    report = world.detect()
    world.restore(saved)
    with pytest.raises(tact.StaleReportError):
        report.contacts
    assert world.contains(left)
    other = tact.World()
    other.restore(saved)
    assert other.save() == saved and other.name(other.bodies[0]) == "left"
    hashes = []
    for one in (world, other):
        one.set_positions(one.bodies[1], tetrahedron(0.8)[0])
        hashes.append([one.detect().hash(), one.detect().contacts[0].hash()])
    assert hashes[0] == hashes[1]
    with pytest.raises(tact.Error) as refused:
        world.restore(saved[:-1])
    assert refused.value.code == tact.ErrorCode.bad_state


def test_keys_order_bodies():
    world = tact.World()
    first = world.add_body(*tetrahedron(0.0), key=2**40)
    second = world.add_body(*tetrahedron(0.9), key=7)
    (contact,) = world.detect().contacts
    assert (contact.a, contact.b) == (second, first) and world.key(first) == 2**40
    with pytest.raises(tact.Error, match="key 7"):
        world.add_body(*tetrahedron(0.9), key=7)
