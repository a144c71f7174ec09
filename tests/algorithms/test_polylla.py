"""Facts about Polylla meshes (G1): reference values, each defect by hand, what is refused, what is carried over."""

from __future__ import annotations

import json

import numpy as np
import pytest

import halfmesh as hm
from terminal_edges import Twin, certify, cycles, polygons_of, shuffled


def run(mesh):
    polygons, report = hm.polylla(mesh, report=True)
    certify(mesh, polygons, report)
    return polygons, report


# ---------------------------------------------------------------------------------------------------- reference values

SEED_POLYGONS = [[0, 7, 2, 4], [3, 4, 2, 6], [10, 5, 6, 2, 7], [0, 1, 7], [9, 8, 5, 10, 7, 1]]


def test_seed_triangulation_gives_its_five_polygons():
    polygons, report = run(hm.shapes.seed_triangulation())
    assert cycles(polygons_of(polygons)) == cycles(SEED_POLYGONS)
    assert (report.n_frontier_edges, report.n_tips, report.n_repaired, report.n_added) == (15, 0, 0, 0)


def test_seed_polygons_have_the_areas_of_the_reference():
    areas = hm.geometry.face_areas(hm.polylla(hm.shapes.seed_triangulation()))
    assert sorted(areas.round()) == [6357849, 10357682, 11112528, 32703056, 39468886]


@pytest.mark.parametrize("k", [2, 3, 10, 40])
def test_grid_of_k_by_k_points_gives_quads(k):
    polygons, report = run(hm.shapes.grid(k - 1, triangles=True))
    assert report.n_polygons == (k - 1) ** 2
    assert set(polygons.face_degrees()) == {4}
    assert (report.n_frontier_edges, report.n_tips) == (2 * k * (k - 1), 0)


# ------------------------------------------------------------------------------------------------------------- defects
# One region each, found in random Delaunay meshes, the smallest of many: triangles, points, tips, added polygons.

# the barrier edge 4-3 ends inside, at 3
TIP = [[0, 1, 3], [1, 2, 3], [3, 2, 4], [0, 3, 4]], [(10, 7), (7, 20), (0, 0), (4, 6), (5, 4)], 1, 1
# two barrier edges one after the other: 3-5-1
CHAIN = (
    [[1, 0, 4], [4, 2, 5], [3, 1, 5], [1, 4, 5], [2, 3, 5], [0, 1, 6], [1, 3, 6]],
    [(300, 97), (165, 95), (73, 0), (156, 57), (0, 97), (143, 86), (184, 49)],
    1,
    1,
)
# two barrier edges, 5-4 and 6-3
TWO_TIPS = (
    [[0, 1, 3], [2, 0, 3], [3, 1, 4], [4, 1, 5], [3, 4, 6], [2, 3, 6], [6, 4, 7], [4, 5, 7]],
    [(100, 19), (0, 18), (58, 4), (51, 18), (29, 15), (21, 3), (43, 6), (33, 0)],
    2,
    2,
)
# the barrier edges 0-7 and 0-8 meet at 0
TWO_CHAINS_MEET = (
    [[0, 3, 4], [1, 5, 7], [1, 7, 8], [7, 0, 8], [0, 4, 8], [2, 1, 8], [8, 4, 9], [9, 6, 10], [2, 8, 10], [8, 9, 10],
     [0, 7, 11], [7, 5, 11], [3, 0, 11]],
    [(9, 65), (32, 51), (16, 16), (17, 81), (3, 100), (30, 71), (14, 0), (14, 61), (4, 57), (0, 4), (13, 13), (14, 68)],
    2,
    2,
)  # fmt: skip
# around an island that hangs on the barrier edge 0-3; and there is a tip
ISLAND = (
    [[0, 3, 5], [6, 2, 8], [6, 4, 9], [4, 5, 9], [6, 8, 11], [4, 6, 11], [9, 5, 12], [5, 3, 12], [10, 7, 13],
     [7, 1, 14], [12, 3, 14], [3, 7, 14], [0, 11, 15], [11, 8, 15], [3, 0, 15], [7, 3, 15], [13, 7, 15]],
    [(9, 24), (24, 19), (0, 50), (10, 23), (5, 29), (9, 29), (2, 43), (20, 13), (0, 4), (11, 34), (23, 0), (4, 26),
     (18, 30), (8, 1), (24, 22), (2, 4)],
    1,
    1,
)  # fmt: skip
# the region comes round to vertex 18 and touches itself there: no barrier edge at all
TOUCHING = (
    [[6, 3, 9], [8, 0, 12], [0, 2, 12], [1, 11, 13], [4, 1, 13], [6, 7, 14], [3, 6, 14], [6, 9, 15], [9, 10, 15],
     [10, 5, 15], [13, 11, 16], [11, 12, 16], [3, 8, 17], [9, 3, 17], [8, 12, 17], [12, 11, 17], [10, 9, 18],
     [11, 1, 18]],
    [(74, 0), (166, 69), (112, 1), (0, 111), (168, 53), (204, 108), (234, 117), (254, 117), (31, 45), (153, 110),
     (186, 101), (147, 87), (103, 31), (150, 38), (300, 122), (209, 114), (140, 36), (145, 95), (164, 95)],
    0,
    1,
)  # fmt: skip

