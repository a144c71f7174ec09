"""Areas and area vectors."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm

g = hm.geometry
CONCAVE = [[0, 0], [4, 0], [4, 3], [2, 1], [0, 3]]


def textbook_newell(polygon):
    return np.cross(polygon, np.roll(polygon, -1, axis=0)).sum(axis=0) / 2


def rows(mesh):
    indices, offsets = mesh.face_vertices()
    return np.split(indices, offsets[1:-1]) if mesh.n_faces else []


def test_area_of_the_cube_is_six():
    assert g.area(hm.shapes.cube()) == 6.0


def test_area_vectors_are_newell_sums(animal):
    expected = [textbook_newell(animal.points[row]) for row in rows(animal)]
    assert np.allclose(g.face_vectors(animal), np.reshape(expected, (-1, 3)), atol=1e-13)


def test_area_of_a_concave_polygon():
    assert g.face_areas(hm.Mesh([range(5)], CONCAVE)).tolist() == [8.0]


def test_area_vectors_of_a_closed_surface_add_up_to_zero(animal):
    if not animal.has_boundary:
        assert np.abs(g.face_vectors(animal).sum(axis=0)).max(initial=0) < 1e-12


@given(st.integers(3, 40))
def test_a_regular_polygon_has_the_area_of_its_triangulation(n):
    mesh = hm.shapes.polygon(n)
    triangles = hm.Mesh([[0, i, i + 1] for i in range(1, n - 1)], mesh.points)
    assert g.area(mesh) == pytest.approx(g.area(triangles), rel=1e-14)
    assert g.area(mesh) == pytest.approx(n / 2 * np.sin(2 * np.pi / n), rel=1e-14)


def test_area_is_kept_a_billion_units_away_from_the_origin():
    mesh = hm.shapes.grid(3, 3)
    mesh.points += 2.0**30
    assert g.face_areas(mesh).tolist() == [1.0] * 9


@pytest.mark.parametrize(
    ("finer", "exact"),
    [
        (lambda k: hm.shapes.icosphere(k), 4 * np.pi),
        (lambda k: hm.shapes.torus(8 * 2**k, 4 * 2**k), 4 * np.pi**2 * 0.4),
        (lambda k: hm.shapes.disk(4, 6 * 2**k), np.pi),
        (lambda k: hm.shapes.cylinder(6 * 2**k, 2, closed=True), 6 * np.pi),
    ],
    ids=["sphere", "torus", "disk", "cylinder"],
)
def test_area_converges_with_order_two(finer, exact):
    errors = np.array([abs(g.area(finer(k)) - exact) for k in (2, 3, 4)])
    assert np.allclose(np.log2(errors[:-1] / errors[1:]), 2, atol=0.1)
