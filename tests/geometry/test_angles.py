"""Corner angles, and what they add up to."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm

g = hm.geometry
CLOSED = ["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron", "icosphere", "torus"]
OPEN = ["grid", "disk", "cylinder", "cone_fan", "polygon", "seed_triangulation"]


def angles_at_vertices(mesh):
    return np.bincount(mesh.topology.origin, weights=g.corner_angles(mesh), minlength=mesh.n_vertices)


@pytest.mark.parametrize("shape", CLOSED + OPEN)
def test_gauss_bonnet(shape):
    """Angle defects inside, and turns at the boundary, add up to 2 pi times the Euler characteristic."""
    mesh = getattr(hm.shapes, shape)()
    on_boundary = np.bincount(mesh.topology.origin, weights=mesh.topology.face < 0, minlength=mesh.n_vertices)
    defects = (2 - on_boundary) * np.pi - angles_at_vertices(mesh)
    assert defects.sum() == pytest.approx(2 * np.pi * mesh.euler_characteristic, abs=1e-10)


def test_gauss_bonnet_on_any_triangle_mesh(animal):
    if animal.is_triangular and animal.n_faces and g.face_areas(animal).min() > 0:
        sums = np.bincount(animal.topology.face[animal.topology.face >= 0],
                           weights=g.corner_angles(animal)[animal.topology.face >= 0])  # fmt: skip
        assert np.allclose(sums, np.pi, atol=1e-14)


def test_angles_of_a_concave_polygon_add_up_and_the_reflex_one_is_more_than_pi():
    mesh = hm.Mesh([range(5)], [[0, 0], [4, 0], [4, 3], [2, 1], [0, 3]])
    angles = np.degrees(g.corner_angles(mesh)[mesh.corner_halfedges()])
    assert np.allclose(angles, [90, 90, 45, 270, 45], atol=1e-12)


def test_a_straight_corner_is_pi():
    mesh = hm.Mesh([range(4)], [[0, 0], [1, 0], [2, 0], [0, 1]])
    assert g.corner_angles(mesh)[mesh.corner_halfedges()[1]] == np.pi


def test_the_end_of_a_slit_sees_the_face_all_around():
    mesh = hm.Mesh([[0, 1, 2, 3, 2]], [[-1, -1], [1, -1], [0, 2], [0, 0]])
    angles = g.corner_angles(mesh)
    assert angles[mesh.corner_halfedges()[3]] == 2 * np.pi
    assert angles.sum() == pytest.approx(3 * np.pi, abs=1e-14)


def test_exterior_halfedges_have_no_angle(animal):
    assert not g.corner_angles(animal)[animal.topology.face < 0].any()


def test_an_edge_without_length_has_the_angle_zero():
    mesh = hm.Mesh([[0, 1, 2]], [[0, 0], [0, 0], [1, 0]])
    assert g.corner_angles(mesh).tolist() == [0.0] * 6


def test_angles_of_a_needle_keep_their_digits():
    mesh = hm.Mesh([[0, 1, 2]], [[0, 0], [1, 0], [1, 1e-12]])
    assert g.corner_angles(mesh)[mesh.corner_halfedges()[0]] == pytest.approx(1e-12, rel=1e-15)


numbers = st.floats(-1e150, 1e150, allow_subnormal=False)


@given(st.floats(0, 1e150, allow_subnormal=False), numbers)
def test_angle_from_is_atan2_to_two_units_in_the_last_place(sine, cosine):
    angle = g.kernels.angle_from.plain(sine, cosine)
    assert abs(angle - math.atan2(sine, cosine + 0.0)) <= 2 * math.ulp(angle)


@pytest.mark.parametrize("sine", [-1.0, -0.0, 0.0, 1.0])
@pytest.mark.parametrize("cosine", [-1.0, 0.0, 1.0])
def test_angle_from_at_the_quarters(sine, cosine):
    assert g.kernels.angle_from(sine, cosine) == math.atan2(sine + 0.0, cosine) % (2 * math.pi)


def test_angle_from_is_steady_where_its_cases_meet():
    """On a fine net around the circle, compiled."""
    turn = np.linspace(0, 2 * np.pi, 20_001)[:-1]
    found = [g.kernels.angle_from.plain(math.sin(x), math.cos(x)) for x in turn.tolist()]
    assert np.abs(found - turn).max() < 1e-15
