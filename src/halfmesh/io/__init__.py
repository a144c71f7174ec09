"""Mesh files: read, written, never half of either.

========================  =============================================================================
``load`` ``save``         a :class:`~halfmesh.Mesh`
``read`` ``write``        plain arrays, also of what is no mesh that can be held
``read_data``             everything that a file holds, as a :class:`MeshData`
========================  =============================================================================

The suffix says which format it is; the table is in `halfmesh.io.formats`.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike, NDArray

from halfmesh.errors import ElementError
from halfmesh.io.data import Faces, MeshData
from halfmesh.io.formats import FORMATS, Format, format_of
from halfmesh.io.source import Source

if TYPE_CHECKING:
    import numpy as np

    from halfmesh.mesh.mesh import Mesh

__all__ = ["FORMATS", "Format", "MeshData", "load", "read", "read_data", "save", "write"]

Path = str | os.PathLike[str]


def read(path: Path) -> tuple[Faces, NDArray[np.float64]]:
    """Read the faces and points of a file, whether or not they make a mesh.

    Parameters
    ----------
    path : str or path-like
        Its suffix, in capitals or not, says the format: ``.off``, ``.obj``, or ``.ele .node .neigh .poly`` of
        Triangle, of which the others that belong to a mesh are read from beside it.

    Returns
    -------
    faces : ndarray of int32, shape (n_faces, k), or tuple (indices, offsets)
        A table if all faces have `k` vertices. Otherwise the vertices of all faces in one array, and where each face
        begins in it, with the end: shape (n_faces + 1,).
    points : ndarray of float64, shape (n_vertices, 3)
        The same bits that Python's ``float()`` makes of the text.

    Raises
    ------
    FormatError
        With path, line (or byte) and what was expected there.
    OSError
        What the system refuses.

    Notes
    -----
    Time and memory are proportional to the size of the file, whatever its header says.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "pages.off"
    >>> _ = path.write_text("OFF 5 3 0  0 0 0  0 0 1  1 0 0  0 1 0  -1 0 0  3 0 1 2  3 0 1 3  3 0 1 4")
    >>> faces, points = read(path)
    >>> faces.tolist(), points.shape
    ([[0, 1, 2], [0, 1, 3], [0, 1, 4]], (5, 3))
    """
    data = read_data(path)
    return data.faces, data.points


def read_data(path: Path) -> MeshData:
    r"""Read all that a file holds: faces, points, wire, named attributes, names of groups.

    Parameters and exceptions are those of :func:`read`.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "page.obj"
    >>> _ = path.write_text("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\ng front\nf 1 2 3\n")
    >>> data = read_data(path)
    >>> data.vertex["color"].tolist(), data.face["group"].tolist(), data.meta["groups"]
    ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0], ['front'])
    """
    return format_of(path).read(Source(path))


def load(path: Path) -> Mesh:
    """Read a file into a mesh. Polygons stay polygons; nothing is merged, dropped or reordered.

    Parameters
    ----------
    path : str or path-like

    Returns
    -------
    Mesh
        With the attributes of the file in `vertex_data`, `halfedge_data` (the corners of faces; NaN outside) and
        `face_data`. An OBJ line (``l``) along an edge of a face makes no second edge but a mark in
        ``edge_data["line"]``; elsewhere it makes wire.

    Raises
    ------
    FormatError
        The file is malformed.
    InvalidMeshError
        It is well formed, but not a mesh that can be held; see :func:`read`.
    OSError
        What the system refuses.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import halfmesh as hm
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "cube.off"
    >>> hm.save(hm.shapes.cube(), path)
    >>> hm.load(path)
    <Mesh: 8 vertices, 12 edges, 6 faces, closed>
    """
    from halfmesh.io.meshes import mesh_of

    return mesh_of(read_data(path), os.fspath(path))


def save(mesh: Mesh, path: Path) -> None:
    """Write a mesh to a file, with the attributes that the format can hold.

    The file appears whole or not at all; what was there before is replaced only at the end. Numbers are written as the
    shortest text that reads back to the same bits.

    Parameters
    ----------
    mesh : Mesh
    path : str or path-like
        Its suffix says the format. With ``.ele`` or ``.node`` both are written, with ``.neigh`` all three of them.

    Raises
    ------
    FormatError
        The suffix is unknown, or the format can't hold the mesh (wire in OFF, polygons in ``.ele``).
    ElementError
        The first argument is no mesh.
    OSError
        What the system refuses.
    """
    from halfmesh.io.meshes import data_of
    from halfmesh.mesh.asking import Asked
    from halfmesh.mesh.mesh import Mesh

    if isinstance(mesh, Asked) and not isinstance(mesh, Mesh):  # only read: its file is that of the ordinary mesh
        mesh = mesh.to_mesh()
    if not isinstance(mesh, Mesh):
        raise ElementError(
            f"save(mesh, path) takes a Mesh, not {type(mesh).__name__}; for arrays: write(path, faces, points)"
        )
    _write(data_of(mesh), path)


def write(
    path: Path,
    faces: Any,
    points: ArrayLike,
    *,
    edges: ArrayLike | None = None,
    vertex: Mapping[str, ArrayLike] | None = None,
    halfedge: Mapping[str, ArrayLike] | None = None,
    edge: Mapping[str, ArrayLike] | None = None,
    face: Mapping[str, ArrayLike] | None = None,
    meta: Mapping[str, Any] | None = None,
) -> None:
    """Write plain arrays to a file, whether or not they make a mesh; see :func:`save`.

    Parameters
    ----------
    path : str or path-like
    faces : (n, k) array_like of int, list of lists, or tuple (indices, offsets)
    points : (n, 3) or (n, 2) array_like of float
    edges : (n, 2) array_like of int, optional
        Edges without faces.
    vertex, halfedge, edge, face : mapping of str to array_like, optional
        Attributes: a row for each vertex, corner, row of `edges`, and face. ``color normal texcoord`` are understood,
        in OBJ also the integer labels ``group object material smoothing`` of faces, in the files of Triangle
        ``marker`` and ``attributes``.
    meta : mapping, optional
        The names behind labels, as in :class:`MeshData`.

    Raises
    ------
    InvalidMeshError
        The arrays have wrong shapes or types, or an index is out of range.
    FormatError
        The suffix is unknown, or the format can't hold the data.
    OSError
        What the system refuses.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "square.obj"
    >>> points = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> write(path, [[0, 1, 2, 3]], points, face={"group": [0]}, meta={"groups": ["a"]})
    >>> print(path.read_text(), end="")
    v 0 0 0
    v 1 0 0
    v 1 1 0
    v 0 1 0
    g a
    f 1 2 3 4
    """
    from halfmesh.io.arrays import as_data

    _write(as_data(faces, points, edges, vertex, halfedge, edge, face, meta), path)


def _write(data: MeshData, path: Path) -> None:
    from halfmesh._files import replace_files
    from halfmesh.io.triangle_files import companion

    name, format = os.fspath(path), format_of(path)
    others = ((companion(name, suffix), FORMATS[suffix]) for suffix in format.beside)
    replace_files((each, form.write(data, each)) for each, form in ((name, format), *others))
