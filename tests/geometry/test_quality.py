"""The shapes of polygons: by hand, in closed form, and against an exact kernel."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm
import polygons
from polygons import (
    DOUBLED_CORNER,
    KEYHOLE,
    LETTER_L,
    PINCHED,
    SLIT,
    SPIKE,
    SQUARE,
    SQUARE_WITH_MIDPOINTS,
    as_mesh,
    as_mesh_with_shared_vertices,
    comb,
    spiral,
    star,
    tree_of_triangles,
)

g = hm.geometry
PENTAGRAM = [(math.cos(4 * math.pi * i / 5), math.sin(4 * math.pi * i / 5)) for i in range(5)]
SHAPES = {
    name: polygon
    for name, polygon in vars(polygons).items()
    if name.isupper() and name not in {"SLIT", "SPIKE", "KEYHOLE", "TWO_HOLES"}
}


def quality_of(polygon):
    return {name: column[0] for name, column in g.polygon_quality(as_mesh(polygon)).as_dict().items()}


def turned(polygon, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.asarray(polygon, float) @ [[c, s], [-s, c]]


def exact_kernel_area(polygon):
    """All crossings of the lines through the sides that no side has on its right: their hull, in fractions."""
    p = [(Fraction(float(x)), Fraction(float(y))) for x, y in np.asarray(polygon, float)[:, :2]]
    lines = []
    for (ax, ay), (bx, by) in zip(p, [*p[1:], p[0]], strict=True):
        if (ax, ay) != (bx, by):
            lines.append((ay - by, bx - ax, (bx - ax) * ay - (by - ay) * ax))  # a x + b y >= c on the left
    found = set()
    for (a, b, c), (d, e, f) in combinations(lines, 2):
        if a * e - b * d:
            x, y = (c * e - b * f) / (a * e - b * d), (a * f - c * d) / (a * e - b * d)
            if all(i * x + j * y >= k for i, j, k in lines):
                found.add((x, y))
    if len(found) < 3:
        return 0.0
    cx, cy = (sum(coordinates) / len(found) for coordinates in zip(*found, strict=True))
    rim = sorted(found, key=lambda q: math.atan2(q[1] - cy, q[0] - cx))
    return float(sum(a * d - b * c for (a, b), (c, d) in zip(rim, [*rim[1:], rim[0]], strict=True)) / 2)


def test_a_square_by_hand():
    assert quality_of(SQUARE) == {
        "n_sides": 4, "min_angle": math.pi / 2, "max_angle": math.pi / 2, "edge_ratio": 1.0,
        "area_perimeter_ratio": math.pi / 4, "kernel_ratio": 1.0, "convex": True,
    }  # fmt: skip


def test_a_letter_l_by_hand():
    expected = {
        "n_sides": 6, "min_angle": math.pi / 2, "max_angle": 3 * math.pi / 2, "edge_ratio": 1 / 3,
        "area_perimeter_ratio": 4 * math.pi * 5 / 12**2, "kernel_ratio": 1 / 5, "convex": False,
    }  # fmt: skip
    assert quality_of(LETTER_L) == pytest.approx(expected, rel=1e-14)


def test_a_triangle_of_sides_3_4_5_by_hand():
    found = quality_of([(0, 0), (4, 0), (0, 3)])
    assert found["min_angle"] == pytest.approx(math.atan2(3, 4), rel=1e-15)
    assert (found["edge_ratio"], found["kernel_ratio"]) == (0.6, 1.0)
    assert found["area_perimeter_ratio"] == pytest.approx(4 * math.pi * 6 / 12**2, rel=1e-15)


@given(st.integers(3, 60))
def test_regular_polygons_in_closed_form(n):
    found = {name: column[0] for name, column in g.polygon_quality(hm.shapes.polygon(n)).as_dict().items()}
    angle = math.pi * (1 - 2 / n)
    assert (found["min_angle"], found["max_angle"]) == pytest.approx((angle, angle), rel=1e-12)
    assert found["edge_ratio"] == pytest.approx(1, rel=1e-12)
    assert found["area_perimeter_ratio"] == pytest.approx(math.pi / n / math.tan(math.pi / n), rel=1e-12)
    assert (found["kernel_ratio"], found["convex"]) == (1.0, True)


def test_kernel_of_a_five_pointed_star_is_its_inner_pentagon():
    radii = (1.0, math.cos(2 * math.pi / 5) / math.cos(math.pi / 5))  # so that opposite sides are in line
    rim = [(radii[i % 2] * math.cos(i * math.pi / 5), radii[i % 2] * math.sin(i * math.pi / 5)) for i in range(10)]
    assert quality_of(rim)["kernel_ratio"] == pytest.approx(math.cos(2 * math.pi / 5), rel=1e-12)
    assert not quality_of(rim)["convex"]


@pytest.mark.parametrize("name", SHAPES)
def test_kernel_of_well_known_shapes_is_the_exact_one(name):
    expected = exact_kernel_area(SHAPES[name]) / g.area(as_mesh(SHAPES[name]))
    assert quality_of(SHAPES[name])["kernel_ratio"] == pytest.approx(expected, rel=1e-14)


@given(st.integers(4, 9), st.integers(0, 10**6))
def test_kernel_of_a_star_is_the_exact_one(n, seed):
    polygon = star(n, seed)
    expected = exact_kernel_area(polygon) / g.area(as_mesh(polygon))
    assert quality_of(polygon)["kernel_ratio"] == pytest.approx(expected, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("seed", range(12))
def test_kernel_of_a_random_polygon_of_triangles_is_the_exact_one(seed):
    polygon = tree_of_triangles(6, seed, 3)
    expected = exact_kernel_area(polygon) / g.area(as_mesh(polygon))
    assert quality_of(polygon)["kernel_ratio"] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("polygon", [comb(3), spiral(2), KEYHOLE, SLIT, SPIKE, PINCHED])
@pytest.mark.parametrize("angle", [0, 1, 2, 3])
def test_what_is_not_star_shaped_has_the_kernel_ratio_zero(polygon, angle):
    found = quality_of(turned(polygon, angle))
    assert (found["kernel_ratio"], found["convex"]) == (0.0, False)


def test_a_polygon_that_winds_twice_is_not_convex_though_it_always_turns_left():
    found = quality_of(PENTAGRAM)
    assert found["max_angle"] < math.pi
    assert not found["convex"]


@pytest.mark.parametrize("polygon", [SQUARE_WITH_MIDPOINTS, polygons.TRIANGLE_WITH_A_LONG_SIDE, DOUBLED_CORNER])
def test_straight_and_doubled_corners_leave_a_polygon_convex(polygon):
    assert quality_of(polygon)["convex"]
    assert quality_of(turned(polygon, 1) / 3)["convex"]


def test_a_side_without_length_has_the_edge_ratio_zero():
    assert quality_of(DOUBLED_CORNER)["edge_ratio"] == 0.0


def test_the_end_of_a_slit_is_a_full_turn():
    mesh = as_mesh_with_shared_vertices(SLIT)
    assert g.polygon_quality(mesh).max_angle.tolist() == [2 * math.pi]


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("scale", [1e-150, 0.3, 1e150])
def test_scaling_turning_and_moving_changes_nothing(name, scale):
    polygon = np.asarray(SHAPES[name], float)
    x = np.array([2.0, -1.0, 2.0]) / 3
    y = np.array([2.0, 2.0, -1.0]) / 3
    placed = (polygon[:, :1] * x + polygon[:, 1:] * y + [0.5, -2, 1]) * scale
    assert quality_of(placed) == pytest.approx(quality_of(polygon), rel=1e-9, abs=1e-9)


def test_angles_are_the_corner_angles_of_the_face():
    mesh = hm.polylla(hm.shapes.grid(6, 5, triangles=True))
    mesh.points[:, :2] += np.random.default_rng(0).uniform(-0.1, 0.1, (mesh.n_vertices, 2))
    found, angles = g.polygon_quality(mesh), g.corner_angles(mesh)
    for f in mesh.faces:
        corners = angles[[h.index for h in f.halfedges()]]
        assert found.min_angle[f.index] == pytest.approx(corners.min(), rel=1e-12)
        assert found.max_angle[f.index] == pytest.approx(corners.max(), rel=1e-12)


def test_a_bent_face_is_measured_by_its_shadow():
    flat, bent = np.array(LETTER_L, float), np.zeros((6, 3))
    bent[:, :2], bent[:, 2] = flat, [0.1, 0, 0, 0, 0, 0]
    tall = quality_of(bent)
    assert tall["kernel_ratio"] == pytest.approx(0.2, abs=0.02)
    assert tall["max_angle"] == pytest.approx(1.5 * math.pi, abs=0.02)


def test_a_face_without_area_has_zero_everywhere_but_its_sides():
    found = quality_of([(0, 0), (1, 0), (2, 0)])
    assert found.pop("n_sides") == 3
    assert not any(found.values())


def test_an_infinite_or_missing_coordinate_spoils_no_other_face():
    mesh = hm.shapes.grid(3, 1)
    mesh.points[0] = math.nan, math.inf, 0
    assert g.polygon_quality(mesh).kernel_ratio[1:].tolist() == [1.0, 1.0]


def test_summary_is_of_the_living_and_plain():
    mesh = hm.shapes.grid(3, 1)
    mesh.remove_face(1)
    summary = g.polygon_quality(mesh).summary()
    assert (summary.n_polygons, summary.n_convex, summary.convex_share, summary.star_shaped_share) == (2, 2, 1.0, 1.0)
    plain = json.loads(json.dumps(summary.as_dict()))
    assert plain["edge_ratio"] == {"least": 1.0, "mean": 1.0, "greatest": 1.0}


def test_summary_of_no_polygons_is_zeros():
    summary = g.polygon_quality(hm.Mesh([], n_vertices=2)).summary()
    assert (summary.n_polygons, summary.convex_share, summary.measures["min_angle"].mean) == (0, 0.0, 0.0)
    assert "polygons" in str(summary)
