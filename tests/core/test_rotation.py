"""The twin that changes is itself tested: it starts as the other twin says, it can fail, and it does simple things."""

from __future__ import annotations

import pytest

import halfmesh as hm
import rotation.table
from halfmesh.core.statuses import REASONS
from halfmesh.testing import zoo
from reference import Reference
from rotation import Rotation, Walk
from soups import SOUND


@pytest.fixture
def square():
    return hm.Mesh([[0, 1, 2], [0, 2, 3]], n_vertices=5)


@pytest.mark.parametrize("specimen", SOUND, ids=lambda specimen: specimen.name)
def test_starts_as_the_twin_of_face_lists(specimen):
    twin = Rotation(specimen.mesh())
    other = Reference(specimen.faces, specimen.figures.n_vertices)
    columns = other.columns()
    assert twin.columns() == {name: columns[name] for name in ("next", "prev", "origin", "face")}
    assert twin.boundary_loops() == len(other.boundary_loops())
    assert twin.n_components() == len(other.components())


@pytest.mark.parametrize("name", ["next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge"])
def test_one_wrong_number_is_noticed(square, name):
    twin = Rotation(square)
    twin.assert_same(square)
    column = getattr(square.topology.__arrays__(), name)
    for place in range(len(getattr(square.topology, name))):
        old = column[place]
        column[place] = -1 if old != -1 else 0
        with pytest.raises(AssertionError):
            twin.assert_same(square)
        column[place] = old


def test_an_element_too_many_or_too_few_is_noticed(square):
    twin = Rotation(square)
    square.add_vertex()
    with pytest.raises(AssertionError, match="rows"):
        twin.assert_same(square)
    square.remove_vertex(5)
    with pytest.raises(AssertionError, match="rows"):
        twin.assert_same(square)


@pytest.mark.parametrize(
    ("lie", "said"),
    [
        (lambda t, h, w: -1, "was refused"),
        (lambda t, h, w: 0, "gives 0|expected"),
        (lambda t, h, w: hm.try_split_edge.interpreted(t, h ^ 1, w), "is wrong"),
        (lambda t, h, w: hm.try_split_edge.interpreted(t, h, w) + 1, "gives"),
    ],
)
def test_an_operator_that_lies_is_noticed(square, monkeypatch, lie, said):
    monkeypatch.setitem(rotation.table.KERNELS, "try_split_edge", lie)
    with pytest.raises(AssertionError, match=said):
        Walk(square).step("split_edge", [4, 0.5])


def test_a_refusal_that_changes_something_is_noticed(square, monkeypatch):
    def meddle(t, e, allow_parallel):
        t.topology.__arrays__().vertex_halfedge[0] = 5
        return hm.try_flip.interpreted(t, e, allow_parallel)

    monkeypatch.setitem(rotation.table.KERNELS, "try_flip", meddle)
    with pytest.raises(AssertionError, match="changed the columns"):
        Walk(square).step("flip", [0, False])


def test_an_operator_that_is_not_refused_is_noticed(square, monkeypatch):
    monkeypatch.setitem(rotation.table.KERNELS, "try_join_faces", lambda t, h: 0)
    with pytest.raises(AssertionError, match="not refused"):
        Walk(square).step("join_faces", [0])


def test_an_attribute_that_does_not_follow_is_noticed(square, monkeypatch):
    def forget(t, f):
        v = hm.try_split_face.interpreted(t, f)
        t.face_data["area"][f] += 1
        return v

    monkeypatch.setitem(rotation.table.KERNELS, "try_split_face", forget)
    with pytest.raises(AssertionError, match="faces held"):
        Walk(square).step("split_face", [0])


def test_a_flip_turns_the_diagonal_of_a_square(square):
    twin = Rotation(square)
    e = next(h >> 1 for h in twin.origin if {twin.origin[h], twin.target(h)} == {0, 2})
    rotation.BY_NAME["flip"].act(twin, e, False)
    assert {twin.origin[2 * e], twin.target(2 * e)} == {1, 3}
    assert sorted(sorted(twin.corners(f)) for f in twin.faces()) == [[0, 1, 3], [1, 2, 3]]


def test_the_ring_of_a_tetrahedron_is_closed():
    twin = Rotation(zoo()["tetrahedron"].mesh())
    assert all(twin.is_closed(v) and len(twin.ring[v]) == 3 for v in twin.ring)


# -- what walks have found ------------------------------------------------------------------------------------------


def double_edges_of_wire(*pairs):
    mesh = hm.Mesh([], n_vertices=3)
    for u, v in pairs:
        mesh.add_edge(u, v)
        mesh.add_edge(u, v)
    return mesh


def test_what_a_stitch_would_close_next_is_no_reason():
    assert hm.stitch_status(double_edges_of_wire((0, 1), (0, 2)), 3, 4, False) == 0


def test_a_triangle_with_a_loop_edge_is_not_collapsed_into_its_neighbor():
    mesh = hm.Mesh([[1, 0, 0], [0, 2, 1], [0, 1, 2]], twins=[6, -1, 5, -1, 7, 2, 0, 4, -1], n_vertices=3)
    assert hm.collapse_status(mesh, 0) != 0


def test_a_face_around_one_edge_is_not_glued():
    mesh = hm.Mesh([], n_vertices=4)
    for ends in ((0, 1), (0, 1), (2, 3)):
        mesh.add_edge(*ends)
    mesh.fill_hole(2)
    mesh.fill_hole(4)
    assert REASONS[hm.join_loop_status(mesh, 2, 4, True)].name == "same_edge"


def test_stitching_does_not_make_edges_parallel_at_a_shared_end():
    assert hm.stitch_status(double_edges_of_wire((0, 1), (1, 2)), 0, 4, False) != 0


def test_a_loop_edge_does_not_keep_its_vertex_from_collapsing():
    mesh = hm.Mesh([], n_vertices=2)
    mesh.add_edge(0, 0)
    mesh.add_edge(0, 1)
    assert [hm.collapse_status(mesh, h) for h in (2, 3)] == [0, 0]


def test_two_triangles_may_close_over_the_same_edge():
    """Each has a loop edge at one end and shares its third edge with the other: both close over that one."""
    mesh = hm.Mesh([[0, 1, 1], [1, 0, 0]], twins=[3, -1, 5, 0, -1, 2], n_vertices=2)
    mesh.fill_hole(mesh.boundary_loops()[0][0])
    mesh.collapse(mesh.find_halfedge(0, 1))
    mesh.check()
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces, mesh.n_boundary_loops) == (1, 1, 1, 1)
