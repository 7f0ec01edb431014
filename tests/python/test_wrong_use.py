"""Wrong use is a clear exception, and the world is as it was."""

import subprocess
import sys
import threading

import numpy as np
import pytest
import tact
from shapes import grid, tetrahedron

POSITIONS, FACETS = tetrahedron()


@pytest.fixture
def world():
    return tact.World()


@pytest.mark.parametrize(
    "given, exception, says",
    [
        ([[0, 0, 0]], tact.Error, "1 positions"),
        (POSITIONS.astype(bool), TypeError, "bool"),
        (POSITIONS.T, ValueError, "transpose"),
        (POSITIONS.ravel(), ValueError, r"\(12,\)"),
        (POSITIONS * np.nan, tact.Error, "vertex 0 has x"),
        (POSITIONS[:3], tact.Error, "3 positions"),
    ],
)
def test_bad_positions_are_refused(world, given, exception, says):
    body = world.add_body(POSITIONS, FACETS)
    other = world.add_body(POSITIONS + [0.5, 0, 0], FACETS)
    before = world.detect().hash()
    with pytest.raises(exception, match=says):
        world.set_positions(body, given)
    with pytest.raises(exception, match=says):
        world.set_positions({other: POSITIONS, body: given})
    assert world.detect().hash() == before


@pytest.mark.parametrize("given", [FACETS + 100, -FACETS])
def test_facets_of_vertices_that_are_none_are_refused(world, given):
    with pytest.raises(tact.Error, match="facet 0 names vertex"):
        world.add_body(POSITIONS, given)
    assert len(world) == 0


def test_errors_have_a_code(world):
    body = world.add_body(POSITIONS, FACETS)
    world.remove_body(body)
    with pytest.raises(tact.Error) as raised:
        world.name(body)
    assert raised.value.code == tact.ErrorCode.stale_body
    with pytest.raises(tact.Error) as raised:
        tact.World().name(tact.World().add_body(POSITIONS, FACETS))
    assert raised.value.code == tact.ErrorCode.foreign_body
    with pytest.raises(tact.Error) as raised:
        tact.World(tact.Settings(threads=-1))
    assert raised.value.code == tact.ErrorCode.bad_settings


def test_a_report_kept_over_a_step_says_so(world):
    world.add_body(POSITIONS, FACETS)
    world.add_body(POSITIONS + [0.5, 0, 0], FACETS)
    report = world.detect()
    contact = report.contacts[0]
    world.detect()
    for use in (lambda: report.contacts, lambda: contact.depth, lambda: contact.facet_pairs, lambda: repr(contact), lambda: len(report)):
        with pytest.raises(tact.StaleReportError, match="earlier step"):
            use()
    report = world.detect()
    world.set_settings(tact.Settings())
    with pytest.raises(tact.StaleReportError):
        report.hash()


def test_a_report_keeps_its_world_alive():
    world = tact.World()
    for x in (0.0, 0.5):
        world.add_body(*tetrahedron(x))
    report = world.detect()
    del world
    assert report.contacts[0].depth > 0


def test_an_array_may_change_or_go_after_it_was_given(world):
    positions = POSITIONS.copy()
    world.add_body(positions, FACETS)
    other = POSITIONS + [0.5, 0, 0]
    world.add_body(other, FACETS)
    before = world.detect().hash()
    positions[:] = np.nan
    del positions, other
    assert world.detect().hash() == before


