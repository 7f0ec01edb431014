"""Meshes that the tests share."""

import numpy as np


def tetrahedron(x=0.0):
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    facets = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=np.int32)
    return corners + [x, 0, 0], facets


def grid(side, spacing=0.1, z=0.0):
    """A square sheet of side x side vertices."""
    i, j = np.meshgrid(np.arange(side), np.arange(side))
    positions = np.stack([i.ravel() * spacing, j.ravel() * spacing, np.full(side * side, z)], axis=1)
    first = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    facets = np.concatenate([np.stack([first, first + 1, first + side + 1], 1), np.stack([first, first + side + 1, first + side], 1)])
    return positions, facets.astype(np.int32)
