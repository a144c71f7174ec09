"""Cutting faces into triangles: what comes out, what follows, what is refused."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
import polygons
from polygons import as_mesh, as_mesh_with_shared_vertices, doubled_areas, joined_twice, signed_area, state

SIMPLE = {
    name: np.array(getattr(polygons, name), float)
    for name in ("SQUARE", "ARROW", "LETTER_L", "SQUARE_WITH_MIDPOINTS", "TRIANGLE_WITH_A_LONG_SIDE", "CROSS")
} | {"comb": polygons.comb(12), "spiral": polygons.spiral(6), "star": polygons.star(60)}
TOUCHING_ITSELF = {name: np.array(getattr(polygons, name), float) for name in ("SLIT", "KEYHOLE", "TWO_HOLES")}
every_simple = pytest.mark.parametrize("polygon", SIMPLE.values(), ids=SIMPLE)
ROTATION = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]


def exactly_covered(mesh, polygon, without_area=0):
    """All triangles turn counter-clockwise, but for some without area, and make up the polygon."""
    hm.testing.assert_valid(mesh)
    areas = doubled_areas(mesh, polygon)
    return (
        len(areas) == len(polygon) - 2
        and sum(a == 0 for a in areas) == without_area
        and min(areas) >= 0
        and float(sum(areas)) == pytest.approx(2 * signed_area(polygon), rel=1e-14)
    )


# ------------------------------------------------------------------------------------------------------------- polygons


@every_simple
@pytest.mark.parametrize("quality", ["delaunay", "any"])
def test_polygon_is_covered_by_triangles_with_area(polygon, quality):
    for turn in range(0, len(polygon), max(1, len(polygon) // 12)):
        turned = np.roll(polygon, turn, axis=0)
        mesh = as_mesh(turned)
        hm.triangulate(mesh, quality=quality)
        assert exactly_covered(mesh, turned)


@every_simple
@pytest.mark.parametrize("plane", [(0, 1, 2), (1, 2, 0), (2, 0, 1)], ids=["xy", "yz", "zx"])
def test_polygon_in_a_coordinate_plane_is_cut_as_in_every_other(polygon, plane):
    flat, upright = as_mesh(polygon), as_mesh(np.c_[polygon, 0 * polygon[:, 0]][:, np.argsort(plane)])
    hm.triangulate(flat)
    hm.triangulate(upright)
    assert flat.triangles().tolist() == upright.triangles().tolist()


@every_simple
def test_polygon_anywhere_in_space_is_covered(polygon):
    mesh = as_mesh(np.c_[polygon, 0 * polygon[:, 0]] @ ROTATION.T + [5, -7, 11])
    hm.triangulate(mesh)
    assert exactly_covered(mesh, polygon)


@every_simple
def test_polygon_seen_from_behind_is_covered(polygon):
    mesh = as_mesh(polygon[::-1])
    hm.triangulate(mesh)
    assert max(doubled_areas(mesh)) < 0


def test_corners_that_touch_stay_touching_in_a_sloping_plane():
    x, y = polygons.tree_of_triangles(60, 5, 3).T
    mesh = as_mesh(np.c_[x, y, 2 * x - 3 * y])
    hm.triangulate(mesh)
    assert exactly_covered(mesh, np.c_[x, y])


@pytest.mark.parametrize("polygon", TOUCHING_ITSELF.values(), ids=TOUCHING_ITSELF)
def test_face_around_a_hole_or_a_slit_is_covered_and_no_edge_is_doubled(polygon):
    mesh = as_mesh_with_shared_vertices(polygon)
    hm.triangulate(mesh)
    hm.testing.assert_valid(mesh)
    areas = doubled_areas(mesh)
    assert len(areas) == len(polygon) - 2
    assert min(areas) > 0
    assert float(sum(areas)) == 2 * signed_area(polygon)
    assert not joined_twice(mesh)


@pytest.mark.parametrize(
    ("polygon", "without_area"),
    [("DOUBLED_CORNER", 1), ("PINCHED", 2), ("SPIKE", 2), ("TOUCHING_A_SIDE", 1)],
)
def test_triangles_without_area_are_made_where_nothing_else_is_left(polygon, without_area):
    corners = np.array(getattr(polygons, polygon), float)
    mesh = as_mesh(corners)
    hm.triangulate(mesh)
    assert exactly_covered(mesh, corners, without_area)


def test_polygon_of_thousands_of_corners_is_covered():
    for polygon in (polygons.comb(1500), polygons.spiral(500), polygons.star(4000)):
        mesh = as_mesh(polygon)
        hm.triangulate(mesh)
        areas = hm.geometry.face_vectors(mesh)[:, 2]
        assert len(areas) == len(polygon) - 2
        assert areas.min() > 0
        assert areas.sum() == pytest.approx(signed_area(polygon), rel=1e-13)


@pytest.mark.parametrize(("n", "seed", "size"), [(250, 0, 8), (250, 3, 8), (380, 2, 9), (380, 22, 9), (380, 37, 9)])
def test_large_polygon_that_touches_itself_is_covered(n, seed, size):
    polygon = polygons.tree_of_triangles(n, seed, size)
    mesh = as_mesh(polygon)
    hm.triangulate(mesh)
    assert exactly_covered(mesh, polygon)


@pytest.mark.large
def test_polygon_of_a_hundred_thousand_corners_is_covered():
    for polygon in (polygons.comb(25_000), polygons.spiral(12_500), polygons.star(100_000)):
        mesh = as_mesh(polygon)
        hm.triangulate(mesh)
        areas = hm.geometry.face_vectors(mesh)[:, 2]
        assert areas.min() > 0
        assert areas.sum() == pytest.approx(signed_area(polygon), rel=1e-12)


@pytest.mark.parametrize("exponent", [-900, -300, 300, 900])
def test_size_does_not_matter(exponent):
    polygon = polygons.star(40)
    one, other = as_mesh(polygon), as_mesh(polygon * 2.0**exponent)
    hm.triangulate(one)
    hm.triangulate(other)
    assert one.triangles().tolist() == other.triangles().tolist()


def test_quadrilaterals_of_any_size_keep_to_the_good_diagonal():
    for exponent in (-900, -300, 0, 300, 900):
        arrow = as_mesh(np.array(polygons.ARROW) * 2.0**exponent)
        hm.triangulate(arrow)
        assert arrow.triangles().tolist() == [[0, 1, 3], [3, 1, 2]]


# ---------------------------------------------------------------------------------------------- what is not a polygon


@pytest.mark.parametrize("points", [np.zeros((9, 3)), np.arange(27.0).reshape(9, 3), np.full((9, 3), np.nan)])
def test_face_without_area_is_cut_too(points):
    mesh = hm.Mesh([range(9)], points)
    hm.triangulate(mesh)
    hm.testing.assert_valid(mesh)
    assert mesh.n_faces == 7
    assert not joined_twice(mesh)


def test_figure_of_eight_turns_over_no_more_triangles_than_it_must():
    mesh = as_mesh([(0, 0), (2, 2), (2, 0), (0, 2)])
    hm.triangulate(mesh)
    assert sorted(np.sign([float(a) for a in doubled_areas(mesh)])) == [-1, 1]


def test_polygon_that_crosses_itself_a_hundred_times_is_cut():
    mesh = hm.Mesh([range(300)], np.random.default_rng(1).normal(size=(300, 3)))
    hm.triangulate(mesh)
    hm.testing.assert_valid(mesh)
    assert mesh.is_triangular
    assert not joined_twice(mesh)


def test_bent_quadrilateral_is_not_folded():
    """Its shadow is an arrow: only one diagonal leaves both triangles facing up."""
    mesh = hm.Mesh([[0, 1, 2, 3]], [[0, 0, 0], [2, 1, 1], [0, 2, 0], [0.5, 1, 3]])
    up = hm.geometry.face_normals(mesh)[0]
    hm.triangulate(mesh)
    assert (hm.geometry.face_vectors(mesh) @ up > 0).all()


def test_bent_hexagon_has_all_triangles_on_its_own_side():
    angles = np.arange(6) * np.pi / 3
    mesh = hm.Mesh([range(6)], np.c_[np.cos(angles), np.sin(angles), 0.2 * np.cos(3 * angles)])
    up = hm.geometry.face_normals(mesh)[0]
    hm.triangulate(mesh)
    assert (hm.geometry.face_vectors(mesh) @ up > 0).all()


@pytest.mark.parametrize("seed", range(4))
def test_bent_star_has_all_triangles_on_its_own_side(seed):
    """Seen along its normal it doesn't cross itself; seen along an axis it does."""
    heights = np.random.default_rng(seed).normal(size=40)
    mesh = as_mesh(np.c_[polygons.star(40, seed), 0.1 * heights] @ ROTATION.T)
    up = hm.geometry.face_normals(mesh)[0]
    hm.triangulate(mesh)
    assert (hm.geometry.face_vectors(mesh) @ up > 0).all()


