"""OpenMesh's Python bindings."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import openmesh as om

from benchmarks.compare.peer import (
    Array,
    Peer,
    Surface,
    Way,
    Ways,
    centres_of,
    counted,
    edges_of,
    middles_of,
    points_to_add,
    split_of,
    summed,
    triangles,
)
from benchmarks.timing import NotOfferedError


class OpenMesh(Peer):
    name = "openmesh"
    module = "openmesh"

    def builds(self, surface: Surface) -> Ways:
        note = "half-edge mesh"
        if isinstance(surface.faces, tuple):
            raise NotOfferedError("takes polygons as padded rows only")
        kind = om.TriMesh if surface.faces.shape[1] == 3 else om.PolyMesh
        return {
            kind.__name__: Way(
                lambda: kind(surface.points, surface.faces), note, facts=lambda mesh: {"edges": mesh.n_edges()}
            )
        }

    def readers(self, path: Path) -> Ways:
        return {
            "read_trimesh": Way(
                lambda: om.read_trimesh(str(path)),
                "builds connectivity",
                facts=lambda mesh: counted(mesh.n_vertices(), mesh.n_faces()),
                points=lambda mesh: mesh.points(),
            )
        }

    def writers(self, surface: Surface, path: Path) -> Ways:
        mesh = om.TriMesh(surface.points, triangles(surface))
        return {"write_mesh": Way(lambda: om.write_mesh(str(path), mesh))}

    def rings(self, surface: Surface) -> Ways:
        mesh = om.TriMesh(surface.points, triangles(surface))
        return {
            "Python loop over vv": Way(lambda: ring_loop(mesh), facts=summed),
            "NumPy over vv_indices": Way(lambda: ring_arrays(mesh), "vectorized by hand", facts=summed),
        }

    def steps(self, surface: Surface, n: int) -> Ways:
        mesh = om.TriMesh(surface.points, triangles(surface))
        start = mesh.halfedge_handle(0)

        def next_() -> None:
            h = start
            for _ in range(n):
                h = mesh.next_halfedge_handle(h)

        def twin() -> None:
            h = start
            for _ in range(n):
                h = mesh.opposite_halfedge_handle(h)

        def ccw() -> None:
            h = start
            for _ in range(n):
                h = mesh.ccw_rotated_halfedge_handle(h)

        def face() -> None:
            h = start
            for _ in range(n):
                mesh.face_handle(h)

        def target() -> None:
            h = start
            for _ in range(n):
                mesh.to_vertex_handle(h)

        def walk() -> None:
            h = start
            for _ in range(n // 5):
                h = mesh.next_halfedge_handle(h)
                mesh.face_handle(h)
                mesh.to_vertex_handle(h)
                h = mesh.opposite_halfedge_handle(h)
                h = mesh.ccw_rotated_halfedge_handle(h)

        return {"next": Way(next_), "twin": Way(twin), "ccw": Way(ccw), "face": Way(face), "target": Way(target),
                "walk": Way(walk)}  # fmt: skip

    def edits(self, surface: Surface, kind: str) -> Ways:
        start = split_of(surface) if kind == "collapse" else surface
        ends, n = edges_of(surface).tolist(), len(surface.points)

        def mesh_and_vertices() -> Any:
            mesh = om.TriMesh(start.points, triangles(start))
            return mesh, list(mesh.vertices())

        def edges() -> Any:
            mesh, vertex = mesh_and_vertices()
            return mesh, [mesh.edge_handle(mesh.find_halfedge(vertex[u], vertex[v])) for u, v in ends]

        def edges_and_points() -> Any:
            return *edges(), list(middles_of(surface))

        def faces_and_points() -> Any:
            mesh, _ = mesh_and_vertices()
            return mesh, list(mesh.faces()), list(centres_of(surface))

        def spokes() -> Any:
            mesh, vertex = mesh_and_vertices()
            corners = triangles(surface)[:, 0].tolist()
            return mesh, [mesh.find_halfedge(vertex[n + f], vertex[v]) for f, v in enumerate(corners)]

        run, note, fresh = {
            "flip": (ask_and_flip, "is_flip_ok first", edges),
            "split_edge": (split, "add_vertex first", edges_and_points),  # `split` with a point raises in 1.2.1
            "split_face": (split, "add_vertex first", faces_and_points),
            "collapse": (ask_and_collapse, "is_collapse_ok first", spokes),
        }[kind]
        return {"in two calls": Way(run, note, facts=done, fresh=fresh)}

    def growth(self, surface: Surface, kind: str) -> Ways:
        faces = triangles(surface).tolist()

        def vertices(state: Any) -> tuple[int, om.TriMesh]:
            mesh, points = state
            for point in points:
                mesh.add_vertex(point)
            return len(points), mesh

        def add_faces(state: Any) -> tuple[int, om.TriMesh]:
            mesh, rows = state
            for a, b, c in rows:
                mesh.add_face(a, b, c)
            return len(rows), mesh

        def handles() -> Any:
            mesh = om.TriMesh(surface.points)
            v = list(mesh.vertices())
            return mesh, [(v[a], v[b], v[c]) for a, b, c in faces]

        if kind == "add_vertex":
            return {"add": Way(vertices, facts=done, fresh=lambda: (om.TriMesh(), points_to_add(surface)))}
        return {"add": Way(add_faces, "through handles", facts=done, fresh=handles)}

    def bulk(self, surface: Surface) -> Ways:
        def add(mesh: om.TriMesh) -> tuple[int, om.TriMesh]:
            mesh.add_vertices(surface.points)
            mesh.add_faces(triangles(surface))
            return surface.n_faces, mesh

        return {"add_vertices, add_faces": Way(add, "to an empty mesh", facts=done, fresh=om.TriMesh)}

    def normals(self, surface: Surface) -> Ways:
        mesh = om.TriMesh(surface.points, triangles(surface))
        mesh.request_face_normals()
        mesh.request_vertex_normals()

        def update() -> Array:
            mesh.update_normals()
            return np.asarray(mesh.vertex_normals())

        return {"update_normals": Way(update, "with face normals")}


def ring_loop(mesh: om.TriMesh) -> Array:
    points = mesh.points()
    means: Array = np.empty_like(points)
    for v in mesh.vertices():
        total, n = np.zeros(3), 0
        for u in mesh.vv(v):
            total += points[u.idx()]
            n += 1
        means[v.idx()] = total / n
    return means


def ring_arrays(mesh: om.TriMesh) -> Array:
    neighbors, points = mesh.vv_indices(), mesh.points()
    there = neighbors >= 0
    totals = np.zeros_like(points)
    for column, mask in zip(neighbors.T, there.T, strict=True):
        totals += points[column] * mask[:, None]
    means: Array = totals / there.sum(axis=1)[:, None]
    return means


def done(result: tuple[int, om.TriMesh]) -> dict[str, float]:
    """How many elements were treated, and what is left of the mesh once what was deleted is removed."""
    n, mesh = result
    mesh.garbage_collection()
    return {"operations": n} | counted(mesh.n_vertices(), mesh.n_faces())


def ask_and_flip(state: Any) -> tuple[int, om.TriMesh]:
    mesh, edges = state
    n = 0
    for e in edges:
        if mesh.is_flip_ok(e):
            mesh.flip(e)
            n += 1
    return n, mesh


def split(state: Any) -> tuple[int, om.TriMesh]:
    mesh, elements, points = state
    for element, point in zip(elements, points, strict=True):
        mesh.split(element, mesh.add_vertex(point))
    return len(elements), mesh


def ask_and_collapse(state: Any) -> tuple[int, om.TriMesh]:
    mesh, halfedges = state
    n = 0
    for h in halfedges:
        if mesh.is_collapse_ok(h):
            mesh.collapse(h)
            n += 1
    return n, mesh


peer = OpenMesh()