DEFECTS = {
    "tip": TIP, "chain": CHAIN, "two tips": TWO_TIPS, "two chains meet": TWO_CHAINS_MEET, "island": ISLAND,
    "touching": TOUCHING,
}  # fmt: skip


@pytest.mark.parametrize("name", DEFECTS)
def test_defect_is_repaired(name):
    triangles, points, n_tips, n_added = DEFECTS[name]
    _, report = run(hm.Mesh(triangles, points))
    assert (report.n_tips, report.n_repaired, report.n_added) == (n_tips, 1, n_added)
    assert report.n_polygons == 1 + n_added


@pytest.mark.parametrize("name", DEFECTS)
def test_defect_is_repaired_wherever_the_walk_begins(name):
    """A tip at the target of the first halfedge, too, which the reference never looks at."""
    triangles, points, n_tips, n_added = DEFECTS[name]
    points = np.c_[points, np.zeros(len(points))]
    expected = cycles(polygons_of(run(hm.Mesh(triangles, points))[0]))
    for seed in range(8):
        rows, moved, new = shuffled(triangles, points, seed)
        polygons, report = run(hm.Mesh(rows, moved))
        assert (report.n_tips, report.n_added) == (n_tips, n_added)
        assert cycles(polygons_of(polygons)) == cycles([new[row].tolist() for row in expected])


@pytest.mark.parametrize(
    "mesh",
    [hm.shapes.tetrahedron(), hm.shapes.octahedron(), hm.shapes.icosahedron(), hm.shapes.icosphere(2)]
    + [hm.shapes.torus(n, m, triangles=True) for n, m in ((3, 3), (5, 4), (12, 5))],
    ids=["tetrahedron", "octahedron", "icosahedron", "icosphere", "torus of 18", "torus of 40", "torus of 120"],
)
def test_closed_surface_falls_into_simple_polygons(mesh):
    polygons, _ = run(mesh)
    assert not polygons.has_boundary
    assert polygons.n_faces > 1


def test_sphere_that_is_one_region_falls_into_simple_polygons():
    """One edge is the longest of both its triangles, and all others lead there."""
    points = [(0, 0, 0), (10, 0, 0), (4, 3, 1), (6, 3, -2)]
    _, report = run(hm.Mesh(hm.shapes.tetrahedron().triangles(), points))
    assert report.n_repaired == 1


def test_two_triangles_back_to_back_stay_two():
    _, report = run(hm.Mesh([[0, 1, 2], [0, 2, 1]], np.eye(3)))
    assert (report.n_polygons, report.n_repaired) == (2, 1)


# ---------------------------------------------------------------------------------------------------------------- ties


def test_of_equally_long_edges_the_one_with_the_lower_end_is_the_longest():
    """An isosceles triangle, whose legs its neighbors would join it by."""
    points = [(0, 0), (2, 0), (1, 5), (-1, 3), (9, 5)]
    polygons = hm.polylla(hm.Mesh([[0, 1, 2], [0, 2, 3], [1, 4, 2]], points))
    assert cycles(polygons_of(polygons)) == [[0, 1, 2, 3], [1, 4, 2]]


def test_points_in_the_same_place_are_told_apart_by_their_numbers():
    _, report = run(hm.Mesh(hm.shapes.octahedron().triangles(), np.zeros((6, 3))))
    assert report.n_polygons >= 2


# ------------------------------------------------------------------------------------------------------------- refused


def test_face_that_is_no_triangle_is_named_with_the_remedy():
    mesh = hm.Mesh([[0, 1, 2], [1, 3, 4, 2]], np.eye(5, 3))
    with pytest.raises(hm.PreconditionError, match=r"face 1 is not a triangle; hm\.triangulated"):
        hm.polylla(mesh)


def test_mesh_without_points_is_refused():
    with pytest.raises(hm.PreconditionError, match="no points"):
        hm.polylla(hm.Mesh([[0, 1, 2]]))


@pytest.mark.parametrize("x", [np.nan, np.inf, -np.inf, 1e200])
def test_points_that_are_not_finite_or_too_far_are_refused(x):
    with pytest.raises(hm.PreconditionError, match="face 0 has a side of no finite length"):
        hm.polylla(hm.Mesh([[0, 1, 2]], [(0, 0, 0), (1, 0, 0), (0, x, 0)]))