# ------------------------------------------------------------------------------------------------------ which diagonals


def test_rectangles_are_cut_at_their_first_corner():
    mesh = hm.shapes.grid(3, 2)
    mesh.points *= [0.1, 0.7, 1]
    hm.triangulate(mesh)
    assert mesh.triangles()[[0, 6]].tolist() == [[0, 1, 5], [0, 5, 4]]


def test_lozenge_is_cut_along_the_short_diagonal():
    lozenge = as_mesh([(0, 0), (1, -3), (2, 0), (1, 3)])
    hm.triangulate(lozenge)
    assert lozenge.find_halfedge(0, 2) is not None


def test_diagonals_are_delaunay_in_a_convex_polygon():
    """No corner in the circle through the corners of any triangle."""
    angles = np.sort(np.random.default_rng(0).uniform(0, 2 * np.pi, 25))
    polygon = np.c_[3 * np.cos(angles), np.sin(angles)]
    mesh = as_mesh(polygon)
    hm.triangulate(mesh)
    lifted = np.c_[polygon, (polygon**2).sum(axis=1)]
    for triangle in mesh.triangles():
        a, b, c = lifted[triangle]
        assert min(np.linalg.det([b - a, c - a, d - a]) for d in lifted) > -1e-12


def test_delaunay_is_measured_in_the_plane_of_the_face():
    """A polygon in a steep plane: its shadow on any coordinate plane would have other diagonals."""
    polygon = polygons.star(30, seed=2)
    flat, steep = as_mesh(polygon), as_mesh(np.c_[polygon, 0 * polygon[:, 0]] @ ROTATION.T)
    hm.triangulate(flat)
    hm.triangulate(steep)
    assert {tuple(sorted(t)) for t in flat.triangles().tolist()} == {
        tuple(sorted(t)) for t in steep.triangles().tolist()
    }


