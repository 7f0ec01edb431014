"""Elastic cubes fall on each other: implicit steps with penalties and friction, in SciPy's sparse matrices.

Linear implicit Euler (Baraff and Witkin, "Large Steps in Cloth Simulation", 1998) on springs and tact's stencils: one call gives
all of them, no loop runs over contacts. It prints where the cubes end, and leaves with status 0 if they rest on each other.
"""

import sys

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linalg
import tact

SIDE, EDGE, MARGIN = 3, 0.3, 0.01  # vertices along an edge of a cube, metres, metres
MASS, SPRING, PENALTY, FRICTION = 0.05, 2e3, 5e3, 0.5  # a vertex, kg; N/m; N/m
STEP, DAMPING = 1 / 120, 5e-3  # seconds
SMOOTHING = 1e-3  # metres: friction alone moves a vertex about so far in a step, so one linear solve does not overshoot


def lattice():
    """A cube's vertices, the facets of its surface and its springs: all pairs nearer than two cells."""
    x = EDGE * (np.stack(np.meshgrid(*[np.arange(SIDE)] * 3, indexing="ij"), -1).reshape(-1, 3) / (SIDE - 1))
    number = np.arange(SIDE**3).reshape(SIDE, SIDE, SIDE)
    facets = []
    for axis in range(3):
        for end, turned in ((0, True), (SIDE - 1, False)):
            face = np.moveaxis(number, axis, 0)[end]
            a, b, c, d = face[:-1, :-1].ravel(), face[1:, :-1].ravel(), face[1:, 1:].ravel(), face[:-1, 1:].ravel()
            both = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
            facets.append(both[:, ::-1] if turned != (axis == 1) else both)
    length = np.linalg.norm(x[:, None] - x[None], axis=2)
    return x, np.concatenate(facets).astype(np.int32), np.argwhere(np.triu((length > 0) & (length < 1.8 * EDGE / (SIDE - 1))))


def spring_terms(x, pairs, lengths):
    """Gradients (S, 2, 3) and Hessians (S, 6, 6) of springs, without what is negative in those of pressed ones."""
    way = x[pairs[:, 1]] - x[pairs[:, 0]]
    now = np.linalg.norm(way, axis=1)
    n = way / now[:, None]
    along = np.einsum("si,sj->sij", n, n)
    block = SPRING * (along + np.maximum(0, 1 - lengths / now)[:, None, None] * (np.eye(3) - along))
    force = SPRING * (now - lengths)[:, None] * n
    return np.stack([-force, force], 1), np.block([[block, -block], [-block, block]])


def entries(vertices, hessians):
    """Rows, columns and values of Hessians of 3 k numbers over k vertices each."""
    rows = (3 * vertices[:, :, None] + np.arange(3)).reshape(len(vertices), -1)
    return np.repeat(rows, rows.shape[1], 1).ravel(), np.tile(rows, (1, rows.shape[1])).ravel(), hessians.ravel()


def matrix(*parts, size):
    rows, columns, values = (np.concatenate(arrays) for arrays in zip(*parts))
    return sparse.coo_matrix((values, (rows, columns)), shape=(size, size)).tocsc()


def main(steps=200):
    cube, facets, pairs = lattice()
    offsets = np.array([[0, 0, 0.05], [0.04, 0.03, 0.4], [-0.03, 0.02, 0.75]])
    floor = np.array([[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]], dtype=float)
    x = np.concatenate([cube + offset for offset in offsets] + [floor])
    moving = len(x) - len(floor)
    springs = np.concatenate([pairs + k * len(cube) for k in range(len(offsets))])
    lengths = np.linalg.norm(x[springs[:, 0]] - x[springs[:, 1]], axis=1)
    world = tact.World(tact.Settings(points=True))
    first = {world.add_body(x[k * len(cube) : (k + 1) * len(cube)], facets, margin=MARGIN): k * len(cube) for k in range(len(offsets))}
    first[world.add_body(floor, np.array([[0, 1, 2], [0, 2, 3]]), surface=tact.Surface.sheet, motion=tact.Motion.fixed, margin=MARGIN)] = moving
    velocity = np.zeros((moving, 3))
    for _ in range(steps):
        # [part step]
        world.set_positions({body: x[row : row + len(cube)] for body, row in first.items() if row < moving})
        stencils = world.detect().stencils(first)
        _, pushes, stiffness = stencils.penalties(x, 2 * MARGIN)
        moved = np.zeros_like(x)
        moved[:moving] = STEP * velocity
        limits = FRICTION * PENALTY * np.maximum(0, 2 * MARGIN - stencils.gaps)
        _, drags, slowing = stencils.friction(moved, limits, SMOOTHING)
        of_springs, spring_stiffness = spring_terms(x, springs, lengths)
        gradient = stencils.add_gradients(PENALTY * pushes + drags, moving) + [0, 0, 9.81 * MASS]
        np.add.at(gradient, springs, of_springs)
        elastic = matrix(entries(springs, spring_stiffness), stencils.triplets(PENALTY * stiffness, moving), size=3 * moving)
        system = (STEP**2 + STEP * DAMPING) * elastic + STEP**2 * matrix(stencils.triplets(slowing, moving), size=3 * moving)
        system += MASS * sparse.identity(3 * moving, format="csc")
        force = gradient.ravel() + (STEP + DAMPING) * (elastic @ velocity.ravel())
        velocity += linalg.spsolve(system, -STEP * force).reshape(-1, 3)
        x[:moving] += STEP * velocity
        # [part step]
    heights = [x[k * len(cube) : (k + 1) * len(cube), 2].mean() for k in range(len(offsets))]
    crossed, speed = len(world.detect().facet_pairs), np.sqrt((velocity**2).sum(1).mean())
    print(f"{len(stencils)} points, {crossed} facet pairs, middles at {np.round(heights, 3)} m, speed {speed:.4f} m/s")
    expected = EDGE * (np.arange(len(offsets)) + 0.5) + 2 * MARGIN * (np.arange(len(offsets)) + 1)
    return 0 if crossed == 0 and np.all(np.abs(heights - expected) < 0.03) and speed < 0.02 else 1


if __name__ == "__main__":
    sys.exit(main())
