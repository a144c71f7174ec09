"""Writing ``.ale``: polygons for the virtual element method, as Polylla's program writes them and VEMLab reads them.

Sections under a comment each: the type of the domain; the number of nodes and their two coordinates; the number of
elements and of each its number of nodes and the nodes, counter-clockwise, counted from 1; the nodes on the Dirichlet
boundary; those on the Neumann boundary, 0 for none; the bounding box.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from halfmesh.errors import FormatError
from halfmesh.io.data import MeshData
from halfmesh.io.source import Source
from halfmesh.io.text_writing import Corners, Table, face_text, row_text
from halfmesh.mesh.mesh import Mesh

__all__ = ["ale_pieces", "refuse_to_read_ale"]

_BASE = 1  # VEMLab is written in MATLAB; a 0 means that there is no node


def ale_pieces(data: MeshData, path: str) -> Iterator[bytes | memoryview]:
    """The file, piece by piece; all boundary nodes are Dirichlet nodes, loop after loop with the domain on the left."""
    if not len(data.points) or data.points[:, 2].any() or len(data.edges):
        raise FormatError(
            "an .ale file holds polygons in the plane z = 0, without wire, and at least a point", path=path
        )
    yield b"# domain type\nCustom\n"
    yield b"# nodal coordinates: number of nodes followed by the coordinates\n%d\n" % data.n_vertices
    yield from row_text(Table(data.points[:, :2]))
    yield b"# element connectivity: number of elements followed by the elements\n%d\n" % data.n_faces
    yield from face_text(Corners(data.indices, data.offsets, _BASE), 0, data.n_faces)
    yield b"# indices of nodes located on the Dirichlet boundary\n"
    yield _listed(_boundary(data))
    yield b"# indices of nodes located on the Neumann boundary\n0\n"
    yield b"# xmin, xmax, ymin, ymax of the bounding box\n"
    low, high = data.points.min(axis=0), data.points.max(axis=0)
    yield from row_text(Table(np.array([[low[0], high[0], low[1], high[1]]])))


def refuse_to_read_ale(source: Source) -> MeshData:
    """There is no reader: other programs read these files."""
    raise FormatError(".ale files are written, not read; keep the mesh in another format as well", path=source.path)


def _boundary(data: MeshData) -> list[int]:
    mesh = Mesh(data.faces, n_vertices=data.n_vertices)
    origin = mesh.topology.origin
    return [int(v) for loop in mesh.boundary_loops() for v in origin[loop[::-1]]]


def _listed(vertices: list[int]) -> bytes:
    once = list(dict.fromkeys(vertices)) or [0 - _BASE]
    return " ".join(str(v + _BASE) for v in once).encode() + b"\n"
