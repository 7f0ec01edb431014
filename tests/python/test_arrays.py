"""Whatever numpy makes an array of is taken where it means one thing, and gives the same body."""

import array
from fractions import Fraction

import numpy as np
import pytest
import tact
from shapes import grid, tetrahedron

POSITIONS, FACETS = tetrahedron()
XYZ = [("x", "f8"), ("y", "f8"), ("z", "f8")]


def fields(rows, dtype):
    made = np.zeros(len(rows), dtype)
    for k, name in enumerate("xyz"):
        made[name] = rows[:, k]
    return made


class Vector:
    """What other libraries have: three numbers that can be iterated over."""

    def __init__(self, numbers):
        self.numbers = numbers

    def __len__(self):
        return 3

    def __getitem__(self, i):
        return self.numbers[i]


class Wrapper:
    def __array__(self, dtype=None, copy=None):
        return POSITIONS


wide = np.full((8, 7), np.nan)
wide[::2, 1:6:2] = POSITIONS
odd = np.zeros(POSITIONS.nbytes + 1, np.uint8)[1:].view(np.float64).reshape(-1, 3)
odd[:] = POSITIONS
vertices = np.zeros(4, [("normal", "f4", (3,)), ("place", "f8", (3,)), ("flag", "u1")])
vertices["place"] = POSITIONS

