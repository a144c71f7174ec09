"""The mesh as a whole: counts, arrays, copies, what it says of itself (C1-C4, D10, O12, O13, Q6, Q7)."""

from __future__ import annotations

import copy
import itertools
import json
import pickle
from fractions import Fraction

import numpy as np
import pytest

import halfmesh as hm
from reference import Reference

ZOO = hm.testing.zoo()
every_mesh = pytest.mark.parametrize("specimen", ZOO.values(), ids=ZOO)


def pair(specimen):
    return specimen.mesh(), Reference(specimen.faces, specimen.figures.n_vertices, specimen.twins, specimen.edges)


def rows(ragged):
    indices, offsets = ragged
    return [indices[a:b].tolist() for a, b in itertools.pairwise(offsets)]


# -------------------------------------------------------------------------------------------------------------- counts


@every_mesh
def test_counts_are_those_of_the_slow_twin(specimen):
    """C1, C2, I8."""
    mesh, twin = pair(specimen)
    gaps = [v for v in range(twin.n_vertices) if twin.touches_gap(v)]
    isolated = [v for v in range(twin.n_vertices) if not twin.ring[v]]
    exterior = sum(f == -1 for f in twin.face_of)
    assert (mesh.n_boundary_vertices, mesh.n_isolated_vertices) == (len(gaps), len(isolated))
    assert mesh.n_interior_vertices == twin.n_vertices - len(gaps) - len(isolated)
    assert (mesh.n_halfedges, mesh.n_exterior_halfedges) == (twin.n_darts, exterior)
    assert mesh.n_interior_halfedges == sum(map(len, twin.faces)) == twin.n_darts - exterior
    assert mesh.euler_characteristic == twin.n_vertices - twin.n_darts // 2 + len(twin.faces)
    assert mesh.has_boundary == (exterior > 0)
    assert mesh.is_triangular == all(len(face) == 3 for face in twin.faces)


@every_mesh
def test_boundary_loops_are_those_of_the_slow_twin(specimen):
    """C4, I5."""
    mesh, twin = pair(specimen)
    assert [loop.tolist() for loop in mesh.boundary_loops()] == twin.boundary_loops()
    assert mesh.n_boundary_loops == len(twin.boundary_loops())


@every_mesh
def test_each_component_has_its_own_figures(specimen):
    """C2, C3: genus and Euler characteristic per component, not only summed."""
    mesh, twin = pair(specimen)
    parts = twin.components()
    found = mesh.components()
    assert len(found) == len(parts) == mesh.n_connected_components
    for i, part in enumerate(parts):
        loops = sum(twin.origin[loop[0]] in part for loop in twin.boundary_loops())
        edges = sum(u in part for u in twin.origin) // 2
        faces = sum(face[0] in part for face in twin.faces)
        assert set(np.flatnonzero(found.vertex_component == i).tolist()) == part
        figures = [found.n_vertices[i], found.n_edges[i], found.n_faces[i], found.n_boundary_loops[i], found.genus[i]]
        assert figures == [len(part), edges, faces, loops, twin.genus(part)]
        assert found.euler_characteristic[i] == len(part) - edges + faces
    assert mesh.genus == sum(map(twin.genus, parts))


def test_constant_time_counts_do_not_walk(monkeypatch):
    """C2: has_boundary and the Euler characteristic come from what is kept."""
    mesh = ZOO["torus with two holes"].mesh()
    for name in ("boundary_loops", "components", "vertex_kinds"):
        monkeypatch.setattr(hm.mesh.counts.counting, name, None)
    assert (mesh.has_boundary, mesh.euler_characteristic, mesh.n_halfedges, mesh.n_exterior_halfedges) == (
        True,
        -2,
        48,
        8,
    )


def test_walked_counts_are_kept_until_the_connectivity_changes(monkeypatch):
    """C3."""
    mesh = ZOO["torus with two holes"].mesh()
    walks = []
    count = hm.mesh.counts.counting.components
    monkeypatch.setattr(hm.mesh.counts.counting, "components", lambda t: walks.append(1) or count(t))
    mesh.points[:] = 1.0
    assert (mesh.genus, mesh.n_connected_components, mesh.genus) == (1, 1, 1)
    assert len(walks) == 1
    mesh.topology.__arrays__().counts[hm.core.topology.REVISION] += 1
    assert (mesh.genus, len(walks)) == (1, 2)


