"""From the contents of a file to a mesh, and back."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh.core.tables import is_wire
from halfmesh.errors import InvalidMeshError
from halfmesh.io.data import MeshData
from halfmesh.mesh.mesh import Mesh

__all__ = ["data_of", "mesh_of"]

LINE = "line"
_OWN = frozenset({"points"})  # columns of a mesh that are no attributes of a file


def mesh_of(data: MeshData, path: str) -> Mesh:
    """Build the mesh and hang the attributes on it."""
    wire, marked = _lines(data)
    try:
        mesh = Mesh(data.faces, data.points, edges=wire if len(wire) else None)
    except InvalidMeshError as error:
        error.add_note(f"in the file {path}")
        raise
    for name, values in data.vertex.items():
        mesh.vertex_data[name] = values
    for name, values in data.face.items():
        mesh.face_data[name] = values
    if data.halfedge:
        of_corner = mesh.corner_halfedges()
        for name, values in data.halfedge.items():
            mesh.halfedge_data[name] = _spread(values, of_corner, len(mesh.topology.next))
    if len(marked):
        mesh.edge_data[LINE] = np.isin(_keys(mesh.edge_vertices(), data.n_vertices), marked)
    if data.edge:
        _hang_on_edges(mesh, data)
    mesh.meta.update(data.meta)
    return mesh


def data_of(mesh: Mesh) -> MeshData:
    """The living elements of a mesh as a file holds them: numbered without gaps."""
    t = mesh.topology
    slots = (len(t.vertex_halfedge), len(t.next), len(t.face_halfedge))
    if (mesh.n_vertices, mesh.n_halfedges, mesh.n_faces) != slots:
        mesh = mesh.copy()
        mesh.compact()
    indices, offsets = mesh.face_vertices()
    data = MeshData(indices, offsets, mesh.points)
    lines = np.flatnonzero(_is_line(mesh))
    if len(lines):
        data.edges = mesh.edge_vertices()[lines]
    data.edge = {name: values[lines] for name, values in mesh.edge_data.items() if name != LINE}
    data.vertex = {name: values for name, values in mesh.vertex_data.items() if name not in _OWN}
    data.face = dict(mesh.face_data.items())
    if len(mesh.halfedge_data):
        of_corner = mesh.corner_halfedges()
        data.halfedge = {name: values[of_corner] for name, values in mesh.halfedge_data.items()}
    data.meta = dict(mesh.meta)
    return data


def _lines(data: MeshData) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """Lines that are not along a face, each edge once, and the keys of those that are."""
    if not len(data.edges):
        return data.edges, np.zeros(0, dtype=np.int64)
    keys, first = np.unique(_keys(data.edges, data.n_vertices), return_index=True)
    following = np.arange(1, len(data.indices) + 1)
    following[data.offsets[1:] - 1] = data.offsets[:-1]
    sides = np.column_stack([data.indices, data.indices[following]])
    along = np.isin(keys, _keys(sides, data.n_vertices))
    return data.edges[np.sort(first[~along])], keys[along]


def _hang_on_edges(mesh: Mesh, data: MeshData) -> None:
    """Attributes of lines, on the edges that they became; of several rows for an edge the first counts."""
    keys, first = np.unique(_keys(data.edges, data.n_vertices), return_index=True)
    of_edge = _keys(mesh.edge_vertices(), data.n_vertices)
    places = np.flatnonzero(np.isin(of_edge, keys))
    rows = first[np.searchsorted(keys, of_edge[places])]
    for name, values in data.edge.items():
        mesh.edge_data[name] = _spread(values[rows], places, len(of_edge))


def _keys(pairs: NDArray[Any], n_vertices: int) -> NDArray[np.int64]:
    """One number for each unordered pair."""
    low, high = pairs.min(axis=1).astype(np.int64), pairs.max(axis=1).astype(np.int64)
    keys: NDArray[np.int64] = low * n_vertices + high
    return keys


def _is_line(mesh: Mesh) -> NDArray[np.bool_]:
    wire = is_wire(mesh.topology)
    if LINE in mesh.edge_data and mesh.edge_data[LINE].dtype == bool:
        wire = wire | mesh.edge_data[LINE]
    return wire


def _spread(values: NDArray[Any], places: NDArray[Any], n: int) -> NDArray[Any]:
    spread = np.full((n, *values.shape[1:]), np.nan if values.dtype.kind == "f" else 0, dtype=values.dtype)
    spread[places] = values
    return spread
