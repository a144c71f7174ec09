"""Centers of faces and of the surface."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm

g = hm.geometry
CONCAVE = np.array([[0, 0, 0], [4, 0, 0], [4, 3, 0], [2, 1, 0], [0, 3, 0]], dtype=float)


def test_barycenters_are_the_means_of_the_corners(animal):
    indices, offsets = animal.face_vertices()
    expected = [animal.points[row].mean(axis=0) for row in np.split(indices, offsets[1:-1])] if animal.n_faces else []
    assert np.allclose(g.face_barycenters(animal), np.reshape(expected, (-1, 3)), atol=1e-14)


def test_centroids_of_triangles_are_their_barycenters():
    mesh = hm.shapes.icosphere(1)
    assert np.array_equal(g.face_centroids(mesh), g.face_barycenters(mesh))


def test_centroid_of_a_concave_polygon_is_that_of_its_triangulation():
    whole = hm.Mesh([range(5)], CONCAVE)
    parts = hm.Mesh([[0, 1, 3], [1, 2, 3], [0, 3, 4]], CONCAVE)
    assert np.allclose(g.face_centroids(whole)[0], g.centroid(parts), atol=1e-15)


def test_a_corner_more_does_not_move_the_centroid():
    square = hm.Mesh([range(5)], [[0, 0], [1, 0], [2, 0], [2, 2], [0, 2]])
    assert np.allclose(g.face_centroids(square)[0], [1, 1, 0], atol=1e-15)
    assert g.face_barycenters(square)[0].tolist() == [1, 0.8, 0]


@given(st.integers(0, 4), st.integers(0, 99))
def test_the_centroid_does_not_depend_on_the_first_corner(first, seed):
    points = CONCAVE + np.random.default_rng(seed).normal(scale=0.1, size=CONCAVE.shape)
    one, other = (hm.Mesh([row], points) for row in (range(5), np.roll(range(5), first).tolist()))
    assert np.allclose(g.face_centroids(one), g.face_centroids(other), atol=1e-12)


def test_a_polygon_on_a_line_has_its_barycenter():
    mesh = hm.Mesh([range(4)], np.array([0.1, 0.7, 0.3, 0.9])[:, None] * [[1.1, 0.7, 0.3]])
    assert np.array_equal(g.face_centroids(mesh), g.face_barycenters(mesh))


@pytest.mark.parametrize("shape", ["cube", "octahedron", "dodecahedron", "icosphere", "torus"])
def test_centroid_of_a_symmetric_surface_is_its_middle(shape):
    mesh = getattr(hm.shapes, shape)()
    assert np.allclose(g.centroid(mesh), mesh.points.mean(axis=0), atol=1e-14)


def test_centroid_of_a_cone_is_two_thirds_down():
    assert np.allclose(g.centroid(hm.shapes.cone_fan(50, height=3)), [0, 0, 1], atol=1e-14)


def test_a_surface_without_area_has_no_centroid():
    for mesh in (hm.Mesh([[0, 1, 2]]), hm.Mesh([], edges=[[0, 1]])):
        with pytest.raises(hm.PreconditionError, match="no area"):
            g.centroid(mesh)


def test_bounding_box_holds_isolated_vertices_too():
    mesh = hm.Mesh([[0, 1, 2]], [[0, 0, 0], [1, 0, 0], [0, 1, -2], [7, 8, 9]])
    assert g.bounding_box(mesh).tolist() == [[0, 0, -2], [7, 8, 9]]


def test_nothing_has_no_bounding_box():
    with pytest.raises(hm.PreconditionError, match="no bounding box"):
        g.bounding_box(hm.Mesh([]))
