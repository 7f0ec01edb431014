"""Balls fall into a heap, shared out over the ranks of MPI: `mpirun -n 2 python3 examples/python/ranks.py`.

Each rank moves the balls that it owns by the forces of its own contacts, which have all that touches a ball, whoever owns the
other one. Forces are summed in the order of keys, so that the same is printed for any number of ranks.
"""

import sys

import numpy as np
from mpi4py import MPI

import tact
import tact.mpi

SIDE, RADIUS, MARGIN = 3, 0.1, 0.01  # balls along an edge of the heap, metres, metres
MASS, STIFFNESS, DAMPING = 0.05, 500.0, 1.0  # a ball's, kg; of a point, N/m; N s/m
STEP, GRAVITY = 1 / 240, np.array([0.0, 0.0, -9.81])  # seconds, m/s²
FLOOR = SIDE**3  # its key


def ball():
    """An icosahedron's vertices and facets."""
    t = (1 + 5**0.5) / 2
    x = np.array([[-1, t, 0], [1, t, 0], [-1, -t, 0], [1, -t, 0], [0, -1, t], [0, 1, t],
                  [0, -1, -t], [0, 1, -t], [t, 0, -1], [t, 0, 1], [-t, 0, -1], [-t, 0, 1]])  # fmt: skip
    facets = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6],
              [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7],
              [9, 8, 1]]  # fmt: skip
    return RADIUS * x / np.linalg.norm(x[0]), np.array(facets)


class Heap:
    # [part world]
    def __init__(self, communicator):
        self.shape, facets = ball()
        self.world = tact.mpi.World(communicator, tact.Settings(threads=1, points=True), rebalance_above=1.5)
        self.world.set_body_state(self.pack, self.unpack, self.state_gone)
        self.state = {}  # by key: (2, 3), where the ball is and how fast
        rank, ranks = self.world.rank, self.world.rank_count
        for key in range(FLOOR * rank // ranks, FLOOR * (rank + 1) // ranks):
            place = np.array([key % SIDE, key // SIDE % SIDE, key // SIDE**2])
            center = 2.3 * RADIUS * place + [0, 0, 1.5 * RADIUS] + 0.01 * np.sin([7 * key, 5 * key, 0])
            self.state[key] = np.array([center, np.zeros(3)])
            self.world.add_body(self.shape + center, facets, key=key, margin=MARGIN)
        ground = np.array([[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]], dtype=float)
        self.world.add_body(ground, [[0, 1, 2], [0, 2, 3]], key=FLOOR, every_rank=True, surface=tact.Surface.sheet,
                            motion=tact.Motion.fixed, margin=MARGIN)  # fmt: skip
        self.world.rebalance()
    # [part world]

    # [part state]
    # What moves with a ball to another rank.
    def pack(self, key):
        return self.state[key].tobytes()

    def unpack(self, key, data):
        self.state[key] = np.frombuffer(data).reshape(2, 3).copy()

    def state_gone(self, key):
        del self.state[key]
    # [part state]

    # [part step]
    def step(self):
        report = self.world.detect()
        speeds = {key: state[1] for key, state in self.state.items()}
        contacts = [(c.key_a, c.key_b, c.points) for c in report.contacts]
        found = report.hash_sum(), sum(c.counted for c in report.contacts)
        self.world.exchange(
            lambda key: self.state[key][1].tobytes(), lambda key, data: speeds.update({key: np.frombuffer(data)})
        )
        forces = {key: MASS * GRAVITY for key in self.state}
        for a, b, points in contacts:
            normals = np.array(points.normals)
            approach = normals @ (speeds.get(a, np.zeros(3)) - speeds.get(b, np.zeros(3)))
            press = np.maximum(0, STIFFNESS * (2 * MARGIN - points.gaps) + DAMPING * approach)
            push = press @ normals  # on b; on a its opposite
            for key, force in ((a, -push), (b, push)):
                if key in forces:
                    forces[key] = forces[key] + force
        moved = {}
        for key in sorted(self.state):
            state = self.state[key]
            state[1] += STEP / MASS * forces[key]
            state[0] += STEP * state[1]
            moved[key] = self.shape + state[0]
        self.world.set_positions(moved)
        return found
    # [part step]

    # [part saved]
    def save(self):
        return self.world.save()  # the share of this rank: to a file of its own, say

    def restore(self, shares):
        self.world.restore(shares)  # each share of the run is given to one rank, of as many as there are
    # [part saved]


def main(steps=240):
    communicator = MPI.COMM_WORLD
    heap = Heap(communicator)
    for step in range(steps):
        if step == steps // 2:
            heap.restore([heap.save()])  # as a run does that goes on later
        hash_sum, contacts = heap.step()
        if (step + 1) % 60 == 0:
            of_all = communicator.gather((hash_sum, contacts))
            if communicator.rank == 0:
                total = sum(of_rank[0] for of_rank in of_all) % 2**64
                print(f"step {step + 1}: {sum(of_rank[1] for of_rank in of_all)} contacts, hash {total:016x}", flush=True)
    lowest = communicator.allreduce(min((s[0][2] for s in heap.state.values()), default=np.inf), MPI.MIN)
    if communicator.rank == 0:
        print(f"the lowest ball is {lowest:.3f} m high")
    return 0 if 0.5 * RADIUS < lowest < 1.5 * RADIUS else 1


if __name__ == "__main__":
    sys.exit(main())