POSITIONS_TAKEN = {
    "itself": POSITIONS,
    "by columns": np.asfortranarray(POSITIONS),
    "backwards": POSITIONS[::-1].copy()[::-1],
    "each second, in wider rows": wide[::2, 1:6:2],
    "columns backwards": POSITIONS[:, ::-1].copy()[:, ::-1],
    "part of wider rows": np.hstack([POSITIONS, POSITIONS])[:, :3],
    "not aligned": odd,
    "the other byte order": POSITIONS.astype(">f8"),
    "float32": POSITIONS.astype(np.float32),
    "float32 in wider rows": np.hstack([POSITIONS, POSITIONS]).astype(np.float32)[:, 3:],
    "float16": POSITIONS.astype(np.float16),
    "integers": POSITIONS.astype(np.int64),
    "small integers": POSITIONS.astype(np.uint8),
    "a list": POSITIONS.tolist(),
    "a list of integers": POSITIONS.astype(int).tolist(),
    "tuples": tuple(map(tuple, POSITIONS)),
    "a list of arrays": list(POSITIONS),
    "a list of sequences": [Vector(row) for row in POSITIONS],
    "a buffer": memoryview(array.array("d", POSITIONS.ravel())).cast("B").cast("d", shape=[4, 3]),
    "an object with an array": Wrapper(),
    "no value masked": np.ma.array(POSITIONS),
    "read only": np.frombuffer(POSITIONS.tobytes()).reshape(4, 3),
    "fields x, y, z": fields(POSITIONS, XYZ),
    "fields among others, in another order": fields(POSITIONS, [("z", "f4"), ("id", "i8"), ("x", "f4"), ("y", "f4")]),
    "records": fields(POSITIONS, XYZ).view(np.recarray),
    "one field of three": np.array(list(zip(POSITIONS)), [("p", "f8", (3,))]),
    "a field of wider ones": vertices["place"],
}
POSITIONS_REFUSED = {
    "more digits than a float64": (POSITIONS.astype(np.longdouble), TypeError, "positions holds float128"),
    "a large integer": (np.full((4, 3), -(2**53) - 1), ValueError, "-9007199254740993, which no float64 is"),
    "the largest integer": (np.full((4, 3), 2**64 - 1, np.uint64), ValueError, "18446744073709551615, which no"),
    "complex": (POSITIONS.astype(complex), TypeError, "complex128"),
    "booleans": (POSITIONS.astype(bool), TypeError, "bool"),
    "words": (POSITIONS.astype(str).tolist(), TypeError, "<U"),
    "fractions": ([[Fraction(1, 3)] * 3] * 4, TypeError, "object"),
    "times": (POSITIONS.astype("m8[s]"), TypeError, "timedelta64"),
    "masked": (np.ma.masked_equal(POSITIONS, 1.0), ValueError, "masked values"),
    "rows of two lengths": ([[0, 0, 0], [1, 0]], ValueError, "positions is no array"),
    "none": (None, TypeError, "is a NoneType"),
    "a word": ("positions", TypeError, "is a str"),
    "a generator": ((row for row in POSITIONS), TypeError, "is a generator"),
    "a dict": ({0: POSITIONS}, TypeError, "is a dict"),
    "the transpose": (POSITIONS.T, ValueError, r"shape \(3, 4\), not \(V, 3\): pass its transpose"),
    "flat": (POSITIONS.ravel(), ValueError, r"shape \(12,\)"),
    "of three dimensions": (POSITIONS[None], ValueError, r"shape \(1, 4, 3\)"),
    "other fields": (np.zeros(4, [("u", "f8"), ("v", "f8"), ("w", "f8")]), TypeError, "fields .'u', 'v', 'w'., not x, y and z"),
    "fields of two types": (fields(POSITIONS, [("x", "f8"), ("y", "i8"), ("z", "f8")]), TypeError, "different types"),
    "fields of words": (fields(POSITIONS, [("x", "U3"), ("y", "U3"), ("z", "U3")]), TypeError, "<U3"),
}
LONG = np.zeros(4, [("count", "u1"), ("corners", "i4", (3,))])
LONG["corners"] = FACETS
FACETS_TAKEN = {
    "by columns": np.asfortranarray(FACETS),
    "a list": FACETS.tolist(),
    "in wider rows": np.hstack([FACETS, FACETS])[:, 3:],
    "backwards": FACETS[::-1].copy()[::-1],
    "the other byte order": FACETS.astype(">i4"),
    "three fields": FACETS.view([("a", "i4"), ("b", "i4"), ("c", "i4")]).ravel(),
    "a field of a file's": LONG["corners"],
    **{name: FACETS.astype(name) for name in ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64")},
}
FACETS_REFUSED = {
    "2^63": (FACETS.astype(np.uint64) + np.uint64(2**63), "vertex 9223372036854775808,"),
    "2^64 - 1": (np.full((4, 3), 2**64 - 1, np.uint64), "vertex 18446744073709551615,"),
    "-2^63": (np.full((4, 3), -(2**63)), "vertex -9223372036854775808,"),
    "2^31": (FACETS.astype(np.uint32) + np.uint32(2**31), "facet 0 names vertex 2147483648,"),
    "2^40": (FACETS.astype(np.int64) + 2**40, "facet 0 names vertex 1099511627776,"),
    "in a list": ([[0, 1, 2], [0, 1, 2**40]], "facet 1 names vertex 1099511627776,"),
    "floats": (FACETS.astype(float), "facets holds float64, not integers"),
    "booleans": (FACETS.astype(bool), "facets holds bool, not integers"),
    "beyond all integers": ([[0, 1, 2**70]], "facets holds object, not integers"),
    "two fields": (LONG, "fields .'count', 'corners'., not three"),
    "two numbers": (FACETS[:, :2], r"shape \(4, 2\), not \(F, 3\)"),
}


def body(positions, facets):
    world = tact.World()
    added = world.add_body(positions, facets)
    return world.positions(added), world.facets(added)


@pytest.mark.parametrize("what", POSITIONS_TAKEN)
def test_positions_that_mean_one_thing_are_taken(what):
    given = POSITIONS_TAKEN[what]
    np.testing.assert_array_equal(body(given, FACETS)[0], POSITIONS)
    world = tact.World()
    other, moved = (world.add_body(POSITIONS + far, FACETS) for far in (0.5, 9))
    world.set_positions({other: given, moved: given})
    np.testing.assert_array_equal(world.positions(other), POSITIONS)
    assert world.closest_points(given).distances.max() == 0


@pytest.mark.parametrize("what", POSITIONS_REFUSED)
def test_other_positions_are_refused_by_name(what):
    given, error, says = POSITIONS_REFUSED[what]
    with pytest.raises(error, match=says):
        tact.World().add_body(given, FACETS)
    with pytest.raises(error, match=says.replace("positions", "points")):
        tact.World().closest_points(given)


@pytest.mark.parametrize("what", FACETS_TAKEN)
def test_facets_that_mean_one_thing_are_taken(what):
    np.testing.assert_array_equal(body(POSITIONS, FACETS_TAKEN[what])[1], FACETS)


@pytest.mark.parametrize("what", FACETS_REFUSED)
def test_other_facets_are_refused_by_name(what):
    given, says = FACETS_REFUSED[what]
    with pytest.raises((TypeError, ValueError), match=says):
        tact.World().add_body(POSITIONS, given)


def test_empty_lists_are_a_body_without_facets():
    positions, facets = body([], [])
    assert positions.shape == facets.shape == (0, 3)


def test_a_row_shown_many_times_is_taken():
    positions, _ = body(np.broadcast_to(POSITIONS[1], (4, 3)), FACETS)
    np.testing.assert_array_equal(positions, POSITIONS[[1, 1, 1, 1]])


def test_vectors_and_poses_are_taken_in_every_form():
    world = tact.World()
    rigid = world.add_body(POSITIONS, FACETS, motion=tact.Motion.rigid)
    turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    expected = POSITIONS @ turn.T + [1, 2, 3]
    for rotation in (turn, turn.tolist(), np.asfortranarray(turn), turn.astype("f4"), turn.astype(">f8")):
        for translation in ([1, 2, 3], (1, 2.0, 3), np.array([[1], [2], [3]]), np.array([1, 9, 2, 9, 3])[::2], array.array("d", [1, 2, 3])):
            world.set_pose(rigid, np.eye(3), [0, 0, 0])
            world.set_poses({rigid: (rotation, translation)})
            np.testing.assert_array_equal(world.positions(rigid), expected)
    for given, says in ((["a"] * 3, "translation holds <U1"), ([1, 2, 3j], "complex128"), ([1, 2], r"translation has shape \(2,\), not \(3,\)"), ([2**53 + 1, 0, 0], "no float64 is")):
        with pytest.raises((TypeError, ValueError), match=says):
            world.set_pose(rigid, turn, given)
    np.testing.assert_array_equal(world.positions(rigid), expected)


@pytest.mark.parametrize(
    "call, says",
    [
        (lambda w: w.set_positions({"b": POSITIONS}), "positions: the key 'b' is a str, not a tact.BodyId"),
        (lambda w: w.set_positions({0: POSITIONS}), "the key 0 is a int, not a tact.BodyId"),
        (lambda w: w.set_positions({None: POSITIONS}), "the key None is a NoneType"),
        (lambda w: w.set_poses({"b": (np.eye(3), np.zeros(3))}), "poses: the key 'b' is a str"),
        (lambda w: w.set_poses(["b"], [np.eye(3)], [np.zeros(3)]), "bodies: 'b' is a str"),
        (lambda w: w.set_poses({w.bodies[0]: np.eye(3)}), r"the pose of tact.BodyId\(.*\) is a ndarray, not \(rotation"),
        (lambda w: w.set_poses({w.bodies[0]: 7}), "is a int, not"),
        (lambda w: setattr(tact.Settings(), "on_message", 7), "on_message is a int, not a function or None"),
        (lambda w: tact.Settings(on_message="print"), "on_message is a str"),
    ],
)
def test_what_is_no_body_is_told(call, says):
    world = tact.World()
    world.add_body(POSITIONS, FACETS)
    with pytest.raises(TypeError, match=says):
        call(world)


def test_a_dict_that_changes_while_it_is_read_harms_nothing():
    world = tact.World()
    bodies = [world.add_body(POSITIONS + 3 * k, FACETS) for k in range(40)]
    given = {}

    class Clearing:
        def __array__(self, dtype=None, copy=None):
            given.clear()
            given.update({k: None for k in range(1000)})
            return POSITIONS

    given.update({body: Clearing() for body in bodies})
    world.set_positions(given)
    for body_id in bodies:
        np.testing.assert_array_equal(world.positions(body_id), POSITIONS)


class OverDlpack:
    """An array that speaks DLPack alone, on a device."""

    def __init__(self, array, device=1):
        self.array, self.device = array, device

    def __dlpack__(self, **options):
        return self.array.__dlpack__(**options)

    def __dlpack_device__(self):
        return (self.device, 0)


def test_dlpack_of_host_memory():
    positions, facets = grid(4)
    world = tact.World()
    body = world.add_body(OverDlpack(positions), OverDlpack(facets), surface=tact.Surface.sheet)
    world.set_positions(body, OverDlpack(positions + 1.0))
    assert (world.positions(body) == positions + 1.0).all()


@pytest.mark.parametrize("device, name", [(2, "CUDA"), (10, "ROCm"), (8, "Metal"), (77, "77")])
def test_memory_of_devices_is_refused_by_name(device, name):
    positions, facets = grid(4)
    with pytest.raises(TypeError, match=f"positions lies in memory of device {name}, not of the host"):
        tact.World().add_body(OverDlpack(positions, device), facets)


def test_cuda_arrays_are_refused_by_name():
    class Cuda:
        __cuda_array_interface__ = {}

    with pytest.raises(TypeError, match="device CUDA"):
        tact.World().add_body(Cuda(), grid(4)[1])


def test_rows_that_share_numbers_are_copied():
    numbers = np.random.default_rng(7).uniform(size=40)
    window = np.lib.stride_tricks.sliding_window_view(numbers, 3)[:4]
    world = tact.World()
    _, facets = tetrahedron()
    body = world.add_body(window, facets)
    assert world.positions(body).tolist() == window.tolist()
