"""Jobs that come past every operator."""

from __future__ import annotations

import contextlib
from typing import Any

import numpy as np

import halfmesh as hm
from halfmesh import _jit
from halfmesh.core.facelist import as_face_list
from halfmesh.core.operators import building
from halfmesh.core.pens import rewind
from halfmesh.core.sewing import sewn
from halfmesh.core.slots import reserve
from halfmesh.warmup.meshes import decorated

__all__ = ["change", "sew"]


def change() -> None:
    """Every operator, with attributes of all kinds that follow, and of each form that policies are compiled for."""
    mesh = hm.shapes.icosphere(1)
    for table in (mesh.vertex_data, mesh.halfedge_data, mesh.edge_data, mesh.face_data):
        table.add("x", float)
        table.add("label", int)
    for operator in (
        lambda: mesh.flip(0),
        lambda: mesh.split_edge(0),
        lambda: mesh.split_face(0),
        lambda: mesh.join_faces(mesh.connect(mesh.faces[1].halfedge, mesh.faces[1].halfedge.next, allow_parallel=True)),
        lambda: (mesh.can_flip(0), mesh.can_connect(0, 0), mesh.can_join_faces(0)),
        lambda: mesh.collapse(next(h for h in mesh.halfedges if mesh.can_collapse(h))),
    ):
        operator()
    plain = hm.shapes.icosphere(1)
    for i in range(2):  # from the second call on they take the points along
        plain.split_edge(100), plain.split_face(60), plain.try_collapse(9 + i), plain.split_edge_triangular(110)
    _build_by_hand()
    _build_in_bulk()
    _change_wholes()
    with mesh.transaction() as attempt:
        mesh.split_face(next(iter(mesh.faces)))
        attempt.rollback()
    _grow(mesh.vertex_data.column("points"), 100)
    _jit.filled(mesh.points, len(mesh.points) + 1, mesh.points[:1])  # what `_grow` calls, which may come from the cache
    mesh.compact()
    rewind(mesh, 0)
    reserve(mesh, 1, 1, 1)


def sew() -> None:
    """The operators that `_change` does not come to; each by its question, and by the method that acts."""
    mesh = hm.shapes.grid(4, 4)
    a, b = mesh.vertices[6].outgoing(), mesh.vertices[8].outgoing()
    h: Any = mesh.find_halfedge(6, 7)
    rim = mesh.boundary_loops()[0]
    g = next(x for x in a if x != h)
    for question, *elements in (
        (mesh.can_split_edge_triangular, h),
        (mesh.can_split_vertex, h, g),
        (mesh.can_join_vertices, h),
        (mesh.can_dissolve_vertex, 7),
        (mesh.can_dissolve_edge, h),
        (mesh.can_fill_hole, 0),
        (mesh.can_add_face_to_boundary, int(rim[0]), int(rim[2])),
        (mesh.can_add_vertex_and_face_to_boundary, int(rim[0]), int(rim[2])),
        (mesh.can_open_edge, h),
        (mesh.can_close_edge, 0),
        (mesh.can_weld, mesh.halfedges[int(rim[0])], mesh.halfedges[int(rim[3])]),
        (mesh.can_weld, 0, 12),
        (mesh.can_unweld, int(rim[0]), int(rim[0])),
        (mesh.can_cut, [h]),
        (mesh.can_stitch, int(rim[0]), int(rim[3])),
        (mesh.can_split_loop, [h, h.next, h.next.next, h.prev]),
        (mesh.can_join_loop, h, next(b)),
    ):
        question(*elements)
    mesh.join_vertices(mesh.split_vertex(h, g).twin)
    for act, *arguments in (
        (mesh.try_flip, h.edge),
        (mesh.split_edge_triangular, h.twin),
        (mesh.dissolve_vertex, 7),
        (mesh.dissolve_edge, mesh.faces[10].halfedge),
        (mesh.make_hole, 12),
        (mesh.fill_hole, int(rim[0])),
        (mesh.add_face_to_boundary, int(rim[0]), int(rim[3])),
        (mesh.add_vertex_and_face_to_boundary, int(rim[0]), int(rim[3])),
        (mesh.close_edge, int(rim[0])),
        (mesh.open_edge, h),
        (mesh.weld, mesh.halfedges[int(rim[0])], mesh.halfedges[int(rim[4])]),
        (mesh.weld, 0, 24),
        (mesh.unweld, int(rim[0]), int(rim[4])),
        (mesh.cut, [h]),
        (mesh.stitch, int(rim[0]), int(rim[5])),
        (mesh.zip_hole, int(rim[1])),
        (mesh.split_loop, [h, h.next, h.next.next, h.prev]),
        (mesh.join_loop, h, int(rim[1])),
    ):
        with contextlib.suppress(hm.TopologyError, hm.StaleElementError):
            act(*arguments)


def _build_by_hand() -> None:
    mesh = hm.Mesh([])
    for _ in range(6):
        mesh.add_vertex()
    edges = [mesh.add_edge(0, 1), mesh.add_edge(1, 2), mesh.add_edge(2, 0)]
    mesh.remove_edge(mesh.add_edge(edges[0].halfedge, 5))
    mesh.can_add_face([3, 4, 5]), mesh.can_add_face(halfedges=[0, 2, 4]), mesh.can_make_adjacent(0, 2)
    mesh.add_face(halfedges=[e.halfedge for e in edges])
    mesh.add_face([3, 4, 5])
    mesh.make_adjacent(mesh.halfedges[1], mesh.halfedges[1].next)
    mesh.remove_face(0)
    mesh.remove_edge(0)
    mesh.remove_vertex(3)
    for kernel, *arguments in (
        (building.add_edge_status, 0, 1),
        (building.make_adjacent_status, 2, 2),
        (building.find_free_incident, 1),
        (building.find_free_between, 1, 2, 2),
        (building.add_edge_in, 2, 2),
    ):
        kernel(mesh, *arguments)


def _build_in_bulk() -> None:
    mesh = hm.Mesh([])
    mesh.add_vertices(np.zeros((24, 3)))
    mesh.add_vertex([1.0, 2.0, 3.0])
    mesh.add_faces([[0, 1, 2]])
    mesh.add_faces([[2, 1, 3], [3, 1, 4]])
    mesh.add_face([2, 3, 4, 5])
    mesh.add_face([6, 7, 8, 9, 10])
    mesh.add_face([11, 12, 13, 12])
    half = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]], np.int32)
    sewn(hm.Mesh([[0, 4, 1]], n_vertices=6).topology, as_face_list(half, 6))
    hm.try_add_faces(mesh, np.array([11, 14, 15], np.int32), np.array([0, 3], np.int32))


def _change_wholes() -> None:
    mesh = decorated()
    mesh.append(mesh)
    mesh.reverse()
    mesh.reverse_component(0)
    mesh.submesh([0])
    mesh.remove_component(0)


@hm.kernel
def _grow(points: Any, n: int) -> None:
    points[n, 0] = points[0, 0]
