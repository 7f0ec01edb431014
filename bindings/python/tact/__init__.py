"""Finds where many deformable triangle meshes touch.

>>> import numpy as np, tact
>>> world = tact.World()
>>> corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
>>> facets = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> left = world.add_body(corners, facets, name="left")
>>> right = world.add_body(corners + [0.9, 0, 0], facets, name="right")
>>> world.detect().contacts
[<tact.Contact of bodies 0 and 1, depth 0.0577350269189626, 4 facet pairs>]
"""

from ._tact import *  # noqa: F403
from ._tact import __version__  # noqa: F401

from . import _html  # noqa: F401, E402
from ._check import CheckFrame, CheckResult, check  # noqa: F401, E402
from ._files import Mesh, MeshSequence, read, read_sequence  # noqa: F401, E402
from ._view import Page, view  # noqa: F401, E402