def test_diagonal_that_is_an_edge_elsewhere_is_avoided():
    """Two squares back to back: each is cut along the diagonal that the other is not."""
    pillow = hm.Mesh([[0, 1, 2, 3], [0, 3, 2, 1]], polygons.SQUARE)
    hm.triangulate(pillow)
    assert not joined_twice(pillow)


@pytest.mark.parametrize("n", [5, 6, 17, 200])
def test_coin_is_cut_on_both_sides_without_a_doubled_edge(n):
    coin = hm.Mesh([range(n), range(n)[::-1]], hm.shapes.polygon(n).points)
    hm.triangulate(coin)
    hm.testing.assert_valid(coin)
    assert coin.is_triangular
    assert not joined_twice(coin)
    assert (hm.geometry.face_areas(coin) > 0).all()


# ------------------------------------------------------------------------------------------------------------- refusals


def pillow_of_arrows():
    """Two arrows back to back: the only diagonal inside is the same for both."""
    mesh = hm.Mesh([[4, 5, 6], [0, 1, 2, 3], [0, 3, 2, 1]], [*polygons.ARROW, (5, 0), (6, 0), (5, 1)])
    mesh.face_data.add("mass", float, default=1.0, policy="sum")
    mesh.halfedge_data["corner"] = np.arange(mesh.n_halfedges)
    return mesh


