"""Triangulation of polygons that nobody drew, against slow obvious answers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm
import polygons
from halfmesh.algorithms._orientation import orientation
from polygons import (
    as_mesh,
    as_mesh_with_shared_vertices,
    doubled_area,
    doubled_areas,
    joined_twice,
    signed_area,
)

seeds = st.integers(0, 2**32 - 1)
qualities = st.sampled_from(["delaunay", "any"])


@given(st.integers(4, 60), seeds, qualities)
def test_star_is_covered(n, seed, quality):
    polygon = polygons.star(n, seed)
    mesh = as_mesh(polygon)
    hm.triangulate(mesh, quality=quality)
    hm.testing.assert_valid(mesh)
    areas = doubled_areas(mesh)
    assert (len(areas), mesh.euler_characteristic) == (n - 2, 1)
    assert min(areas) > 0
    assert float(sum(areas)) == pytest.approx(2 * signed_area(polygon), rel=1e-13)


@given(st.integers(2, 80), seeds, st.integers(1, 6), qualities)
def test_polygon_that_touches_itself_everywhere_is_covered(n, seed, size, quality):
    polygon = polygons.tree_of_triangles(n, seed, size)
    mesh = as_mesh(polygon)
    hm.triangulate(mesh, quality=quality)
    areas = doubled_areas(mesh)
    assert len(areas) == len(polygon) - 2
    assert min(areas) >= 0
    assert sum(areas) == len(polygon) - 2


@given(st.integers(2, 250), seeds, st.integers(1, 9))
def test_no_triangle_is_without_area_where_all_can_have_some(n, seed, size):
    mesh = as_mesh(polygons.tree_of_triangles(n, seed, size))
    hm.triangulate(mesh)
    assert min(doubled_areas(mesh)) > 0


@given(st.integers(2, 80), seeds, st.integers(1, 6))
def test_face_that_passes_vertices_many_times_gets_no_doubled_edge_and_no_loop(n, seed, size):
    polygon = polygons.tree_of_triangles(n, seed, size)
    mesh = as_mesh_with_shared_vertices(polygon)
    hm.triangulate(mesh)
    hm.testing.assert_valid(mesh)
    assert not joined_twice(mesh)
    assert min(doubled_areas(mesh)) >= 0


@given(st.integers(2, 60), seeds, st.integers(1, 5), st.tuples(*[st.integers(-9, 9)] * 3))
def test_polygon_in_any_plane_with_whole_coordinates_is_covered_exactly(n, seed, size, slopes):
    x, y = polygons.tree_of_triangles(n, seed, size).T
    a, b, c = slopes
    mesh = as_mesh(np.c_[x + c * y, y, a * x + b * y])  # a shear, and a slope
    hm.triangulate(mesh)
    assert min(doubled_areas(mesh, np.c_[x, y])) >= 0


@given(st.integers(4, 14), seeds, qualities)
def test_every_diagonal_is_inside_by_looking_at_all_sides(n, seed, quality):
    polygon = polygons.star(n, seed)
    mesh = as_mesh(polygon)
    hm.triangulate(mesh, quality=quality)
    diagonals = mesh.edge_vertices()[n:]
    assert len(diagonals) == n - 3
    assert all(polygons.is_inside(polygon, i, k) for i, k in diagonals)


@given(st.data())
def test_best_of_all_triangulations_is_found_where_chords_are_taken(data):
    """Any corners on a small lattice; some pairs are joined by wire. Compared with every triangulation there is."""
    n = data.draw(st.integers(4, 7))
    corners = data.draw(st.lists(st.tuples(*[st.integers(0, 3)] * 2), min_size=n, max_size=n))
    polygon = np.array(corners, float)
    if signed_area(polygon) < 0:
        polygon = polygon[::-1]
    if signed_area(polygon) == 0:
        return
    chords = [(i, k) for i in range(n) for k in range(i + 2, n) if (i, k) != (0, n - 1)]
    taken = data.draw(st.lists(st.sampled_from(chords), unique=True, max_size=len(chords)))
    turned_over, doubled = min(faults(polygon, t, taken) for t in all_triangulations(0, n - 1))
    mesh = hm.Mesh([range(n)], polygon, edges=taken or None)
    if doubled:
        with pytest.raises(hm.TopologyError):
            hm.triangulate(mesh)
    else:
        hm.triangulate(mesh)
        assert not joined_twice(mesh)
        assert sum(a < 0 for a in doubled_areas(mesh)) == turned_over


def all_triangulations(i, j):
    if j - i < 2:
        yield []
    for k in range(i + 1, j):
        for left in all_triangulations(i, k):
            for right in all_triangulations(k, j):
                yield [*left, *right, (i, k, j)]


def faults(polygon, triangles, taken):
    turned_over = sum(doubled_area(*polygon[list(t)]) < 0 for t in triangles)
    return turned_over, sum((i, j) in taken for i, _, j in triangles)


# ------------------------------------------------------------------------------------------------------- orientation

coordinate = st.one_of(
    st.integers(-3, 3).map(float), st.floats(-2, 2, allow_subnormal=False).filter(lambda x: x == 0 or abs(x) > 1e-60)
)


@given(st.lists(coordinate, min_size=6, max_size=6))
def test_orientation_has_the_exact_sign(numbers):
    p = np.array(numbers).reshape(2, 3)
    assert np.sign(orientation.interpreted(p, 0, 1, 2)) == sign(doubled_area(*p.T))


@given(seeds, st.integers(0, 3))
def test_orientation_of_nearly_straight_corners_has_the_exact_sign(seed, bits):
    """Corners on a line, each coordinate moved by a few units in the last place."""
    rng = np.random.default_rng(seed)
    start, way, along = rng.uniform(-1, 1, 2), rng.uniform(-1, 1, 2), rng.uniform(-1, 1, 3)
    p = (start + along[:, None] * way).T * (1 + rng.integers(-bits, bits + 1, (2, 3)) * 2.0**-52)
    assert np.sign(orientation.interpreted(p, 0, 1, 2)) == sign(doubled_area(*p.T))
    assert np.sign(orientation(p, 0, 1, 2)) == np.sign(orientation.interpreted(p, 0, 1, 2))


def sign(x):
    return (x > 0) - (x < 0)
