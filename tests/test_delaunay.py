"""Triangulations of points: Delaunay's, constrained, trimmed (S1 random triangulations, G2)."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm

pytest.importorskip("pythoncdt", reason="pip install halfmesh[delaunay]")

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]
SIDES = [[0, 1], [1, 2], [2, 3], [3, 0]]
grid_points = st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=3, max_size=25)


def exact(points):
    return [(Fraction(float(x)), Fraction(float(y))) for x, y, *_ in np.asarray(points, dtype=float).tolist()]


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def in_circle(a, b, c, d):
    """Positive if d lies inside the circle through a, b, c, which turn left."""
    rows = [(p[0] - d[0], p[1] - d[1]) for p in (a, b, c)]
    (ax, ay), (bx, by), (cx, cy) = rows
    squares = [x * x + y * y for x, y in rows]
    return squares[0] * (bx * cy - by * cx) - squares[1] * (ax * cy - ay * cx) + squares[2] * (ax * by - ay * bx)


def assert_delaunay(mesh):
    """Every triangle turns left, its circle is empty, and the boundary is convex: exactly."""
    p = exact(mesh.points)
    for triangle in mesh.triangles().tolist():
        a, b, c = (p[v] for v in triangle)
        assert turn(a, b, c) > 0
        assert all(in_circle(a, b, c, d) <= 0 for d in p)
    (rim,) = mesh.boundary_loops()
    around = [p[v] for v in mesh.topology.origin[rim].tolist()]
    assert all(turn(around[i - 2], around[i - 1], around[i]) <= 0 for i in range(len(around)))


@given(grid_points)
def test_any_points_on_a_grid_have_empty_circles_and_a_convex_hull(points):
    if all(turn(min(points), max(points), p) == 0 for p in points):
        with pytest.raises(hm.InvalidMeshError, match="on a line"):
            hm.delaunay(points)
        return
    mesh = hm.delaunay(points)
    assert_delaunay(mesh)
    assert mesh.n_isolated_vertices == len(points) - len(set(points))


@pytest.mark.parametrize("flatness", [1e-3, 1e-9, 1e-15, 1e-17])
def test_a_hull_that_is_nearly_straight_is_still_convex(flatness):
    x = np.linspace(0, 1, 12)
    assert_delaunay(hm.delaunay(np.vstack([np.column_stack([x, -flatness * x * (1 - x)]), [0.5, 3]])))


def test_random_points_are_all_used_and_the_square_is_covered():
    mesh = hm.shapes.random_triangulation(300, seed=4)
    assert_delaunay(mesh)
    assert (mesh.n_vertices, mesh.n_isolated_vertices, mesh.euler_characteristic) == (300, 0, 1)
    assert np.array_equal(mesh.points, hm.shapes.random_triangulation(300, seed=4).points)


def test_g2_a_grid_of_isqrt_n_squared_vertices_has_two_triangles_a_cell():
    side = math.isqrt(1000)
    mesh = hm.shapes.grid(side - 1, triangles=True)
    assert (mesh.n_vertices, mesh.n_faces) == (side**2, 2 * (side - 1) ** 2)
    assert hm.delaunay(mesh.points[:, :2]).n_faces == mesh.n_faces


def test_height_is_carried_and_not_looked_at():
    mesh = hm.delaunay([[0, 0, 5], [1, 0, 6], [0, 1, 7]])
    assert mesh.points[:, 2].tolist() == [5, 6, 7]
    assert mesh.n_faces == 1


@pytest.mark.parametrize("scale", [1e-200, 1e-30, 1.0, 1e30, 1e200])
def test_size_makes_no_difference(scale):
    points = np.random.default_rng(2).random((40, 2))
    assert np.array_equal(hm.delaunay(points * scale).triangles(), hm.delaunay(points).triangles())


def test_points_that_are_equal_to_earlier_ones_are_isolated():
    mesh = hm.delaunay([[0, 0], [1, 0], [0, 0], [0, 1], [1, -0.0]])
    assert [v.index for v in mesh.vertices if v.is_isolated] == [2, 4]
    assert mesh.triangles().tolist() in ([[0, 1, 3]], [[1, 3, 0]], [[3, 0, 1]])


# -------------------------------------------------------------------------------------------------------- constrained


def test_segments_are_edges_and_marked():
    mesh = hm.delaunay([[0, 0], [4, -1], [8, 0], [4, 1]], segments=[*SIDES, [0, 2]])
    assert mesh.find_halfedge(0, 2) is not None  # Delaunay's own diagonal is the short one
    assert hm.delaunay(mesh.points).find_halfedge(0, 2) is None
    of = mesh.edge_data["segment"]
    ends = np.sort(mesh.edge_vertices(), axis=1)
    assert sorted(of.tolist()) == [0, 1, 2, 3, 4]
    assert all(sorted([*SIDES, [0, 2]][i]) == ends[e].tolist() for e, i in enumerate(of.tolist()))


def test_what_segments_do_not_enclose_is_left_out_and_points_there_are_isolated():
    ell = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
    mesh = hm.delaunay([*ell, [1.8, 1.8], [0.5, 0.5]], segments=[[i, (i + 1) % 6] for i in range(6)])
    assert hm.geometry.area(mesh) == 3.0
    assert [v.index for v in mesh.vertices if v.is_isolated] == [6]
    assert mesh.vertices[7].degree > 2


def test_holes_reach_as_far_as_the_next_segments():
    ring = [[x + 1, y + 1] for x, y in SQUARE]
    outer = [[3 * x, 3 * y] for x, y in SQUARE]
    inner_sides = [[a + 4, b + 4] for a, b in SIDES]
    whole = hm.delaunay(outer + ring, segments=SIDES + inner_sides)
    frame = hm.delaunay(outer + ring, segments=SIDES + inner_sides, holes=[[1.5, 1.5]])
    assert (hm.geometry.area(whole), hm.geometry.area(frame)) == (9.0, 8.0)
    assert (whole.n_boundary_loops, frame.n_boundary_loops) == (1, 2)


def test_a_hole_outside_of_everything_changes_nothing():
    assert hm.delaunay(SQUARE, holes=[[9, 9]]).n_faces == 2


def test_a_segment_through_points_is_several_edges():
    points = [[0, 0], [1, 0], [2, 0], [1, 1], [1, -1]]
    mesh = hm.delaunay(points, segments=[[0, 2], [2, 3], [3, 0], [0, 4], [4, 2]])
    along = mesh.edge_vertices()[mesh.edge_data["segment"] == 0]
    assert np.sort(along, axis=1)[np.argsort(along.min(axis=1))].tolist() == [[0, 1], [1, 2]]


def test_segments_may_name_points_that_are_equal_to_others():
    mesh = hm.delaunay([*SQUARE, [0, 0]], segments=[[4, 1], [1, 2], [2, 3], [3, 4]])
    assert hm.geometry.area(mesh) == 1.0


@pytest.mark.parametrize(
    ("arguments", "reason", "says"),
    [
        ({"points": [[0, 0], [1, 1], [2, 2]]}, "collinear", "3 points lie on a line"),
        ({"points": [[1, 2]] * 5}, "collinear", "lie on a line"),
        ({"points": []}, "collinear", "0 points"),
        ({"points": [*SQUARE, [0.5, np.nan]]}, "not_finite", "row 4"),
        ({"points": [*SQUARE, [np.inf, 0]]}, "not_finite", "row 4"),
        ({"points": SQUARE, "segments": [[0, 2], [1, 3]]}, "crossing_segments", "cross; put a point"),
        ({"points": SQUARE, "segments": [[0, 4]]}, "index_out_of_range", "outside 0..3"),
        ({"points": SQUARE, "segments": [[-1, 2]]}, "index_out_of_range", "outside 0..3"),
        ({"points": SQUARE, "segments": [[1, 1]]}, "loop_edge", "to itself"),
        ({"points": SQUARE, "segments": [[0, 1]]}, "not_enclosed", "no closed loop"),
        ({"points": SQUARE, "holes": [[0.5, 0.5]]}, "not_enclosed", "is a hole"),
        ({"points": SQUARE, "holes": [[np.nan, 0.5]]}, "not_finite", "holes must be finite"),
    ],
)
def test_what_can_not_be_triangulated_is_refused_with_a_reason(arguments, reason, says):
    with pytest.raises(hm.InvalidMeshError, match=says) as caught:
        hm.delaunay(**arguments)
    assert caught.value.reason == reason


def test_crossing_segments_are_named_as_they_were_given():
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.delaunay([[0, 0], *SQUARE], segments=[[1, 3], [2, 4]])
    assert sorted(np.sort(caught.value.elements["edges"], axis=1).tolist()) == [[1, 3], [2, 4]]


def test_without_the_library_the_error_says_what_to_install(monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "pythoncdt", None)
    with pytest.raises(ImportError, match=r"pip install halfmesh\[delaunay\]"):
        hm.delaunay(SQUARE)
