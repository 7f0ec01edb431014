import numpy as np
import tact

# A tetrahedron: a vertex a row, metres; a facet a row, counter-clockwise seen from outside.
positions = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
facets = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])

world = tact.World()
world.add_body(positions, facets, name="left")
right = world.add_body(positions + [0.75, 0, 0], facets, name="right")

for step in range(4):
    report = world.detect()
    print(f"step {step}: {len(report.contacts)} contacts")
    for contact in report.contacts:
        names = world.name(contact.a), world.name(contact.b)
        print(f"  {names[0]} and {names[1]}, {contact.depth:.2f} m deep, {len(contact.facet_pairs)} facet pairs")
    world.set_positions(right, positions + [0.85 + 0.1 * step, 0, 0])  # your program moves the vertices as it likes
