"""What a step costs from Python, beside C++: a pile of 125 balls of 2,048 facets, and 512 of 128 with all points read.

usage: TACT_PLAY_FRAMES=build/release/tests/play_frames PYTHONPATH=build/release/bindings/python measure_step.py
They take turns; each turn gives the median of its steps. Prints the medians of the turns and their ratio. No test: time is
none.
"""

import pathlib
import tempfile

import frames
import numpy as np

for side, cuts, margin, most in ((5, 4, 0.0, 2), (8, 2, 0.02, 1)):
    facets, played = frames.pile(side=side, cuts=cuts, frames=40)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "frames"
        frames.write(file, facets, played)
        for threads in range(1, most + 1):
            turns = [(frames.play_in_cpp(file, threads, margin), frames.play_in_python(facets, played, threads, margin)) for _ in range(5)]
            assert all(cpp[0] == python[0] for cpp, python in turns)
            cpp, python = (np.median([turn[k][1] for turn in turns]) for k in (0, 1))
            scene = f"{side**3} balls of {len(facets)} facets, " + ("all points read, " if margin > 0 else "")
            print(f"{scene}{threads} threads: C++ {cpp:.3f} ms, Python {python:.3f} ms a step: {python / cpp:.3f}")
