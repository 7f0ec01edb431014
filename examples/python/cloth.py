"""A cloth falls on a ball and rests there: position-based dynamics from tact's contact points alone.

After Mueller et al., "Position Based Dynamics", 2007. It prints where the cloth ends, and leaves with status 0 if it rests on
the ball without ever having crossed it.
"""

import sys

import numpy as np
import tact

SIDE, SPACING = 30, 0.05  # vertices along a side of the cloth, metres
RADIUS, MARGIN = 0.4, 0.005  # of the ball, of every body; metres
FRICTION, STEP, SUBSTEPS = 0.4, 1 / 60, 12


def cloth():
    i, j = np.meshgrid(np.arange(SIDE), np.arange(SIDE))
    flat = [(i - (SIDE - 1) / 2) * SPACING, (j - (SIDE - 1) / 2) * SPACING, RADIUS + 0.05 + 0.002 * np.sin(3 * i + 5 * j)]
    a = (np.arange(SIDE - 1)[:, None] * SIDE + np.arange(SIDE - 1)).ravel()
    return np.stack(flat, -1).reshape(-1, 3), np.concatenate([np.stack([a, a + 1, a + SIDE + 1], 1), np.stack([a, a + SIDE + 1, a + SIDE], 1)])


def ball(around=48, across=24):
    turn, tilt = np.meshgrid(2 * np.pi * np.arange(around) / around, np.pi * np.arange(across + 1) / across)
    x = RADIUS * np.stack([np.cos(tilt), np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn)], -1).reshape(-1, 3)
    a = np.arange(across * around)
    b = a - a % around + (a + 1) % around
    return x, np.concatenate([np.stack([a, b, a + around], 1), np.stack([b, b + around, a + around], 1)])[:, ::-1].copy()


def springs(x):
    """Edges to neighbours, across and two ahead, in groups within which no vertex is named twice."""
    groups, number = [], np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    for dj, di in ((0, 1), (1, 0), (1, 1), (1, -1), (0, 2), (2, 0)):
        a = number[: SIDE - dj, max(0, -di) : SIDE - max(0, di)]
        place = np.arange(a.shape[0])[:, None] // dj if dj else np.arange(a.shape[1])[None, :] // di
        for parity in (0, 1):
            chosen = a[np.broadcast_to(place % 2 == parity, a.shape)]
            groups.append((chosen, chosen + dj * SIDE + di, np.linalg.norm(x[chosen] - x[chosen + dj * SIDE + di], axis=1)))
    return groups


def keep_apart(points, first_of_a, first_of_b, x, before, light):
    """Moves what is light of each point, by the mean of what the points that a vertex carries ask for."""
    v = np.concatenate([np.maximum(points.a_vertices, 0) + first_of_a, np.maximum(points.b_vertices, 0) + first_of_b], axis=1)
    w = np.concatenate([-points.a_weights, points.b_weights], axis=1)  # from a to b; 0 where a vertex is -1
    between, n = np.einsum("nk,nkd->nd", w, x[v]), points.normals
    missing = np.maximum(0.0, 2 * MARGIN - (n * between).sum(1))
    slid = between - np.einsum("nk,nkd->nd", w, before[v])
    slid -= (n * slid).sum(1)[:, None] * n
    held = np.minimum(1.0, FRICTION * missing / np.maximum(np.linalg.norm(slid, axis=1), 1e-300))
    push = (missing[:, None] * n - held[:, None] * slid) / (w**2 * light[v]).sum(1)[:, None]
    way, count = np.zeros_like(x), np.zeros(len(x))
    np.add.at(way, v, (w * light[v])[:, :, None] * push[:, None, :])
    np.add.at(count, v, (w != 0) & (missing > 0)[:, None])
    x += way / np.maximum(count, 1)[:, None]


def main(steps=120):
    (sheet, sheet_facets), (sphere, sphere_facets) = cloth(), ball()
    x, moving = np.concatenate([sheet, sphere]), slice(0, len(sheet))  # all vertices in one array: the cloth's, the ball's
    light = np.where(np.arange(len(x)) < len(sheet), 1.0, 0.0)
    world = tact.World(tact.Settings(points=True))
    body = world.add_body(sheet, sheet_facets, surface=tact.Surface.sheet, margin=MARGIN, self_contact=True)
    first = {body: 0, world.add_body(sphere, sphere_facets, motion=tact.Motion.fixed, margin=MARGIN): len(sheet)}
    velocity, groups, h, crossings, count = np.zeros_like(sheet), springs(sheet), STEP / SUBSTEPS, 0, 0
    for _ in range(steps * SUBSTEPS):
        before = x.copy()
        velocity = (velocity - [0, 0, 9.81 * h]) / (1 + 0.8 * h)
        x[moving] += h * velocity
        for a, b, length in groups:
            way = x[b] - x[a]
            half = 0.25 * (1 - length / np.linalg.norm(way, axis=1))[:, None] * way
            x[a] += half
            x[b] -= half
        world.set_positions(body, x[moving])
        contacts = world.detect().contacts
        for contact in contacts:
            crossings += len(contact.facet_pairs)
            if len(contact.points):
                keep_apart(contact.points, first[contact.a], first[contact.b], x, before, light)
        velocity, count = (x - before)[moving] / h, sum(len(contact.points) for contact in contacts)
    height, speed = np.linalg.norm(x[SIDE // 2 * SIDE + SIDE // 2]), np.sqrt((velocity**2).sum(1).mean())
    print(f"{count} contact points, {crossings} facets ever crossed, top at {height:.4f} m, mean speed {speed:.4f} m/s")
    return 0 if crossings == 0 and count > 50 and abs(height - RADIUS - 2 * MARGIN) < 0.01 else 1


if __name__ == "__main__":
    sys.exit(main())
