"""OpenMesh's Python bindings."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import openmesh as om

from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, counted, summed, triangles
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


peer = OpenMesh()
