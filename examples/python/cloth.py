"""A cloth falls on a ball and rests there: position-based dynamics from tact's contact points alone.

After Mueller et al., "Position Based Dynamics", 2007. Run it with the package `tact` and numpy; it prints where the cloth
ends, and leaves with status 0 if it rests on the ball without ever having crossed it.
"""

import sys

import numpy as np
import tact

SIDE, SPACING = 30, 0.05  # vertices along a side of the cloth, metres
RADIUS, MARGIN = 0.4, 0.005  # of the ball, half the thickness of every surface, metres
FRICTION, STEP, SUBSTEPS = 0.4, 1 / 60, 12


def cloth():
    i, j = np.meshgrid(np.arange(SIDE), np.arange(SIDE))
    wave = RADIUS + 0.05 + 0.002 * np.sin(3 * i + 5 * j)
    x = np.stack([(i - (SIDE - 1) / 2) * SPACING, (j - (SIDE - 1) / 2) * SPACING, wave], axis=-1).reshape(-1, 3)
    a = (np.arange(SIDE - 1)[:, None] * SIDE + np.arange(SIDE - 1)).ravel()
    return x, np.concatenate([np.stack([a, a + 1, a + SIDE + 1], 1), np.stack([a, a + SIDE + 1, a + SIDE], 1)])


def ball(around=48, across=24):
    """A sphere of rings, with a vertex at either pole."""
    turn, tilt = 2 * np.pi * np.arange(around) / around, np.pi * np.arange(1, across) / across
    rings = np.stack([np.outer(np.sin(tilt), np.cos(turn)), np.outer(np.sin(tilt), np.sin(turn)), np.repeat(np.cos(tilt), around).reshape(-1, around)], -1)
    x = np.concatenate([rings.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    k, last = np.arange(around), (across - 2) * around
    facets = [np.stack([np.full(around, len(x) - 2), k, (k + 1) % around], 1), np.stack([last + (k + 1) % around, last + k, np.full(around, len(x) - 1)], 1)]
    for ring in range(0, last, around):
        a, b = ring + k, ring + (k + 1) % around
        facets += [np.stack([a, a + around, b], 1), np.stack([b, a + around, b + around], 1)]
    return RADIUS * x, np.concatenate(facets)


def springs(x):
    """Edges to neighbours, across and two ahead, in groups within which no vertex is named twice."""
    groups, number = [], np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    for dj, di in ((0, 1), (1, 0), (1, 1), (1, -1), (0, 2), (2, 0)):
        a = number[: SIDE - dj, max(0, -di) : SIDE - max(0, di)]
        place = np.arange(a.shape[0])[:, None] // max(dj, 1) if dj else np.arange(a.shape[1])[None, :] // di
        for parity in (0, 1):
            chosen = a[np.broadcast_to(place % 2 == parity, a.shape)]
            groups.append((chosen, chosen + dj * SIDE + di, np.linalg.norm(x[chosen] - x[chosen + dj * SIDE + di], axis=1)))
    return groups


def carried(x, vertices, weights):
    return np.einsum("nk,nkd->nd", weights, x[np.maximum(vertices, 0)])  # where a vertex is -1 its weight is 0


def keep_apart(points, sides, x, before):
    """Moves what the cloth has of each point, by the mean of what the points that a vertex carries ask for."""
    sum_, count = np.zeros_like(x["cloth"]), np.zeros(len(x["cloth"]))
    ends = [(side, v, w) for side, v, w in zip(sides, (points.a_vertices, points.b_vertices), (points.a_weights, points.b_weights))]
    a, b = (carried(x[side], v, w) for side, v, w in ends)
    slid = (b - carried(before[ends[1][0]], *ends[1][1:])) - (a - carried(before[ends[0][0]], *ends[0][1:]))
    missing = np.maximum(0.0, 2 * MARGIN - np.einsum("nd,nd->n", points.normals, b - a))
    slid -= np.einsum("nd,nd->n", points.normals, slid)[:, None] * points.normals
    way = np.maximum(np.linalg.norm(slid, axis=1), 1e-300)
    push = missing[:, None] * points.normals - (np.minimum(1.0, FRICTION * missing / way))[:, None] * slid
    share = sum((w**2).sum(1) for side, _, w in ends if side == "cloth")
    for sign, (side, v, w) in zip((-1, 1), ends):
        if side == "cloth":
            rows = np.maximum(v, 0)
            np.add.at(sum_, rows, sign * w[:, :, None] * (push / share[:, None])[:, None, :])
            np.add.at(count, rows, (w > 0) & (missing > 0)[:, None])
    x["cloth"] += sum_ / np.maximum(count, 1)[:, None]


def main(steps=120):
    (sheet, sheet_facets), (sphere, sphere_facets) = cloth(), ball()
    x = {"cloth": sheet, "ball": sphere}
    world = tact.World(tact.Settings(points=True))
    body = world.add_body(sheet, sheet_facets, surface=tact.Surface.sheet, name="cloth", margin=MARGIN, self_contact=True)
    world.add_body(sphere, sphere_facets, motion=tact.Motion.fixed, name="ball", margin=MARGIN)
    velocity, groups, h, crossings, count = np.zeros_like(sheet), springs(sheet), STEP / SUBSTEPS, 0, 0
    for _ in range(steps * SUBSTEPS):
        before = {"cloth": x["cloth"].copy(), "ball": sphere}
        velocity = (velocity - [0, 0, 9.81 * h]) / (1 + 0.8 * h)
        x["cloth"] = x["cloth"] + h * velocity
        for a, b, length in groups:
            way = x["cloth"][b] - x["cloth"][a]
            half = 0.25 * (1 - length / np.linalg.norm(way, axis=1))[:, None] * way
            x["cloth"][a] += half
            x["cloth"][b] -= half
        world.set_positions(body, x["cloth"])
        contacts = world.detect().contacts
        for contact in contacts:
            crossings += len(contact.facet_pairs)
            if len(contact.points):
                keep_apart(contact.points, ["cloth" if end == body else "ball" for end in (contact.a, contact.b)], x, before)
        velocity = (x["cloth"] - before["cloth"]) / h
        count = sum(len(contact.points) for contact in contacts)
    height, speed = np.linalg.norm(x["cloth"][SIDE // 2 * SIDE + SIDE // 2]), np.sqrt((velocity**2).sum(1).mean())
    print(f"{count} contact points, {crossings} facets ever crossed, top at {height:.4f} m, mean speed {speed:.4f} m/s")
    return 0 if crossings == 0 and count > 50 and abs(height - RADIUS - 2 * MARGIN) < 0.01 else 1


if __name__ == "__main__":
    sys.exit(main())
