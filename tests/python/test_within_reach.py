"""Pairs within reach as arrays."""

import numpy as np
import tact
from shapes import grid


def test_pairs_within_reach_have_places_at_their_distance():
    world = tact.World(tact.Settings(threads=1, within_reach=True))
    positions, facets = grid(6)
    above = positions + [0.03, 0.01, 0.02]
    for x in (positions, above):
        world.add_body(x, facets, surface=tact.Surface.sheet, margin=0.02)
    (contact,) = world.detect().contacts
    pairs = contact.within_reach
    assert len(pairs) > 50 and np.all(pairs.distances < 0.04)
    assert set(pairs.kinds) == {0, 1, 2}
    place = lambda x, vertices, weights: np.einsum("nk,nkc->nc", weights, x[np.maximum(vertices, 0)])
    way = place(above, pairs.b_vertices, pairs.b_weights) - place(positions, pairs.a_vertices, pairs.a_weights)
    np.testing.assert_allclose(np.linalg.norm(way, axis=1), pairs.distances, atol=1e-12)
    np.testing.assert_allclose(way, pairs.distances[:, None] * pairs.normals, atol=1e-12)
    assert len(contact.points) == 0
    everything = world.detect().within_reach
    assert len(everything) == len(pairs) and not everything.contacts.any() and (everything.bodies == [0, 1]).all()
    for name in ("kinds", "a_vertices", "b_vertices", "a_weights", "b_weights", "normals", "distances"):
        np.testing.assert_array_equal(getattr(everything, name), getattr(pairs, name), err_msg=name)
