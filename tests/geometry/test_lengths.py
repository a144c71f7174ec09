"""Edge lengths and vectors."""

from __future__ import annotations

import numpy as np

import halfmesh as hm

g = hm.geometry


def test_edges_of_the_cube_have_length_one():
    assert g.edge_lengths(hm.shapes.cube()).tolist() == [1.0] * 12


def test_lengths_are_the_distances_of_the_ends(animal):
    ends = animal.points[animal.edge_vertices()]
    assert np.allclose(g.edge_lengths(animal), np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), rtol=1e-15)


def test_vectors_run_along_the_first_halfedge(animal):
    t, points = animal.topology, animal.points
    assert np.array_equal(g.edge_vectors(animal), points[t.origin[1::2]] - points[t.origin[::2]])


def test_vectors_around_a_face_add_up_to_zero():
    mesh = hm.shapes.dodecahedron()
    halfedges = np.array([h.index for h in mesh.faces[0].halfedges()])
    sides = g.edge_vectors(mesh)[halfedges >> 1] * (1 - 2 * (halfedges & 1))[:, None]
    assert np.abs(sides.sum(axis=0)).max() < 1e-15


def test_a_length_is_right_where_its_square_overflows():
    mesh = hm.Mesh([[0, 1, 2]], [[0, 0], [3e200, 0], [3e200, 4e200]])
    assert np.allclose(g.edge_lengths(mesh), [3e200, 4e200, 5e200], rtol=1e-15)
