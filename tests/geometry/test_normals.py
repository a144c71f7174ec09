"""Normals of faces and of vertices."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm

g = hm.geometry
WEIGHTS = ["angle", "area"]


def textbook_vertex_normals(mesh, weights):
    t, angles, areas, normals = mesh.topology, g.corner_angles(mesh), g.face_areas(mesh), g.face_normals(mesh)
    result = np.zeros((mesh.n_vertices, 3))
    for h in np.flatnonzero(t.face >= 0):
        f = t.face[h]
        result[t.origin[h]] += (angles[h] if weights == "angle" else areas[f]) * normals[f]
    size = np.linalg.norm(result, axis=1, keepdims=True)
    return np.divide(result, size, where=size > 1e-9, out=np.zeros_like(result))


@pytest.mark.parametrize(
    "shape", ["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron", "icosphere", "torus"]
)
def test_normals_of_closed_shapes_point_outward(shape):
    mesh = getattr(hm.shapes, shape)()
    assert g.volume(mesh) > 0
    core = mesh.points.mean(axis=0)
    if shape == "torus":
        core = mesh.points * [1, 1, 0] / np.linalg.norm(mesh.points[:, :2], axis=1, keepdims=True)
    assert ((mesh.points - core) * g.vertex_normals(mesh)).sum(axis=1).min() > 0


def test_face_normals_have_length_one_and_the_direction_of_the_area_vectors(animal):
    vectors, normals = g.face_vectors(animal), g.face_normals(animal)
    areas = g.face_areas(animal)
    assert np.allclose(np.linalg.norm(normals, axis=1), areas > 0, atol=1e-14)
    assert np.allclose(normals * areas[:, None], vectors, atol=1e-14)


@pytest.mark.parametrize("weights", WEIGHTS)
def test_vertex_normals_are_the_weighted_means_of_the_face_normals(animal, weights):
    normals = g.vertex_normals(animal, weights=weights)
    expected = textbook_vertex_normals(animal, weights)
    sure = np.linalg.norm(expected, axis=1) > 0
    assert np.allclose(normals[sure], expected[sure], atol=1e-9)


@pytest.mark.parametrize("weights", WEIGHTS)
def test_normals_of_a_polyhedron_with_equal_corners_point_from_its_center(weights):
    for shape in (hm.shapes.tetrahedron, hm.shapes.octahedron, hm.shapes.icosahedron, hm.shapes.dodecahedron):
        mesh = shape()
        assert np.allclose(g.vertex_normals(mesh, weights=weights), mesh.points, atol=1e-14)


def test_angle_weights_do_not_see_how_the_cube_is_cut_and_area_weights_do():
    quads = hm.shapes.cube()
    corners = quads.face_vertices()[0].reshape(-1, 4)
    triangles = hm.Mesh(np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]), quads.points)
    diagonal = (quads.points * 2 - 1) / 3**0.5
    assert np.allclose(g.vertex_normals(triangles), diagonal, atol=1e-14)
    assert not np.allclose(g.vertex_normals(triangles, weights="area"), diagonal, atol=0.1)


@pytest.mark.parametrize("triangles", [False, True], ids=["quads", "triangles"])
@pytest.mark.parametrize("weights", WEIGHTS)
def test_vertex_normals_of_the_torus_converge_with_order_two(weights, triangles):
    errors = []
    for k in (3, 4, 5):
        mesh = hm.shapes.torus(8 * 2**k, 4 * 2**k, triangles=triangles)
        circle = mesh.points * [1, 1, 0] / np.linalg.norm(mesh.points[:, :2], axis=1, keepdims=True)
        exact = (mesh.points - circle) / 0.4
        errors.append(np.linalg.norm(g.vertex_normals(mesh, weights=weights) - exact, axis=1).max())
    assert np.allclose(np.log2(np.divide(errors[:-1], errors[1:])), 2, atol=0.15)


def test_an_isolated_vertex_has_no_normal():
    mesh = hm.Mesh([[0, 1, 2]], [[0, 0], [1, 0], [0, 1], [5, 5]])
    assert g.vertex_normals(mesh).tolist() == [[0, 0, 1]] * 3 + [[0, 0, 0]]


def test_faces_back_to_back_cancel_each_other():
    pillow = hm.Mesh([[0, 1, 2], [2, 1, 0]], [[0, 0], [1, 0], [0, 1]])
    assert not g.vertex_normals(pillow).any()


def test_a_triangle_without_area_does_not_spoil_its_vertices():
    mesh = hm.Mesh([[0, 1, 2], [1, 0, 3]], [[0, 0], [2, 0], [0, 2], [1, 0]])
    assert g.vertex_normals(mesh).tolist() == [[0, 0, 1]] * 3 + [[0, 0, 0]]


def test_a_ring_larger_than_the_buffer_is_summed_up():
    mesh = hm.shapes.cone_fan(2000)
    assert np.allclose(g.vertex_normals(mesh)[0], [0, 0, 1], atol=1e-12)


def test_other_weights_are_refused():
    with pytest.raises(ValueError, match="'angle' or 'area', not 'beauty'"):
        g.vertex_normals(hm.shapes.cube(), weights="beauty")
