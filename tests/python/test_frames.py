"""What Python finds is what C++ finds, bit for bit."""

import os

import frames
import pytest


@pytest.mark.skipif("TACT_PLAY_FRAMES" not in os.environ, reason="set TACT_PLAY_FRAMES to the program play_frames")
@pytest.mark.parametrize("threads", [1, 2])
def test_a_scene_has_the_same_hashes_in_both_languages(tmp_path, threads):
    facets, played = frames.pile(side=3, cuts=2, frames=6)
    frames.write(tmp_path / "frames", facets, played)
    in_python, _ = frames.play_in_python(facets, played, threads)
    in_cpp, _ = frames.play_in_cpp(tmp_path / "frames", threads)
    assert in_python == in_cpp
    assert len(set(in_python)) == 6