def test_the_interpreter_ends_with_worlds_alive():
    program = (
        "import numpy as np, tact, threading\n"
        "world = tact.World(tact.Settings(threads=2))\n"
        "facets = np.array([[0, 1, 2]])\n"
        "for k in range(50): world.add_body(np.random.default_rng(k).random((3, 3)), facets, surface=tact.Surface.sheet)\n"
        "report = world.detect()\n"
        "kept = [contact.facet_pairs for contact in report.contacts], report.contacts\n"
        "threading.Thread(target=lambda: [world.detect() for k in range(1000)], daemon=True).start()\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_a_removed_body_is_refused_by_every_call(world):
    body = world.add_body(POSITIONS, FACETS)
    world.remove_body(body)
    kept = world.add_body(POSITIONS, FACETS)
    calls = [
        lambda: world.remove_body(body),
        lambda: world.set_positions(body, POSITIONS),
        lambda: world.set_positions({kept: POSITIONS + 9, body: POSITIONS}),
        lambda: world.set_facets(body, POSITIONS, FACETS, range(len(POSITIONS))),
        lambda: world.set_pose(body, np.eye(3), np.zeros(3)),
        lambda: world.set_poses([body], [np.eye(3)], [np.zeros(3)]),
        lambda: world.set_layers(body, 1, 1),
        lambda: world.set_motion(body, tact.Motion.fixed),
        lambda: world.set_margin(body, 0.1),
        lambda: world.set_self_contact(body, True),
    ]
    calls += [lambda ask=ask: getattr(world, ask)(body) for ask in ("name", "surface", "motion", "layer", "mask", "margin", "vertex_count")]
    for call in calls:
        with pytest.raises(tact.Error) as raised:
            call()
        assert raised.value.code == tact.ErrorCode.stale_body
    assert not world.contains(body) and world.bodies == [kept]
    assert len(world.overlap_box([-1, -1, -1], [2, 2, 2])) == len(FACETS)  # the other has not moved


@pytest.mark.parametrize(
    "call, exception, says",
    [
        (lambda w, b: w.set_positions(7, POSITIONS), TypeError, "incompatible"),
        (lambda w, b: w.set_positions(b), TypeError, "incompatible"),
        (lambda w, b: w.set_positions({b: None}), TypeError, "NoneType"),
        (lambda w, b: w.set_facets(b, POSITIONS, FACETS, [0, 1]), tact.Error, "the vertex map has 2 entries"),
        (lambda w, b: w.set_facets(b, POSITIONS, FACETS, np.full(len(POSITIONS), 99)), tact.Error, "vertex 99"),
        (lambda w, b: w.set_facets(b, POSITIONS, FACETS, np.zeros(len(POSITIONS))), TypeError, "holds float64"),
        (lambda w, b: w.set_facets(b, POSITIONS, FACETS, [[0]]), ValueError, "shape"),
        (lambda w, b: w.set_facets(b, POSITIONS, FACETS, np.full(len(POSITIONS), 1 << 40)), ValueError, "no body can have"),
        (lambda w, b: w.set_margin(b, float("nan")), tact.Error, "margin"),
        (lambda w, b: w.set_margin(b, -1.0), tact.Error, "margin"),
        (lambda w, b: w.set_rest_offset(b, 1e9), tact.Error, "rest offset"),
        (lambda w, b: w.set_rest_offset(b, "thick"), TypeError, "rest_offset"),
        (lambda w, b: w.set_feature_settings(b, rest_offsets=[0.1]), tact.Error, "rest offsets"),
        (lambda w, b: w.set_feature_settings(b, vertex_labels=[0.5]), TypeError, "vertex_labels holds float64"),
        (lambda w, b: w.set_feature_settings(b, facet_labels=[1 << 32]), ValueError, "not 0 to 4294967295"),
        (lambda w, b: w.set_feature_settings(b, vertex_masks=[[1]]), ValueError, "shape"),
        (lambda w, b: w.set_feature_settings(b, facet_masks=[0.5]), TypeError, "facet_masks holds float64"),
        (lambda w, b: w.set_feature_settings(b, margins=[0.0]), tact.Error, "margins of vertices"),
        (lambda w, b: w.set_self_contact_filter(b, rings=17), tact.Error, "rings"),
        (lambda w, b: w.set_self_contact_filter(b, rest_positions=[[0, 0]]), ValueError, "shape"),
        (lambda w, b: w.set_excluded_labels(b, 0, b, 1, True), tact.Error, "label 0"),
        (lambda w, b: w.labels(b, [[99, -1, -1]]), tact.Error, "vertex 99"),
        (lambda w, b: w.add_body(POSITIONS, FACETS, surface="sheet"), TypeError, "incompatible"),
        (lambda w, b: w.add_body(POSITIONS, FACETS, layer=-1), TypeError, "incompatible"),
        (lambda w, b: w.add_body(np.empty((0, 3)), FACETS), tact.Error, "facet 0 names vertex"),
        (lambda w, b: w.cast_rays(POSITIONS, POSITIONS[:2]), (ValueError, tact.Error), ""),
        (lambda w, b: w.cast_rays(POSITIONS[:, :2], POSITIONS[:, :2]), ValueError, "shape"),
        (lambda w, b: w.closest_points(POSITIONS + np.inf), tact.Error, "query 0"),
        (lambda w, b: w.overlap_box([0, 0], [1, 1]), (TypeError, ValueError), ""),
        (lambda w, b: w.overlap_boxes(POSITIONS, POSITIONS[:2]), ValueError, "different lengths"),
        (lambda w, b: w.overlap_boxes(POSITIONS + 1, POSITIONS), tact.Error, "query 0"),
        (lambda w, b: w.bodies_containing_each(POSITIONS * np.nan), tact.Error, "query 0"),
        (lambda w, b: w.bodies_containing_each(POSITIONS[0]), ValueError, "shape"),
        (lambda w, b: tact.Settings(threads="two"), TypeError, "incompatible"),
        (lambda w, b: w.find_contact, AttributeError, "find_contact"),
    ],
)
def test_wrong_arguments_are_refused(world, call, exception, says):
    body = world.add_body(POSITIONS, FACETS)
    world.add_body(POSITIONS + [0.5, 0, 0], FACETS)
    before = world.detect().hash()
    with pytest.raises(exception, match=says):
        call(world, body)
    assert world.detect().hash() == before


@pytest.mark.parametrize(
    "rotation, translation, code",
    [
        (1.001 * np.eye(3), np.zeros(3), "not_a_rotation"),
        (np.diag([1.0, 1.0, -1.0]), np.zeros(3), "not_a_rotation"),
        (np.full((3, 3), np.nan), np.zeros(3), "not_a_rotation"),
        (np.eye(3), np.array([0, np.inf, 0]), "non_finite_position"),
        (np.eye(3), np.array([0, 0, 1e200]), "position_out_of_range"),
        (np.eye(2), np.zeros(3), None),
        (np.eye(3), np.zeros(2), None),
        (np.eye(4), np.zeros(4), None),
    ],
)
def test_bad_poses_are_refused(world, rotation, translation, code):
    first, second = (world.add_body(POSITIONS, FACETS, motion=tact.Motion.rigid) for _ in range(2))
    good, bad = (np.eye(3), [5, 0, 0]), (rotation, translation)
    calls = [lambda: world.set_pose(second, *bad), lambda: world.set_poses({first: good, second: bad})]
    if code is None:
        calls.append(lambda: world.set_poses([second], [rotation], [translation]))
    else:
        calls.append(lambda: world.set_poses([first, second], [good[0], rotation], [good[1], translation]))
    for call in calls:
        with pytest.raises((TypeError, ValueError) if code is None else tact.Error) as raised:
            call()
        assert code is None or raised.value.code.name == code
        np.testing.assert_array_equal(world.positions(first), POSITIONS)


def test_poses_of_wrong_bodies_are_refused(world):
    rigid = world.add_body(POSITIONS, FACETS, motion=tact.Motion.rigid)
    plain = world.add_body(POSITIONS, FACETS)
    eyes, zeros = np.array([np.eye(3)] * 2), np.ones((2, 3))
    for bodies, code in (([rigid, plain], "wrong_motion"), ([rigid, rigid], "wrong_order")):
        with pytest.raises(tact.Error) as raised:
            world.set_poses(bodies, eyes, zeros)
        assert raised.value.code.name == code
    with pytest.raises(ValueError, match=r"rotations has shape \(2, 3, 3\), not \(1, 3, 3\)"):
        world.set_poses([rigid], eyes, zeros)
    with pytest.raises(ValueError, match=r"translations has shape \(2, 3\), not \(1, 3\)"):
        world.set_poses([rigid], eyes[:1], zeros)
    world.set_motion(rigid, tact.Motion.fixed)
    with pytest.raises(tact.Error) as raised:
        world.set_pose(rigid, np.eye(3), np.ones(3))
    assert raised.value.code == tact.ErrorCode.fixed_body
    np.testing.assert_array_equal(world.positions(rigid), POSITIONS)
    world.set_motion(rigid, tact.Motion.rigid)
    world.set_poses([], np.zeros((0, 3, 3)), np.zeros((0, 3)))


def test_an_array_that_another_thread_writes_to_is_taken_or_refused(world):
    positions, facets = grid(200)
    body = world.add_body(positions, facets, surface=tact.Surface.sheet)
    done = threading.Event()

    def write():
        while not done.is_set():
            positions[::2, 2] = np.nan
            positions[::2, 2] = 0.0

    writing = threading.Thread(target=write)
    writing.start()
    try:
        for _ in range(100):
            try:
                world.set_positions(body, positions)
            except tact.Error as error:
                assert error.code == tact.ErrorCode.non_finite_position
    finally:
        done.set()
        writing.join()
    world.set_positions(body, grid(200)[0])
    assert len(world.detect()) == 0


def test_two_threads_in_one_world_are_refused_and_harm_nothing():
    world = tact.World(tact.Settings(threads=2))
    sheets = [grid(40) for _ in range(4)]
    for k, (positions, _) in enumerate(sheets):  # each tilted, so that all cross along one line
        positions[:, 2] = 0.1 * k * (positions[:, 0] - 1.95)
    bodies = [world.add_body(*sheet, surface=tact.Surface.sheet) for sheet in sheets]
    wrong, other = [], []

    def use(k):
        for step in range(200):
            try:
                world.set_positions(bodies[k], sheets[k][0] + [0, 0, 1e-3 * (step % 7)])
                world.detect().contacts
            except tact.Error as error:
                wrong.append(error.code)
            except tact.StaleReportError:  # the other has stepped in between
                pass
            except BaseException as error:  # noqa: BLE001: whatever it is, the test shows it
                other.append(error)

    threads = [threading.Thread(target=use, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not other and set(wrong) <= {tact.ErrorCode.wrong_order}
    world.set_positions({body: sheet[0] for body, sheet in zip(bodies, sheets)})
    fresh = tact.World(tact.Settings(threads=1))
    for sheet in sheets:
        fresh.add_body(*sheet, surface=tact.Surface.sheet)
    found, expected = world.detect().contacts, fresh.detect().contacts
    assert len(found) == len(expected) == 6
    for contact, same in zip(found, expected):
        assert len(contact.facet_pairs) > 0
        np.testing.assert_array_equal(contact.facet_pairs, same.facet_pairs)


def test_a_motion_report_kept_over_the_next_says_so_or_is_whole(world):
    body = world.add_body(POSITIONS, FACETS)
    world.add_body(POSITIONS + [3, 0, 0], FACETS)
    world.detect()
    world.set_positions(body, POSITIONS + [6, 0, 0])
    motion = world.detect_motion()
    times, first = motion.times.copy(), motion.first_time
    world.set_positions(body, POSITIONS)
    world.detect_motion()
    world.detect()
    try:
        np.testing.assert_array_equal(motion.times, times)
        assert motion.first_time == first
    except tact.StaleReportError:
        pass
