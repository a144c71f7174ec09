"""MeshLib."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from meshlib import mrmeshnumpy as mn
from meshlib import mrmeshpy as mm

from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, counted, summed, triangles


class MeshLib(Peer):
    name = "meshlib"
    module = "meshlib.mrmeshpy"

    def builds(self, surface: Surface) -> Ways:
        faces = triangles(surface)
        return {
            "meshFromFacesVerts": Way(
                lambda: mn.meshFromFacesVerts(faces, surface.points),
                "half-edge mesh",
                facts=lambda mesh: {"edges": mesh.topology.undirectedEdgeSize()},
            )
        }

    def readers(self, path: Path) -> Ways:
        return {
            "loadMesh": Way(
                lambda: mm.loadMesh(path),
                "builds connectivity",
                facts=lambda mesh: counted(mesh.topology.numValidVerts(), mesh.topology.numValidFaces()),
                points=mn.getNumpyVerts,
            )
        }

    def writers(self, surface: Surface, path: Path) -> Ways:
        mesh = mn.meshFromFacesVerts(triangles(surface), surface.points)
        return {"saveMesh": Way(lambda: mm.saveMesh(mesh, path))}

    def rings(self, surface: Surface) -> Ways:
        mesh = mn.meshFromFacesVerts(triangles(surface), surface.points)
        return {"Python loop over next": Way(lambda: ring_loop(mesh), facts=summed)}

    def steps(self, surface: Surface, n: int) -> Ways:
        topology = mn.meshFromFacesVerts(triangles(surface), surface.points).topology
        start = mm.EdgeId(0)

        def next_() -> None:
            e = start
            for _ in range(n):
                e = topology.prev(e.sym())

        def twin() -> None:
            e = start
            for _ in range(n):
                e = e.sym()

        def ccw() -> None:
            e = start
            for _ in range(n):
                e = topology.next(e)

        def face() -> None:
            for _ in range(n):
                topology.left(start)

        def target() -> None:
            for _ in range(n):
                topology.dest(start)

        def walk() -> None:
            e = start
            for _ in range(n // 5):
                e = topology.prev(e.sym())
                topology.left(e)
                topology.dest(e)
                e = e.sym()
                e = topology.next(e)

        return {"next": Way(next_), "twin": Way(twin), "ccw": Way(ccw), "face": Way(face), "target": Way(target),
                "walk": Way(walk)}  # fmt: skip

    def normals(self, surface: Surface) -> Ways:
        mesh = mn.meshFromFacesVerts(triangles(surface), surface.points)
        return {"computePerVertNormals": Way(lambda: mn.toNumpyArray(mm.computePerVertNormals(mesh)), "area weighted")}


def ring_loop(mesh: Any) -> Array:
    topology, points = mesh.topology, mn.getNumpyVerts(mesh)
    means: Array = np.empty_like(points)
    for v in range(len(points)):
        total, n = np.zeros(3), 0
        first = e = topology.edgeWithOrg(mm.VertId(v))
        while True:
            total += points[topology.dest(e).get()]
            n += 1
            e = topology.next(e)
            if e == first:
                break
        means[v] = total / n
    return means


peer = MeshLib()
