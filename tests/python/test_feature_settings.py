"""Settings of vertices and facets, what they leave out, and meshes of edges that change."""

import numpy as np
import pytest
import tact

SQUARE = np.array([[0, 0, 0.03], [1, 0, 0.03], [1, 1, 0.03], [0, 1, 0.03]])
FACETS = [[0, 1, 2], [0, 2, 3]]


@pytest.fixture
def scene():
    world = tact.World(tact.Settings(points=True))
    sheet = world.add_body(SQUARE, FACETS, surface=tact.Surface.sheet, margin=0.1, rest_offset=0.01)
    world.add_plane([0, 0, 1], margin=0.05, rest_offset=0.0)
    return world, sheet


def test_rest_offsets_decide_what_touches(scene):
    world, sheet = scene
    assert world.rest_offset(sheet) == 0.01
    assert not world.detect().contacts[0].touching
    world.set_rest_offset(sheet, None)
    assert world.rest_offset(sheet) == 0.1
    assert world.detect().contacts[0].touching
    world.set_feature_settings(sheet, rest_offsets=np.zeros(4))
    assert not world.detect().contacts[0].touching


def test_labels_are_given_back(scene):
    world, sheet = scene
    world.set_feature_settings(sheet, vertex_labels=[10, 11, 12, 13], facet_labels=np.array([20, 2**32 - 1]))
    points = world.detect().contacts[0].points
    labels = world.labels(sheet, points.a_vertices)
    assert labels.dtype == np.uint32 and labels.shape == (4, 4)
    assert labels[:, 0].tolist() == [10, 11, 12, 13]
    assert labels[:, 3].tolist() == [20, 20, 20, 2**32 - 1]
    assert world.labels(sheet, [[2, 3, -1]]).tolist() == [[12, 13, 0, 2**32 - 1]]
    settings = world.feature_settings(sheet)
    assert settings.vertex_labels.tolist() == [10, 11, 12, 13]
    assert len(settings.rest_offsets) == 0


def test_labels_of_a_whole_report(scene):
    world, sheet = scene
    world.set_feature_settings(sheet, vertex_labels=[10, 11, 12, 13], facet_labels=np.array([20, 2**32 - 1]))
    report = world.detect()
    labels, points = world.point_labels(report), report.contacts[0].points
    assert len(labels) == len(points) == 4 and labels.b_vertices.shape == (4, 3)
    np.testing.assert_array_equal(labels.a_facets, world.labels(sheet, points.a_vertices)[:, 3])
    np.testing.assert_array_equal(labels.a_vertices, world.labels(sheet, points.a_vertices)[:, :3])
    assert not labels.b_facets.any()  # a plane has none


def test_masks_leave_out(scene):
    world, sheet = scene
    world.set_feature_settings(sheet, vertex_masks=[1, 1, 0, 1], vertex_layers=[1, 1, 1, 2])
    assert len(world.detect().contacts[0].points) == 3
    assert world.feature_settings(sheet).vertex_layers.tolist() == [1, 1, 1, 2]


def test_facets_and_margins_leave_out(scene):
    world, sheet = scene
    floor = next(body for body in world.bodies if body != sheet)
    world.set_layers(floor, 1, 1)
    world.set_feature_settings(sheet, facet_layers=[1, 2], facet_masks=[2**32 - 1, 1])
    assert len(world.detect().contacts[0].points) == 3
    world.set_feature_settings(sheet, margins=[0.1, 0.01, 0.1, 0.1], rest_offsets=np.zeros(4))
    world.set_margin(floor, 0.0)
    points = world.detect().contacts[0].points
    assert sorted(points.a_vertices[:, 0].tolist()) == [0, 2, 3]
    assert world.feature_settings(sheet).margins.tolist() == [0.1, 0.01, 0.1, 0.1]
    assert len(world.feature_settings(sheet).facet_layers) == 0


def test_labels_are_excluded(scene):
    world, sheet = scene
    other = world.add_body(SQUARE + [0, 0, 0.05], FACETS, surface=tact.Surface.sheet, margin=0.1)
    for body in (sheet, other):
        world.set_feature_settings(body, facet_labels=[7, 7], vertex_labels=[1, 2, 2, 2])

    def touching():
        pairs = [c for c in world.detect().contacts if {c.a, c.b} == {sheet, other}]
        return bool(pairs) and pairs[0].touching

    assert touching()
    world.set_excluded_labels(sheet, 7, other, 7, True)
    assert world.excluded_labels(other, 7, sheet, 7)
    assert not world.excluded_labels(other, 7, sheet, 7, kind=tact.LabelKind.vertex)
    assert not touching()
    world.set_excluded_labels(other, 7, sheet, 7, False)
    assert touching()
    with pytest.raises(tact.Error, match="label 0"):
        world.set_excluded_labels(sheet, 0, other, 7, True)


def test_neighbours_are_left_out():
    world = tact.World(tact.Settings(within_reach=True))
    x = np.column_stack([0.1 * np.arange(12), np.zeros((12, 2))])
    edges = np.column_stack([np.arange(11), np.arange(1, 12)])
    rope = world.add_body(x, edges=edges, margin=0.12, self_contact=True)
    assert len(world.detect().contacts[0].within_reach) > 0
    world.set_self_contact_filter(rope, rings=3)
    assert len(world.detect().contacts) == 0
    assert world.self_contact_filter(rope).rings == 3
    world.set_self_contact_filter(rope, rest_distance=0.31, rest_positions=x)
    assert len(world.detect().contacts) == 0
    assert np.array_equal(world.self_contact_filter(rope).rest_positions, x)
    world.set_self_contact_filter(rope)
    assert len(world.detect().contacts) == 1


def test_meshes_of_edges_change(scene):
    world, sheet = scene
    world.set_feature_settings(sheet, facet_labels=[20, 21])
    world.set_facets(sheet, SQUARE, FACETS[1:], range(4), edges=[[0, 1]], points=[1], facet_map=[1])
    assert world.edges(sheet).tolist() == [[0, 1]]
    assert world.points(sheet).tolist() == [1]
    assert world.feature_settings(sheet).facet_labels.tolist() == [21]