def test_triangle_that_passes_a_vertex_twice_is_refused():
    mesh = hm.testing.zoo()["torus of two triangles"].mesh()
    mesh.points = [(0, 0, 0)]
    with pytest.raises(hm.PreconditionError, match="face 0 passes a vertex twice"):
        hm.polylla(mesh)


# --------------------------------------------------------------------------------------------------------- what is kept


def test_input_stays_as_it_is():
    mesh = hm.shapes.seed_triangulation()
    before = mesh.triangles().tolist(), mesh.points.tolist(), mesh.revision
    hm.polylla(mesh).points[0] = 7
    assert (mesh.triangles().tolist(), mesh.points.tolist(), mesh.revision) == before


def test_points_and_vertex_data_are_carried_over_with_their_policies():
    mesh = hm.shapes.seed_triangulation()
    mesh.vertex_data.add("weight", float, default=2.0, policy="sum")[3] = 5
    mesh.meta["name"] = "seed"
    polygons = hm.polylla(mesh)
    assert np.array_equal(polygons.points, mesh.points)
    assert polygons.vertex_data["weight"].tolist() == mesh.vertex_data["weight"].tolist()
    assert polygons.vertex_data.policies["weight"] == "sum"
    assert (polygons.meta, polygons.has_points) == ({"name": "seed"}, True)


def test_edges_and_halfedges_that_remain_keep_their_data():
    triangles, points, _, _ = ISLAND
    mesh = hm.Mesh(triangles, points)
    mesh.edge_data["ends"] = np.sort(mesh.edge_vertices(), axis=1)
    mesh.halfedge_data["ends"] = [(h.origin.index, h.target.index) for h in mesh.halfedges]
    polygons = hm.polylla(mesh)
    assert np.array_equal(polygons.edge_data["ends"], np.sort(polygons.edge_vertices(), axis=1))
    assert polygons.halfedge_data["ends"].tolist() == [[h.origin.index, h.target.index] for h in polygons.halfedges]


def test_face_data_are_gathered_by_the_polygon_of_every_triangle():
    mesh = hm.shapes.seed_triangulation()
    polygons, report = hm.polylla(mesh, report=True)
    sums = np.bincount(report.triangle_polygon, hm.geometry.face_areas(mesh))
    assert np.allclose(sums, hm.geometry.face_areas(polygons))
    assert not polygons.face_data


def test_wire_and_isolated_vertices_are_kept():
    mesh = hm.Mesh(
        [[0, 1, 2], [0, 2, 3]], [(0, 0), (1, 0), (1, 1), (0, 1), (2, 2), (3, 2), (9, 9)], edges=[(2, 4), (4, 5)]
    )
    mesh.edge_data["number"] = np.arange(mesh.n_edges)
    polygons, report = run(mesh)
    assert (polygons.n_edges, polygons.n_isolated_vertices, report.n_frontier_edges) == (6, 1, 4)
    numbers = polygons.edge_data["number"].tolist()
    assert (sorted(numbers[:4]), numbers[4:]) == ([0, 1, 3, 4], [5, 6])  # without the diagonal, wire last
    assert polygons.find_halfedge(2, 4).next == polygons.find_halfedge(4, 5)


def test_deleted_elements_are_left_out():
    mesh = hm.shapes.grid(4, triangles=True)
    mesh.remove_face(3)
    mesh.remove_vertex(12)
    living = mesh.copy()
    living.compact()
    polygons, report = hm.polylla(mesh, report=True)
    assert polygons_of(polygons) == polygons_of(hm.polylla(living))
    assert np.array_equal(report.triangle_polygon < 0, mesh.topology.face_halfedge < 0)
    assert report.n_triangles == mesh.n_faces
    assert mesh.n_faces < len(report.triangle_polygon)


@pytest.mark.parametrize("name", ["nothing", "isolated vertices"])
def test_no_triangles_give_no_polygons(name):
    mesh = hm.testing.zoo()[name].mesh()
    mesh.points = np.zeros((mesh.n_vertices, 3))
    polygons, report = hm.polylla(mesh, report=True)
    hm.testing.assert_valid(polygons)
    assert (polygons.n_vertices, report.n_polygons, report.n_frontier_edges) == (mesh.n_vertices, 0, 0)


def test_wire_alone_is_kept():
    mesh = hm.testing.zoo()["path"].mesh()
    assert hm.polylla(mesh).edge_vertices().tolist() == mesh.edge_vertices().tolist()


