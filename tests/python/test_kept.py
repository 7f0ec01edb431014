"""What Python keeps of a world, and what it runs inside its calls, harms nothing."""

import copy
import gc
import pickle
import subprocess
import sys
import threading

import numpy as np
import pytest
import tact
from shapes import grid, tetrahedron


def sheets(count=4, side=8):
    """Sheets one above the other, which have some hundred contact points."""
    world = tact.World(tact.Settings(threads=1, points=True, patches=True))
    positions, facets = grid(side)
    bodies = [world.add_body(positions + [0, 0, 0.0005 * k], facets, surface=tact.Surface.sheet, margin=0.01) for k in range(count)]
    return world, bodies


class Drawer:
    """Calls `then` at the line of a number, and keeps what it raised."""

    def __init__(self, then, at=200):
        self.then, self.at, self.lines, self.raised = then, at, 0, None

    def line(self, p, q, color):
        self.lines += 1
        if self.lines == self.at:
            try:
                self.then()
            except tact.Error as error:
                self.raised = error

    def triangle(self, p, q, r, color):
        pass

    def text(self, at, words, color):
        pass


CHANGES = {
    "set_settings": lambda w, b: w.set_settings(tact.Settings()),
    "detect": lambda w, b: w.detect(),
    "detect_motion": lambda w, b: w.detect_motion(),
    "add_body": lambda w, b: w.add_body(*tetrahedron()),
    "remove_body": lambda w, b: w.remove_body(b[0]),
    "set_positions": lambda w, b: w.set_positions(b[1], w.positions(b[1]) + 1),
    "set_many_positions": lambda w, b: w.set_positions({b[1]: w.positions(b[1]) + 1}),
    "set_facets": lambda w, b: w.set_facets(b[1], w.positions(b[1]), w.facets(b[1]), np.arange(len(w.positions(b[1])))),
    "set_margin": lambda w, b: w.set_margin(b[2], 0.0),
    "set_rest_offset": lambda w, b: w.set_rest_offset(b[2], None),
    "set_feature_settings": lambda w, b: w.set_feature_settings(b[1], vertex_labels=np.arange(len(w.positions(b[1])))),
    "set_self_contact": lambda w, b: w.set_self_contact(b[2], True),
    "set_self_contact_filter": lambda w, b: w.set_self_contact_filter(b[2], rings=1),
    "set_excluded_labels": lambda w, b: w.set_excluded_labels(b[2], 1, b[3], 2, True),
    "set_motion": lambda w, b: w.set_motion(b[2], tact.Motion.fixed),
    "set_layers": lambda w, b: w.set_layers(b[2], 1, 1),
    "set_group": lambda w, b: w.set_group(b[2], 1),
    "set_excluded": lambda w, b: w.set_excluded(b[2], b[3], True),
    "stop_recording": lambda w, b: w.stop_recording(),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_drawer_cannot_change_what_it_draws(change):
    world, bodies = sheets()
    report = world.detect()
    quiet = Drawer(lambda: None)
    world.debug_draw(report, quiet)
    drawer = Drawer(lambda: CHANGES[change](world, bodies))
    world.debug_draw(report, drawer)
    assert drawer.raised.code == tact.ErrorCode.wrong_order and "the call that this one comes from" in str(drawer.raised)
    assert drawer.lines == quiet.lines
    CHANGES[change](world, bodies)  # afterwards it may


def test_a_drawer_can_read_what_it_draws():
    world, bodies = sheets()
    report, seen = world.detect(), []

    def read():
        seen.append((world.name(bodies[0]), world.positions(bodies[0]).shape, world.settings.threads, len(world)))
        seen.append((report.hash(), len(report.contacts), report.contacts[0].depth, len(report.contacts[0].points)))
        seen.append(world.closest_points([[0, 0, 0]]).distances[0])
        world.debug_draw(report, Drawer(lambda: None))

    world.debug_draw(report, Drawer(read))
    assert len(seen) == 3


def test_what_a_drawer_raises_comes_out():
    world, _ = sheets()
    report = world.detect()
    with pytest.raises(ZeroDivisionError):
        world.debug_draw(report, Drawer(lambda: 1 / 0))
    world.debug_draw(report, Drawer(lambda: None))


def test_another_thread_cannot_change_what_is_drawn():
    world, _ = sheets()
    report, codes = world.detect(), []

    def step():
        with pytest.raises(tact.Error) as raised:
            world.detect()
        codes.append(raised.value.code)

    def start_and_wait():
        thread = threading.Thread(target=step)
        thread.start()
        thread.join()

    world.debug_draw(report, Drawer(start_and_wait))
    assert codes == [tact.ErrorCode.wrong_order]


def test_the_report_of_another_world_is_not_drawn():
    world, _ = sheets()
    other, _ = sheets()
    with pytest.raises(tact.Error):
        other.debug_draw(world.detect(), Drawer(lambda: other.detect()))


class Finalized:
    """Garbage in a cycle: its finalizer runs inside what allocates next, and leaves such garbage behind."""

    def __init__(self, then, left):
        self.me, self.then, self.left = self, then, left

    def __del__(self):
        if self.left > 0:
            Finalized(self.then, self.left - 1)
        try:
            self.then()
        except (tact.Error, tact.StaleReportError):
            pass


READS = {
    "points": lambda report, contact: contact.points,
    "patches": lambda report, contact: contact.patches,
    "candidate_pairs": lambda report, contact: report.candidate_pairs,
}


def numbers(read):
    """What was read as numbers, without asking the world."""
    if isinstance(read, tact.ContactPoints):
        return [getattr(read, name).tolist() for name in ("kinds", "patches", "a_vertices", "b_vertices", "a_weights", "b_weights", "normals", "gaps", "ids")]
    if isinstance(read[0], tact.Patch):
        return [[patch.depth, patch.area, patch.points.tolist(), patch.direction.tolist(), patch.spanning.tolist()] for patch in read]
    return [(a.index, b.index, overlap) for a, b, overlap in read]


@pytest.mark.parametrize("read", READS)
def test_a_finalizer_that_steps_cannot_change_what_is_read(read):
    world, bodies = sheets(5, side=4)
    positions = [world.positions(body) for body in bodies]

    def step():
        for body, at in zip(bodies, positions):
            world.set_positions(body, at + ([0, 0, 9 + 9 * body.index] if body.index < 2 else [0.01 * body.index, 0, 0]))  # others meet
        for _ in range(3):
            world.set_positions(bodies[4], positions[4] + [0.02, 0.01, 0])
            world.detect()
            world.set_positions(bodies[4], positions[4])
            world.detect()

    def near():
        step()
        for body, at in zip(bodies, positions):
            world.set_positions(body, at)
        report = world.detect()
        return report, report.contacts[-1]

    expected = numbers(READS[read](*near()))
    limits = gc.get_threshold()
    for early in range(16):  # or late
        shown = near()
        gc.collect()  # counts begin again
        Finalized(step, 10)
        try:
            gc.set_threshold(early + 1)
            found = READS[read](*shown)
        except tact.StaleReportError:  # the step came before
            continue
        finally:
            gc.set_threshold(*limits)
        assert numbers(found) == expected


class Crowd:
    """A world whose every step reaches limits."""

    def __init__(self, on_message):
        self.random, facets = np.random.default_rng(1), np.array([[i, i + 1, i + 2] for i in range(38)])
        self.world = tact.World(tact.Settings(threads=1, iteration_limit=1))
        self.bodies = [self.world.add_body(self.random.random((40, 3)), facets) for _ in range(10)]
        self.world.detect()
        self.world.set_settings(tact.Settings(threads=1, iteration_limit=1, on_message=on_message))

    def step(self):
        self.world.set_positions({body: self.random.random((40, 3)) for body in self.bodies})
        return self.world.detect()


def test_messages_can_be_kept():
    kept, texts = [], []

    def tell(message):
        kept.append(message)
        texts.append(message.text)

    crowd = Crowd(tell)
    for _ in range(4):
        crowd.step()
    del crowd
    gc.collect()
    assert len(kept) > 20
    assert [message.text for message in kept] == texts
    assert all(message.text in repr(message) and message.text.startswith('body ') and message.a < message.b for message in kept)


@pytest.mark.parametrize("change", CHANGES)
def test_a_message_cannot_change_its_world(change):
    codes = []

    def tell(message):
        try:
            CHANGES[change](crowd.world, crowd.bodies)
        except tact.Error as error:
            codes.append(error.code)

    crowd = Crowd(tell)
    crowd.step()
    assert codes and set(codes) == {tact.ErrorCode.wrong_order}


def test_what_a_message_raises_comes_out_after_the_step():
    def fail(message):
        raise KeyError("told")

    crowd, quiet = Crowd(fail), Crowd(None)
    for _ in range(2):
        with pytest.raises(KeyError, match="told"):
            crowd.step()
        quiet.step()
    crowd.world.set_settings(tact.Settings(threads=1, iteration_limit=1))
    quiet.world.set_settings(tact.Settings(threads=1, iteration_limit=1))
    assert crowd.step().hash() == quiet.step().hash()


def test_the_function_for_messages_is_the_one_that_was_given():
    def tell(message):
        pass

    settings = tact.Settings(on_message=tell)
    assert settings.on_message is tell and tact.World(settings).settings.on_message is tell
    settings.on_message = None
    assert settings.on_message is None and tact.Settings().on_message is None


def test_a_function_that_is_replaced_may_use_the_world_at_its_end():
    hashes = []

    class Tell:
        def __init__(self, world):
            self.world = world

        def __call__(self, message):
            pass

        def __del__(self):
            hashes.append(self.world.detect().hash())

    world, _ = sheets(2)
    for _ in range(3):
        world.set_settings(tact.Settings(threads=1, on_message=Tell(world)))
        world.set_settings(tact.Settings(threads=1))
    assert hashes == [world.detect().hash()] * 3


def test_many_threads_ask_one_world():
    world, _ = sheets()
    report = world.detect()
    expected = world.closest_points(np.random.default_rng(0).random((500, 3))).distances
    wrong = []

    def ask():
        for _ in range(20):
            try:
                found = world.closest_points(np.random.default_rng(0).random((500, 3))).distances
                if not np.array_equal(found, expected) or len(report.contacts) != 6:
                    wrong.append("another answer")
            except BaseException as error:  # noqa: BLE001: whatever it is, the test shows it
                wrong.append(error)

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


class Unmade(tact.World):
    def __init__(self):
        self.detect()


UNMADE = {
    "a subclass that is not made yet": Unmade,
    "World": lambda: tact.World.__new__(tact.World).detect(),
    "World.name": lambda: tact.World.__new__(tact.World).body_count,
    "Settings": lambda: tact.World(tact.Settings.__new__(tact.Settings)),
    "BodyId": lambda: hash(tact.BodyId.__new__(tact.BodyId)),
    "Report": lambda: len(tact.Report.__new__(tact.Report)),
    "Contact": lambda: repr(tact.Contact.__new__(tact.Contact)),
    "Message": lambda: tact.Message.__new__(tact.Message).text,
    "RecordingPlayer": lambda: next(tact.RecordingPlayer.__new__(tact.RecordingPlayer)),
    "ContactPoints": lambda: len(tact.ContactPoints.__new__(tact.ContactPoints)),
    "DebugDrawOptions": lambda: tact.DebugDrawOptions.__new__(tact.DebugDrawOptions).box,
    "a copied World": lambda: copy.copy(tact.World()).detect(),
    "a copied Settings": lambda: copy.deepcopy(tact.Settings()).threads,
    "a pickled Settings": lambda: pickle.dumps(tact.Settings()),
}


@pytest.mark.parametrize("what", UNMADE)
def test_what_was_never_made_is_refused(what):
    with pytest.raises(TypeError):
        UNMADE[what]()


ENDINGS = {
    "in a message": "run = Crowd(lambda message: time.sleep(0.0005)).step",
    "in a step": "run = Crowd(None).step",
    "in a drawer": "world, _ = sheets()\nreport = world.detect()\nrun = lambda: world.debug_draw(report, Drawer(lambda: None))",
    "in a query": "world, _ = sheets()\nrun = lambda: world.closest_points(np.zeros((500, 3)))",
}


@pytest.mark.parametrize("what", ENDINGS)
def test_the_interpreter_may_end(what):
    program = (
        "import sys, threading, time, numpy as np\n"
        f"sys.path.insert(0, {str(__file__.rpartition('/')[0])!r})\n"
        f"from test_kept import Crowd, Drawer, sheets\n{ENDINGS[what]}\n"
        "def forever():\n    while True: run()\n"
        "threading.Thread(target=forever, daemon=True).start()\ntime.sleep(0.05)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, (done.returncode, done.stderr)
