"""Shapes of polygons, against figures that can be told by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm

quality = hm.geometry.polygon_quality
ELL = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
COMB = [[0, 0], [7, 0], [7, 3], [6, 3], [6, 1], [4, 1], [4, 3], [3, 3], [3, 1], [1, 1], [1, 3], [0, 3]]


def face(points):
    return hm.Mesh([list(range(len(points)))], np.asarray(points, dtype=float))


def star(n, inner=0.3):
    radius = np.where(np.arange(2 * n) % 2, inner, 1.0)
    angle = math.pi / n * np.arange(2 * n)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def values(mesh):
    q = quality(mesh)
    return [float(x[0]) for x in (q.min_angle, q.max_angle, q.edge_ratio, q.area_perimeter_ratio, q.kernel_ratio)]


def kernel_by_hand(points):
    """All places where the lines of two sides meet, as far as they see every side; then the area of their hull."""
    p = np.asarray(points, dtype=float)
    sides = [(p[i - 1], p[i]) for i in range(len(p))]
    places = []
    for i, (a, b) in enumerate(sides):
        for c, d in sides[:i]:
            m = np.column_stack([b - a, c - d])
            if abs(np.linalg.det(m)) > 1e-12:
                places.append(a + np.linalg.solve(m, c - a)[0] * (b - a))
    seeing = [x for x in places if all(turn(a, b, x) > -1e-9 for a, b in sides)]
    if len(seeing) < 3:
        return 0.0
    middle = np.mean(seeing, axis=0)
    around = np.array(sorted(seeing, key=lambda x: math.atan2(*(x - middle)[::-1])))
    return abs(sum(turn(middle, around[i - 1], around[i]) for i in range(len(around)))) / 2


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


@pytest.mark.parametrize("n", [3, 4, 5, 6, 12, 100])
def test_regular_polygons_have_their_closed_forms(n):
    angle = math.pi * (1 - 2 / n)
    compact = math.pi / (n * math.tan(math.pi / n))
    assert values(hm.shapes.polygon(n)) == pytest.approx([angle, angle, 1, compact, 1], rel=1e-9)
    assert quality(hm.shapes.polygon(n)).convex.tolist() == [True]


def test_l_is_seen_from_a_third_of_itself():
    measured = values(face(ELL))
    assert measured == pytest.approx([math.pi / 2, 1.5 * math.pi, 0.5, 4 * math.pi * 3 / 64, 1 / 3])
    assert quality(face(ELL)).convex.tolist() == [False]


def test_comb_is_seen_as_a_whole_from_nowhere():
    assert quality(face(COMB)).kernel_ratio.tolist() == [0.0]


def test_star_is_seen_from_the_middle():
    points = star(5)
    ratio = quality(face(points)).kernel_ratio[0]
    assert 0 < ratio < 1
    assert ratio == pytest.approx(kernel_by_hand(points) / hm.geometry.area(face(points)))


def test_kernel_that_is_a_line_counts_as_none():
    z = [[0, 0], [2, 0], [2, 2], [4, 2], [4, 3], [2, 3], [2, 1], [0, 1]]
    assert quality(face(z)).kernel_ratio.tolist() == [0.0]


def test_straight_corners_do_not_matter_for_convexity():
    q = quality(face([[0, 0], [0.1, 0], [0.2, 0], [1, 0], [1, 1], [0.7, 1], [0, 1]]))
    assert q.convex.tolist() == [True]
    assert q.kernel_ratio.tolist() == [1.0]
    assert q.max_angle[0] == pytest.approx(math.pi)


def test_pentagram_turns_left_everywhere_and_is_not_convex():
    around = hm.shapes.polygon(5).points
    assert quality(face(around[[0, 2, 4, 1, 3]])).convex.tolist() == [False]


def test_angle_at_the_end_of_a_slit_is_a_full_turn():
    slit = hm.Mesh([[0, 1, 2, 3, 0, 4]], [[0, 0], [2, -1], [2, 1], [-2, 0.0], [1, 0]])
    assert quality(slit).max_angle[0] == pytest.approx(2 * math.pi)


def test_faces_without_area_and_deleted_ones_have_zeros():
    mesh = hm.Mesh([[0, 1, 2], [2, 1, 3]], [[0, 0], [1, 0], [2, 0], [1, 1]])
    mesh.remove_face(1)
    q = quality(mesh)
    assert q.degree.tolist() == [3, 0]
    assert all(not np.asarray(column)[1].any() for column in vars(q).values())
    assert values(mesh) == [0, 0, 0, 0, 0]
    assert q.summary().n_polygons == 1


@given(st.integers(3, 9), st.floats(0.05, 0.95), st.floats(0, 7), st.floats(-50, 50), st.sampled_from([1e-6, 1.0, 1e6]))
def test_size_place_and_direction_make_no_difference(n, inner, angle, tilt, scale):
    points = np.column_stack([star(n, inner), np.zeros(2 * n)])
    c, s, a, b = math.cos(angle), math.sin(angle), math.cos(tilt), math.sin(tilt)
    turned = scale * (
        points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, a, b], [0, -b, a]])
    )
    assert values(face(turned + scale * 3)) == pytest.approx(values(face(points)), rel=1e-6, abs=1e-6)


@given(st.lists(st.floats(0.2, 1.0), min_size=4, max_size=10))
def test_kernel_of_any_star_is_that_of_the_slow_way(radii):
    angle = 2 * math.pi / len(radii) * np.arange(len(radii))
    points = np.column_stack([radii * np.cos(angle), radii * np.sin(angle)])
    ratio = kernel_by_hand(points) / hm.geometry.area(face(points))
    assert quality(face(points)).kernel_ratio[0] == pytest.approx(min(ratio, 1.0), abs=1e-6)


@pytest.mark.large
def test_face_of_ten_thousand_sides_is_measured():
    wavy = star(5000, inner=0.999)
    assert quality(face(wavy)).kernel_ratio[0] > 0.1


def test_summary_prints_a_table_and_gives_numbers():
    mesh = hm.Mesh([[0, 1, 2, 3, 4, 5], [3, 2, 6]], [*ELL, [2, 2]])
    summary = quality(mesh).summary()
    text = str(summary)
    assert text.splitlines()[0].split() == ["2", "polygons", "least", "mean", "largest"]
    assert "sides                            3      4.5        6" in text
    assert summary.as_dict()["degree"] == {"least": 3, "mean": 4.5, "largest": 6}
    assert summary.convex_share == 0.5
    assert quality(hm.Mesh([], n_vertices=1)).summary().n_polygons == 0
