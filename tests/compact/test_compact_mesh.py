"""M4: the compact half-edge as a mesh: the same words, points permuted, handles, maps, files."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import halfmesh as hm
from alike import alike
from bound import assert_same_words
from halfmesh.errors import FormatError, PreconditionError

ZOO = hm.testing.zoo()
HELD = [name for name, specimen in ZOO.items() if not specimen.mesh().components().genus.any()]
REFUSED = [name for name in ZOO if name not in HELD]
QUESTIONS = (
    "n_vertices", "n_edges", "n_faces", "n_boundary_loops", "n_connected_components", "genus", "n_isolated_vertices",
    "n_boundary_vertices", "n_exterior_halfedges", "euler_characteristic", "has_boundary", "is_triangular",
)  # fmt: skip


def kinds(maps):
    return {"v": maps.vertices, "h": maps.halfedges, "e": maps.edges, "f": maps.faces}


@pytest.mark.parametrize("name", HELD)
def test_says_what_the_mesh_says(name):
    mesh = ZOO[name].mesh()
    small = hm.CompactMesh(mesh, maps=True)
    assert_same_words(mesh, small, kinds(small.maps))
    assert [getattr(small, q) for q in QUESTIONS] == [getattr(mesh, q) for q in QUESTIONS]


@pytest.mark.parametrize("name", HELD)
def test_goes_back_to_the_same_mesh_but_for_numbers(name):
    mesh = ZOO[name].mesh()
    small = hm.CompactMesh(mesh, maps=True)
    again = small.to_mesh()
    again.check()
    assert alike(again, mesh)
    assert np.array_equal(again.points[small.maps.vertices], mesh.points)
    assert again.has_points == mesh.has_points


@pytest.mark.parametrize("name", REFUSED)
def test_refuses_what_has_handles(name):
    with pytest.raises(PreconditionError, match="genus"):
        hm.CompactMesh(ZOO[name].mesh())


def test_bulk_answers_go_with_the_maps():
    mesh = hm.shapes.icosphere(2)
    small = hm.CompactMesh(mesh, maps=True)
    maps = small.maps
    assert np.array_equal(small.vertex_degrees()[maps.vertices], mesh.vertex_degrees())
    assert np.array_equal(np.sort(small.edge_vertices()[maps.edges]), np.sort(maps.vertices[mesh.edge_vertices()]))
    assert {frozenset(t) for t in small.triangles()} == {frozenset(t) for t in maps.vertices[mesh.triangles()]}
    for table in (small.vertex_neighbors(), small.vertex_faces(), small.face_neighbors(), small.face_vertices()):
        assert table[1][-1] == len(table[0])
    assert np.allclose(hm.geometry.face_areas(small)[maps.faces], hm.geometry.face_areas(mesh))


def test_handles_walk_it():
    mesh = hm.shapes.grid(3, 3)
    small = hm.CompactMesh(mesh)
    for h in small.halfedges:
        assert h.twin.twin == h
        assert h.next.prev == h == h.ccw.cw
        assert h.target == h.twin.origin
        assert h.edge == h.twin.edge
        assert h.edge.halfedge in (h, h.twin)
        assert h.is_exterior == (h.face is None)
    assert sorted(v.degree for v in small.vertices) == sorted(v.degree for v in mesh.vertices)
    assert sum(f.degree for f in small.faces) == small.n_interior_halfedges
    assert small.find_halfedge(0, next(small.vertices[0].neighbors())) is not None
    assert [len(loop) for loop in small.boundary_loops()] == [12]


@pytest.mark.large
def test_handles_give_the_same_compiled():
    """A large mesh is asked by compiled code, from its second word on."""
    small = hm.CompactMesh(hm.shapes.icosphere(4))
    h = small.halfedges[11]
    first = [h.next.index, h.twin.index, h.origin.index, h.face.index, h.edge.index]
    assert first == [h.next.index, h.twin.index, h.origin.index, h.face.index, h.edge.index]
    assert h.next.next.next == h


@hm.kernel
def count_by_ring(t, out):
    for v in range(len(out)):
        for _ in hm.outgoing(t, v):
            out[v] += 1


def test_the_users_kernels_run_on_it_unchanged():
    small = hm.CompactMesh(hm.shapes.icosphere(1))
    for run in (count_by_ring, count_by_ring.interpreted):
        out = np.zeros(small.n_vertices, int)
        run(small, out)
        assert out.tolist() == [v.degree for v in small.vertices]


@pytest.mark.parametrize("twice", [copy.deepcopy, lambda mesh: pickle.loads(pickle.dumps(mesh))])
def test_can_be_copied_and_pickled(twice):
    small = hm.CompactMesh(hm.shapes.icosphere(1), maps=True)
    again = twice(small)
    assert np.array_equal(again.topology.next, small.topology.next)
    assert np.array_equal(again.points, small.points)
    assert np.array_equal(again.maps.edges, small.maps.edges)


@pytest.mark.parametrize("name", ["tetrahedron", "bow tie", "isolated vertices"])
def test_comes_back_from_a_file(tmp_path, name):
    mesh = ZOO[name].mesh() if name in ZOO else hm.Mesh([], n_vertices=3)
    small = hm.CompactMesh(mesh)
    small.save(tmp_path / "mesh.hmc")
    again = hm.CompactMesh.load(tmp_path / "mesh.hmc")
    assert np.array_equal(again.topology.next, small.topology.next)
    assert np.array_equal(again.points, small.points)
    assert again.has_points == mesh.has_points


def test_points_of_a_mapped_file_can_move_but_not_in_the_file(tmp_path):
    hm.CompactMesh(hm.shapes.cube()).save(tmp_path / "cube.hmc")
    mesh = hm.CompactMesh.load(tmp_path / "cube.hmc")
    mesh.points[:] = 7.0
    assert mesh.points.max() == 7.0
    assert hm.CompactMesh.load(tmp_path / "cube.hmc").points.max() == 1.0


def test_a_file_of_something_else_is_refused(tmp_path):
    (tmp_path / "mesh.hmc").write_bytes(b"OFF\n0 0 0\n" * 40)
    with pytest.raises(FormatError, match=r"mesh\.hmc"):
        hm.CompactMesh.load(tmp_path / "mesh.hmc")


def test_nothing_can_be_changed():
    small = hm.CompactMesh(hm.shapes.cube())
    for verb in ("flip", "split_edge", "remove_face", "add_vertex", "collapse"):
        assert not hasattr(small, verb)
    with pytest.raises(ValueError, match="read-only"):
        small.topology.__arrays__().bits[0] = 1


@pytest.mark.large
def test_takes_less_than_five_bits_an_edge():
    mesh = hm.shapes.icosphere(6)
    small = hm.CompactMesh(mesh)
    assert small.bits_per_edge < 5.0
    assert small.nbytes == small.topology_nbytes + mesh.points.nbytes
    assert mesh.topology.nbytes > 55 * small.topology_nbytes
