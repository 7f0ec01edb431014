"""The same scene through C++ and Python: a pile of wobbling balls, written to a file that play_frames.cpp plays."""

import os
import subprocess
import time

import numpy as np
import tact


def ball(times):
    """An octahedron, cut and blown up: 8 * 4**times facets."""
    x = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
    facets = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    for _ in range(times):
        middles, finer = {}, []

        def middle(a, b):
            if (min(a, b), max(a, b)) not in middles:
                middles[min(a, b), max(a, b)] = len(x)
                x.append((np.add(x[a], x[b]) / np.linalg.norm(np.add(x[a], x[b]))).tolist())
            return middles[min(a, b), max(a, b)]

        for a, b, c in facets:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        facets = finer
    return np.array(x, dtype=float), np.array(facets, dtype=np.int32)


def pile(side, cuts, frames, seed=7):
    """side**3 balls on a grid in which each overlaps its neighbours; the facets, and positions by frame and body."""
    random = np.random.default_rng(seed)
    x, facets = ball(cuts)
    places = 1.9 * np.stack(np.meshgrid(*[np.arange(side)] * 3), -1).reshape(-1, 3) + 0.05 * random.normal(size=(side**3, 3))
    turns = random.normal(size=(side**3, 3))
    played = []
    for t in range(frames):
        swell = 1 + 0.05 * np.sin(0.3 * t + 3 * x @ turns.T)  # (V, bodies)
        played.append([np.ascontiguousarray(swell[:, [i]] * x + places[i]) for i in range(side**3)])
    return facets, played


def write(file, facets, played):
    def columns(stream, array):
        stream.write(np.int64(len(array)).tobytes() + array.tobytes())

    with open(file, "wb") as stream:
        stream.write(np.int64(len(played[0])).tobytes())
        for positions in played[0]:
            columns(stream, positions)
            columns(stream, facets)
        stream.write(np.int64(len(played)).tobytes())
        for frame in played:
            for positions in frame:
                columns(stream, positions)


def play_in_python(facets, played, threads, margin=0.0):
    """The hash of each step, and the median milliseconds of a step; with a margin, all points are read.

    Of one thread it is processor time, which tells the same while others are at work.
    """
    clock = time.process_time if threads == 1 else time.perf_counter
    world = tact.World(tact.Settings(threads=threads, points=margin > 0))
    bodies = [world.add_body(positions, facets, margin=margin) for positions in played[0]]
    hashes, times = [], []
    for frame in played:
        start = clock()
        world.set_positions(dict(zip(bodies, frame)))
        report = world.detect()
        if margin > 0:
            report.points
        times.append(1e3 * (clock() - start))
        hashes.append(report.hash())
    return hashes, np.median(times)


def play_in_cpp(file, threads, margin=0.0):
    program = os.environ["TACT_PLAY_FRAMES"]
    words = subprocess.run([program, str(file), str(threads), str(margin)], check=True, capture_output=True, text=True).stdout.split()
    return [int(word) for word in words[:-1]], float(words[-1])
