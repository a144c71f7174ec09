"""Meshes with as many elements as int32 can number: what adds another is refused, and said to be so when asked."""

from __future__ import annotations

import contextlib

import pytest

import halfmesh as hm
from alike import columns
from halfmesh._jit import gears
from halfmesh.core.topology import EDGE_SLOTS, FACE_SLOTS, LIMIT, VERTEX_SLOTS


def bow_tie():
    return hm.Mesh([[0, 1, 2], [0, 3, 4]], n_vertices=7)


def rim(mesh):
    """An exterior halfedge."""
    return next(h for h in mesh.halfedges if h.is_exterior)


def gaps(mesh):
    """The exterior halfedges that leave the vertex 0."""
    return [h for h in mesh.vertices[0].outgoing() if h.is_exterior]


def around(mesh):
    """The loop along the first face, counter-clockwise."""
    return [list(mesh.faces[0].halfedges())]


ADDING = {
    "split_edge": (hm.shapes.cube, lambda mesh: [0]),
    "split_face": (hm.shapes.cube, lambda mesh: [0]),
    "split_edge_triangular": (hm.shapes.tetrahedron, lambda mesh: [0]),
    "connect": (hm.shapes.cube, lambda mesh: [mesh.faces[0].halfedge, mesh.faces[0].halfedge.next.next]),
    "split_vertex": (hm.shapes.cube, lambda mesh: list(mesh.vertices[0].outgoing())[:2]),
    "unweld": (bow_tie, gaps),
    "open_edge": (hm.shapes.cube, lambda mesh: [0]),
    "cut": (hm.shapes.cube, lambda mesh: [[0]]),
    "split_loop": (hm.shapes.cube, around),
    "fill_hole": (bow_tie, lambda mesh: [rim(mesh)]),
    "add_face_to_boundary": (lambda: hm.Mesh([[0, 1, 2, 3]]), lambda mesh: [rim(mesh), rim(mesh).next.next]),
    "add_vertex_and_face_to_boundary": (bow_tie, lambda mesh: [rim(mesh), rim(mesh).next]),
    "add_edge": (bow_tie, lambda mesh: [5, 6]),
    "add_face": (bow_tie, lambda mesh: [[4, 5, 6]]),
}


@contextlib.contextmanager
def full(mesh):
    """As if there were no number left for another vertex, edge or face."""
    counts = mesh.topology.__arrays__().counts
    before = counts.copy()
    counts[[VERTEX_SLOTS, EDGE_SLOTS, FACE_SLOTS]] = LIMIT, LIMIT // 2, LIMIT
    yield
    counts[:] = before


@pytest.mark.parametrize("is_compiled", [False, True])
@pytest.mark.parametrize("name", ADDING)
def test_what_would_be_refused_on_a_full_mesh_is_said_not_to_be_possible(name, is_compiled, monkeypatch):
    monkeypatch.setattr(gears, "always_compile", is_compiled)
    make, elements = ADDING[name]
    mesh = make()
    args, before = elements(mesh), columns(mesh)
    can, act = getattr(mesh, f"can_{name}"), getattr(mesh, name)
    assert can(*args)
    with full(mesh):
        assert not can(*args)
        with pytest.raises(hm.TopologyError) as refused:
            act(*args)
    assert refused.value.reason == "too_large"
    assert all((column == before[of]).all() for of, column in columns(mesh).items())
    assert can(*args)
    act(*args)
    hm.testing.assert_valid(mesh)


def test_every_operator_that_can_be_asked_and_adds_elements_is_tested_here():
    rest = {"flip", "collapse", "join_faces", "dissolve_edge", "dissolve_vertex", "join_vertices", "weld", "make_hole",
            "close_edge", "stitch", "zip_hole", "join_loop", "make_adjacent"}  # fmt: skip
    assert {name.removeprefix("can_") for name in dir(hm.Mesh) if name.startswith("can_")} == {*ADDING, *rest}