# -------------------------------------------------------------------------------------------------------------- arrays


@every_mesh
def test_tables_are_those_of_the_slow_twin(specimen):
    """Q1, Q7, in bulk: counter-clockwise, as the handles say."""
    mesh, twin = pair(specimen)
    vertices, faces = range(twin.n_vertices), range(len(twin.faces))
    assert rows(mesh.face_vertices()) == twin.faces
    assert rows(mesh.vertex_neighbors()) == [twin.neighbors(v) for v in vertices]
    assert rows(mesh.vertex_faces()) == [twin.faces_around(v) for v in vertices]
    assert rows(mesh.face_neighbors()) == [twin.face_neighbors(f) for f in faces]
    assert mesh.corner_halfedges().tolist() == [h for loop in twin.loop for h in loop]
    assert mesh.edge_vertices().tolist() == [twin.origin[h : h + 2] for h in range(0, twin.n_darts, 2)]
    assert mesh.edge_faces().tolist() == [twin.face_of[h : h + 2] for h in range(0, twin.n_darts, 2)]
    assert mesh.vertex_degrees().tolist() == [len(ring) for ring in twin.ring]
    assert mesh.face_degrees().tolist() == [len(face) for face in twin.faces]


@every_mesh
def test_triangles_are_given_or_the_face_that_is_none_is_named(specimen):
    """I10."""
    mesh = specimen.mesh()
    wrong = [f for f, face in enumerate(specimen.faces) if len(face) != 3]
    if wrong:
        with pytest.raises(hm.PreconditionError, match=f"face {wrong[0]} has {len(specimen.faces[wrong[0]])} corners"):
            mesh.triangles()
    else:
        assert mesh.triangles().shape == (mesh.n_faces, 3)
        assert mesh.triangles().tolist() == specimen.faces


def test_shapes_and_dtypes_of_tables_of_nothing():
    mesh = hm.Mesh([])
    assert mesh.triangles().shape == (0, 3)
    assert mesh.edge_vertices().shape == mesh.edge_faces().shape == (0, 2)
    assert mesh.points.shape == (0, 3)
    assert mesh.face_vertices()[1].tolist() == [0]
    assert mesh.boundary_loops() == []
    assert (mesh.genus, mesh.has_boundary, mesh.is_triangular) == (0, False, True)


def test_the_columns_are_read_only_views_without_a_copy():
    t = ZOO["cube"].mesh().topology
    for name in ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge"):
        column = getattr(t, name)
        assert np.shares_memory(column, getattr(t, name))
        with pytest.raises(ValueError, match="read-only"):
            column[0] = 0


def test_boundary_loops_can_be_changed_without_harm():
    mesh = ZOO["annulus"].mesh()
    mesh.boundary_loops()[0][:] = 0
    assert [loop.tolist() for loop in mesh.boundary_loops()] == pair(ZOO["annulus"])[1].boundary_loops()


# ---------------------------------------------------------------------------------------------------------- the points


def test_writing_into_points_moves_vertices_and_is_no_revision():
    mesh = ZOO["cube"].mesh()
    before = mesh.revision
    mesh.points[0] = (7, 8, 9)
    assert mesh.vertices[0].point.tolist() == [7, 8, 9]
    assert mesh.revision == before


def test_points_can_be_replaced_by_points_alone():
    mesh = ZOO["quads"].mesh()
    mesh.points = np.ones((12, 2))
    assert mesh.points.tolist() == [[1, 1, 0]] * 12
    for wrong in (np.ones((11, 3)), np.ones((12, 4)), "points", np.ones(36)):
        with pytest.raises(ValueError, match="points"):
            mesh.points = wrong
    assert mesh.points.tolist() == [[1, 1, 0]] * 12


def test_without_points_there_are_zeros():
    mesh = hm.Mesh([[0, 1, 2]])
    assert (mesh.has_points, mesh.points.tolist()) == (False, [[0, 0, 0]] * 3)
    mesh.points = np.ones((3, 3))
    assert mesh.has_points


# -------------------------------------------------------------------------------------------------------------- copies

