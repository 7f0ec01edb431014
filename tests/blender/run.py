"""Runs the tests of this folder inside Blender: blender -b --factory-startup --python run.py"""

import os
import pathlib
import sys

import pytest

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "bindings/blender"))
sys.path[:0] = os.environ.get("PYTHONPATH", "").split(":")  # Blender leaves it out
status = pytest.main(["-q", "-p", "no:cacheprovider", str(here)])
sys.stdout.flush()
os._exit(int(status))