def test_several_fans_at_a_vertex_keep_their_order():
    mesh = hm.testing.zoo()["propeller"].mesh()
    mesh.points = np.random.default_rng(0).random((mesh.n_vertices, 3))
    polygons, _ = run(mesh)
    assert cycles(polygons_of(polygons)) == cycles(polygons_of(mesh))


# ---------------------------------------------------------------------------------------------------------- the columns


@pytest.mark.parametrize("name", DEFECTS)
def test_result_is_the_mesh_of_its_face_list_in_all_columns(name):
    polygons = hm.polylla(hm.Mesh(*DEFECTS[name][:2]))
    built = hm.Mesh(polygons.face_vertices(), polygons.points)
    for column in ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge"):
        assert np.array_equal(getattr(polygons.topology, column), getattr(built.topology, column)), column


def test_polygons_are_in_the_order_of_their_terminal_edges_and_added_ones_behind():
    triangles, points, _, n_added = TWO_CHAINS_MEET
    both = hm.Mesh([[12, 13, 14], *triangles], [*points, (500, 0), (600, 0), (500, 50)])
    _, report = run(both)
    assert report.triangle_polygon[0] == 0
    assert set(report.triangle_polygon[1:]) == {1, 2, 3}
    assert report.n_polygons - n_added == 2


def test_result_can_be_changed_on():
    polygons = hm.polylla(hm.shapes.seed_triangulation())
    polygons.split_edge(0)
    polygons.split_face(polygons.faces[2])
    hm.testing.assert_valid(polygons)


@pytest.mark.parametrize("n", [1, 2, 3, 8, 20])
def test_number_of_threads_makes_no_difference(n, monkeypatch):
    """Stretches of a few elements, so that a small mesh is cut into as many as there are threads."""
    mesh = hm.Mesh(*_many_defects())
    alone, report = hm.polylla(mesh, report=True)
    for module in ("halfmesh.geometry._passes", "halfmesh.core.matching"):
        monkeypatch.setattr(f"{module}._PART", 5)
    monkeypatch.setenv("HALFMESH_NUM_THREADS", str(n))
    polygons, again = hm.polylla(mesh, report=True)
    certify(mesh, polygons, again)
    assert polygons_of(polygons) == polygons_of(alone)
    assert np.array_equal(report.triangle_polygon, again.triangle_polygon)


def test_mesh_so_large_that_corners_can_hardly_be_numbered_is_cut_into_fewer_stretches(monkeypatch):
    mesh = hm.Mesh(*_many_defects())
    expected = polygons_of(hm.polylla(mesh))
    for module in ("halfmesh.geometry._passes", "halfmesh.core.matching"):
        monkeypatch.setattr(f"{module}._PART", 5)
    monkeypatch.setenv("HALFMESH_NUM_THREADS", "8")
    monkeypatch.setattr("halfmesh.algorithms._polylla_travel.LIMIT", 6 * mesh.n_faces)
    assert polygons_of(hm.polylla(mesh)) == expected
    monkeypatch.setattr("halfmesh.algorithms._polylla_travel.LIMIT", 2 * mesh.n_faces)
    with pytest.raises(hm.PreconditionError, match="more corners than int32"):
        hm.polylla(mesh)


def _many_defects():
    """All of them beside each other."""
    triangles, points = [], []
    for i, (rows, xy, _, _) in enumerate(DEFECTS.values()):
        triangles += [[v + len(points) for v in row] for row in rows]
        points += [(x + 1000 * i, y) for x, y in xy]
    return triangles, points


# ----------------------------------------------------------------------------------------------------------- the report


def test_report_counts_as_the_twin_does():
    triangles, points = _many_defects()
    report = run(hm.Mesh(triangles, points))[1]
    twin = Twin(triangles, np.c_[points, np.zeros(len(points))])
    assert (report.n_tips, report.n_repaired, report.n_added) == (twin.n_tips, twin.n_repaired, twin.n_added)


def test_report_goes_into_json_and_prints_as_a_table():
    _, report = hm.polylla(hm.shapes.seed_triangulation(), report=True)
    known = json.loads(json.dumps(report.as_dict()))
    assert (known["n_polygons"], known["n_frontier_edges"]) == (5, 15)
    assert known["total_seconds"] == pytest.approx(sum(known["seconds"].values()))
    assert "frontier edges" in str(report)
    assert len({len(line) for line in str(report).splitlines()}) == 1
    assert repr(report).startswith("<PolyllaReport: 12 triangles, 5 polygons")


def test_progress_is_told_at_the_end_of_each_phase():
    told = []
    _, report = hm.polylla(hm.shapes.grid(3, triangles=True), report=True, progress=lambda *x: told.append(x))
    assert [phase for phase, _ in told] == list(report.seconds)
    fractions = [fraction for _, fraction in told]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1