def test_face_whose_only_diagonal_is_taken_is_refused_and_nothing_is_changed():
    mesh = pillow_of_arrows()
    before = state(mesh)
    with pytest.raises(hm.TopologyError, match="face 2: two edges would join") as caught:
        hm.triangulate(mesh)
    assert caught.value.reason == "would_be_parallel"
    assert state(mesh) == before
    hm.testing.assert_valid(mesh)


def test_refusal_of_a_polygon_takes_back_all_that_was_cut_before():
    hexagons = [[0, 1, 2, 3, 4, 5], [5, 4, 6, 7, 8, 9]]
    mesh = hm.Mesh([*hexagons, [10, 10, 11, 11]], twins=[-1] * 4 + [6, -1, 4] + [-1] * 6 + [15, -1, 13])
    mesh.points[:10] = np.random.default_rng(0).normal(size=(10, 3))
    before = state(mesh)
    with pytest.raises(hm.TopologyError, match="face 2"):
        hm.triangulate(mesh)
    assert state(mesh) == before
    hm.testing.assert_valid(mesh)
    mesh.add_vertex()  # and it goes on growing
    hm.testing.assert_valid(mesh)


def test_parallel_edge_is_made_where_it_is_allowed():
    mesh = pillow_of_arrows()
    hm.triangulate(mesh, allow_parallel=True)
    hm.testing.assert_valid(mesh)
    assert joined_twice(mesh) == {(1, 3)}
    assert mesh.face_data["mass"].tolist() == [1.0, 0.5, 0.5, 0.5, 0.5]


def test_torus_of_one_vertex_takes_a_loop():
    torus = hm.testing.zoo()["torus of one vertex"].mesh()
    with pytest.raises(hm.TopologyError) as caught:
        hm.triangulate(torus)
    assert caught.value.reason == "would_be_loop"
    hm.triangulate(torus, allow_parallel=True)
    assert (torus.n_faces, torus.n_edges, torus.genus) == (2, 3, 1)


@pytest.mark.parametrize(
    ("faces", "error"),
    [
        (99, hm.ElementError),
        (-1, hm.ElementError),
        ([0, 99], hm.ElementError),
        (np.array([0, -1]), hm.ElementError),
        (np.array([0, 6]), hm.ElementError),
        ([True], hm.ElementError),
        (np.ones(6, bool), hm.ElementError),
        (0.5, hm.ElementError),
        (["0"], hm.ElementError),
        (hm.shapes.cube().faces[0], hm.ElementError),
        ([hm.shapes.cube().faces[0]], hm.ElementError),
    ],
)
def test_what_is_no_face_is_refused(faces, error):
    mesh = hm.shapes.cube()
    before = state(mesh)
    for function in (hm.triangulate, hm.triangulated):
        with pytest.raises(error):
            function(mesh, faces)
    assert state(mesh) == before


def test_deleted_face_is_refused():
    mesh = hm.shapes.cube()
    mesh.remove_face(2)
    for faces in (2, [0, 2], np.array([0, 2])):
        with pytest.raises(hm.StaleElementError):
            hm.triangulate(mesh, faces)
    assert mesh.n_faces == 5


def test_unknown_quality_is_refused():
    mesh = hm.shapes.cube()
    with pytest.raises(ValueError, match="'delaunay' or 'any'"):
        hm.triangulate(mesh, quality="best")
    assert mesh.n_faces == 6
