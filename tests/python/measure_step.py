"""What a step costs from Python, beside C++: a pile of 125 balls of 2,048 facets.

usage: TACT_PLAY_FRAMES=build/release/tests/play_frames PYTHONPATH=build/release/bindings/python measure_step.py
They take turns; each turn gives the median of its steps. Prints the medians of the turns and their ratio. No test: time is
none.
"""

import pathlib
import tempfile

import frames
import numpy as np

facets, played = frames.pile(side=5, cuts=4, frames=40)
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "frames"
    frames.write(file, facets, played)
    for threads in (1, 2):
        turns = [(frames.play_in_cpp(file, threads), frames.play_in_python(facets, played, threads)) for _ in range(5)]
        assert all(cpp[0] == python[0] for cpp, python in turns)
        cpp, python = (np.median([turn[k][1] for turn in turns]) for k in (0, 1))
        print(f"{threads} threads: C++ {cpp:.3f} ms, Python {python:.3f} ms a step: {python / cpp:.3f}")