COPIES = {
    "copy": hm.Mesh.copy,
    "copy.copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{f"pickle {p}": lambda mesh, p=p: pickle.loads(pickle.dumps(mesh, p)) for p in (2, 4, 5)},
}


@pytest.mark.parametrize("again", COPIES.values(), ids=COPIES)
@every_mesh
def test_copy_is_equal_and_independent(specimen, again):
    """O13."""
    mesh = specimen.mesh()
    mesh.face_data.add("color", np.uint8, (3,), default=7)
    mesh.vertex_data.add("weight", default=2.5)
    made = again(mesh)
    hm.testing.assert_valid(made)
    for name in ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge"):
        one, other = getattr(mesh.topology, name), getattr(made.topology, name)
        assert np.array_equal(one, other)
        assert not np.shares_memory(one, other)
    assert made.has_points == mesh.has_points
    assert made.points.tolist() == mesh.points.tolist()
    assert made.face_data["color"].tolist() == mesh.face_data["color"].tolist()
    assert made.vertex_data.column("weight").default == 2.5
    made.points[:] = 9.0
    made.face_data["color"][:] = 0
    del made.vertex_data["weight"]
    assert "weight" in mesh.vertex_data
    assert (mesh.face_data["color"] == 7).all()
    assert not (mesh.points == 9.0).any()


def test_copy_can_be_used_in_kernels_like_the_original():
    @hm.kernel
    def total(t, out):
        for v in range(hm.vertex_slots(t)):
            for h in hm.outgoing(t, v):
                out[0] += h

    mesh = ZOO["cube"].mesh()
    for made in (mesh, mesh.copy(), pickle.loads(pickle.dumps(mesh))):
        out = np.zeros(1, dtype=np.int64)
        total(made, out)
        assert out[0] == 24 * 23 // 2


# ------------------------------------------------------------------------------------------ what it says of itself


def test_repr_is_one_line_that_says_what_it_is():
    assert repr(ZOO["cube"].mesh()) == "<Mesh: 8 vertices, 12 edges, 6 faces, closed>"
    assert repr(ZOO["triangle"].mesh()) == "<Mesh: 3 vertices, 3 edges, 1 face, with boundary>"


@every_mesh
def test_summary_has_all_figures_as_text_numbers_and_html(specimen):
    """O12 verbose, D10: the counters kept, and the time that building took."""
    mesh = specimen.mesh()
    summary = mesh.summary()
    numbers = json.loads(json.dumps(summary.as_dict()))
    assert numbers["vertices"] == mesh.n_vertices
    assert numbers["boundary_loops"] == mesh.n_boundary_loops
    assert sum(numbers["face_degrees"].values()) == mesh.n_faces
    assert numbers["topology_bytes"] == 16 * mesh.n_halfedges + 4 * mesh.n_vertices + 4 * mesh.n_faces
    assert 0 < numbers["build_seconds"] < 60
    assert f"{mesh.n_edges}" in str(summary)
    assert mesh._repr_html_().startswith("<table>")


def test_mean_degree_is_twice_the_edges_over_the_vertices():
    summary = ZOO["quads"].mesh().summary()
    assert Fraction(summary.vertex_degree_mean).limit_denominator(100) == Fraction(2 * 17, 12)
    assert (summary.vertex_degree_min, summary.vertex_degree_max) == (2, 4)


def test_building_time_is_kept():
    """D10."""
    assert 0 < ZOO["cube"].mesh().build_seconds < 60


def test_meta_is_copied_and_pickled(tmp_path):
    path = tmp_path / "group.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\ng left\nf 1 2 3\n")
    mesh = hm.load(path)
    names = list(mesh.meta["groups"])
    assert names == ["left"]
    copied = mesh.copy()
    copied.meta["groups"].append("right")
    assert list(mesh.meta["groups"]) == names == list(pickle.loads(pickle.dumps(mesh)).meta["groups"])


def test_names_of_groups_survive_load_and_save(tmp_path):
    path = tmp_path / "group.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\ng left\nusemtl red\nf 1 2 3\n")
    hm.save(hm.load(path), tmp_path / "again.obj")
    again = hm.load(tmp_path / "again.obj")
    assert (list(again.meta["groups"]), list(again.meta["materials"])) == (["left"], ["red"])
