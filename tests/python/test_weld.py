"""Vertices with equal positions become one."""

import numpy as np
import pytest
import tact


def test_weld_tells_positions_facets_and_counts():
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [0, 1, -0.0], [1, 1, 0]], dtype=float)
    mesh = tact.weld(corners, np.array([[0, 1, 2], [3, 5, 4], [1, 3, 2]]))
    assert mesh.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
    assert mesh.facets.tolist() == [[0, 1, 2], [1, 3, 2], [1, 1, 2]]
    assert mesh.vertex_of.tolist() == [0, 1, 2, 1, 2, 3]
    assert (mesh.merged_vertices, mesh.collapsed_facets) == (2, 1)
    assert np.array_equal(mesh.positions[mesh.vertex_of], corners)
    assert repr(mesh) == "<tact.WeldedMesh of 4 vertices, 2 merged>"
    with pytest.raises(ValueError):
        mesh.positions[0, 0] = 1


def test_what_is_given_is_checked():
    with pytest.raises(tact.Error) as error:
        tact.weld(np.zeros((2, 3)), np.array([[0, 1, 2]]))
    assert error.value.code == tact.ErrorCode.facet_out_of_range
    with pytest.raises(TypeError):
        tact.weld("three points", np.array([[0, 0, 0]]))


def test_a_folder_is_no_recording(tmp_path):
    with pytest.raises(IsADirectoryError, match="the recording is a folder"):
        tact.RecordingPlayer(tmp_path)
