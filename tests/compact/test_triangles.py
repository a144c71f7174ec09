"""I7: triangles as origin and twin, 26 bytes each, in the same words as a mesh."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import halfmesh as hm
from bound import assert_same_words
from halfmesh.errors import PreconditionError

ZOO = hm.testing.zoo()
HELD = [name for name, s in ZOO.items() if s.mesh().is_triangular and not s.edges and s.faces]


def maps_of(mesh):
    """Where the elements of a mesh are in its triangle layout."""
    h = np.full(mesh.n_halfedges, -1)
    order = [*mesh.corner_halfedges(), *np.flatnonzero(mesh.topology.face < 0)]
    h[order] = np.arange(len(order))
    first = np.minimum(h[::2], h[1::2])
    e = np.empty(mesh.n_edges, int)
    e[np.argsort(first)] = np.arange(mesh.n_edges)
    return {"h": h, "e": e, "v": np.arange(mesh.n_vertices), "f": np.arange(mesh.n_faces)}


@pytest.mark.parametrize("name", HELD)
def test_says_what_the_mesh_says(name):
    mesh = ZOO[name].mesh()
    assert_same_words(mesh, hm.TriangleMesh(mesh), maps_of(mesh))


@pytest.mark.parametrize("name", HELD)
def test_goes_back_to_the_same_mesh(name):
    mesh = ZOO[name].mesh()
    again = hm.TriangleMesh(mesh).to_mesh()
    again.check()
    assert again.face_vertices()[0].tolist() == mesh.face_vertices()[0].tolist()
    assert again.summary().as_dict() | {"build_seconds": 0} == mesh.summary().as_dict() | {"build_seconds": 0}
    for column in ("next", "origin", "face", "vertex_halfedge", "face_halfedge"):
        assert getattr(again.topology, column).tolist() == getattr(mesh.topology, column).tolist(), column


def test_edges_keep_their_numbers_over_many_blocks():
    mesh = hm.shapes.icosphere(3)
    small = hm.TriangleMesh(mesh)
    assert np.array_equal(small.edge_vertices(), mesh.edge_vertices())
    assert [small.edges[e].halfedge.edge.index for e in range(small.n_edges)] == list(range(small.n_edges))


@pytest.mark.parametrize("level", [2, 4])
def test_takes_26_bytes_a_triangle(level):
    """Performance page: memory of the triangle-only read-only variant."""
    mesh = hm.shapes.icosphere(level)
    small = hm.TriangleMesh(mesh)
    assert small.topology_nbytes - 13 * 8 - 8 < 26.3 * mesh.n_faces + 64  # the 13 counts, two empty columns
    assert small.nbytes == small.topology_nbytes + mesh.points.nbytes


def test_answers_every_question_of_a_mesh():
    split = hm.triangulated(hm.shapes.grid(4, 3))
    mesh = hm.Mesh(split.triangles(), split.points)  # edges in the order of the face list
    small = hm.TriangleMesh(mesh)
    for question in ("n_interior_vertices", "n_boundary_loops", "genus", "n_connected_components", "has_boundary"):
        assert getattr(small, question) == getattr(mesh, question), question
    for table in ("vertex_degrees", "face_degrees", "triangles", "edge_vertices", "edge_faces"):
        assert np.array_equal(getattr(small, table)(), getattr(mesh, table)()), table
    for table in ("vertex_neighbors", "vertex_faces", "face_neighbors", "face_vertices"):
        assert all(map(np.array_equal, getattr(small, table)(), getattr(mesh, table)())), table
    assert [len(loop) for loop in small.boundary_loops()] == [len(loop) for loop in mesh.boundary_loops()]
    assert hm.geometry.area(small) == hm.geometry.area(mesh)
    assert np.array_equal(hm.geometry.edge_lengths(small), hm.geometry.edge_lengths(mesh))


def test_handles_walk_it():
    mesh = hm.shapes.icosphere(1)
    small = hm.TriangleMesh(mesh)
    h = small.find_halfedge(0, next(mesh.vertices[0].neighbors()).index)
    assert h.twin.twin == h
    assert h.next.next.next == h
    assert h.prev.next == h
    assert h.ccw.cw == h
    assert h.origin.index == 0
    assert h.edge.halfedge in (h, h.twin)
    assert {f.index for f in h.origin.faces()} == {f.index for f in mesh.vertices[0].faces()}
    assert h.face.degree == 3
    assert h.is_alive
    assert not h.is_boundary
    assert h.mesh is small
    assert h.length == mesh.find_halfedge(0, h.target.index).length
    assert isinstance(h, hm.Halfedge)
    assert hm.Vertex(small, 3) == small.vertices[3]
    assert small.vertices[0] in small.vertices
    assert mesh.vertices[0] not in small.vertices


def test_isolated_vertices_are_kept():
    small = hm.TriangleMesh(hm.Mesh([[0, 1, 3]], n_vertices=6))
    assert (small.n_vertices, small.n_isolated_vertices) == (6, 3)
    assert small.vertices[2].halfedge is None
    assert small.vertices[5].is_isolated


@pytest.mark.parametrize(
    ("mesh", "said"),
    [
        (hm.Mesh([[0, 1, 2, 3]]), "face 0 has 4 corners"),
        (hm.Mesh([[0, 1, 2]], edges=[[2, 3]], n_vertices=4), "edge 3"),
    ],
)
def test_refuses_what_is_no_triangle(mesh, said):
    with pytest.raises(PreconditionError, match=said):
        hm.TriangleMesh(mesh)


def test_deleted_elements_stay_behind():
    mesh = hm.shapes.icosphere(1)
    mesh.remove_face(5)
    small = hm.TriangleMesh(mesh)
    assert (small.n_faces, small.n_boundary_loops, mesh.topology.face_halfedge[5]) == (79, 1, -4)
    small.to_mesh().check()


@pytest.mark.parametrize("twice", [copy.deepcopy, lambda mesh: pickle.loads(pickle.dumps(mesh))])
def test_can_be_copied_and_pickled(twice):
    small = hm.TriangleMesh(hm.shapes.icosphere(1))
    again = twice(small)
    assert np.array_equal(again.triangles(), small.triangles())
    assert np.array_equal(again.points, small.points)


def test_no_triangles_at_all():
    small = hm.TriangleMesh(hm.Mesh([], n_vertices=2))
    assert (small.n_vertices, small.n_edges, small.n_faces) == (2, 0, 0)
    assert small.to_mesh().n_isolated_vertices == 2
