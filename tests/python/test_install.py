"""How many compilers pip starts: what setup.py asks of cmake."""

import os
import pathlib
import subprocess
import sys

import pytest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "bindings/python"


@pytest.mark.parametrize(
    "level, words, expected",
    [(None, [], ["--parallel"]), ("2", [], []), (None, ["--parallel", "3"], ["--parallel", "3"]), ("2", ["--parallel", "1"], ["--parallel", "1"])],
)
def test_the_number_of_compilers_can_be_told(tmp_path, level, words, expected):
    pytest.importorskip("setuptools")
    cmake, told = tmp_path / "cmake", tmp_path / "told"
    cmake.write_text(f'#!/bin/sh\necho "$@" >> {told}\n')
    cmake.chmod(0o755)
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    environment.pop("CMAKE_BUILD_PARALLEL_LEVEL", None)
    if level is not None:
        environment["CMAKE_BUILD_PARALLEL_LEVEL"] = level
    build = [sys.executable, FOLDER / "setup.py", "build_ext", "-b", tmp_path / "lib", "-t", tmp_path / "temp", *words]
    subprocess.run(build, cwd=tmp_path, env=environment, check=True, capture_output=True)
    (asked,) = (line.split() for line in told.read_text().splitlines() if line.startswith("--build"))
    assert asked[asked.index("tact_python") + 1 :] == expected
