"""PyMeshLab: MeshLab's filters."""

from __future__ import annotations

from pathlib import Path

import pymeshlab

from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, counted, triangles


class PyMeshLab(Peer):
    name = "pymeshlab"
    module = "pymeshlab"

    def readers(self, path: Path) -> Ways:
        def read() -> pymeshlab.MeshSet:
            meshes = pymeshlab.MeshSet()
            meshes.load_new_mesh(str(path))
            return meshes

        def facts(meshes: pymeshlab.MeshSet) -> dict[str, float]:
            return counted(meshes.current_mesh().vertex_number(), meshes.current_mesh().face_number())

        return {"load_new_mesh": Way(read, facts=facts, points=lambda meshes: meshes.current_mesh().vertex_matrix())}

    def writers(self, surface: Surface, path: Path) -> Ways:
        meshes = mesh_set(surface)
        return {"save_current_mesh": Way(lambda: meshes.save_current_mesh(str(path)))}

    def normals(self, surface: Surface) -> Ways:
        meshes = mesh_set(surface)

        def normals() -> Array:
            meshes.compute_normal_per_vertex()
            array: Array = meshes.current_mesh().vertex_normal_matrix()
            return array

        return {"compute_normal_per_vertex": Way(normals)}


def mesh_set(surface: Surface) -> pymeshlab.MeshSet:
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(surface.points, triangles(surface)))
    return meshes


peer = PyMeshLab()
