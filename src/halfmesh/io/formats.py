"""The table: which suffix is read and written by what. A new format is a reader, a writer and a row."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from typing import NamedTuple

from halfmesh.errors import FormatError
from halfmesh.io.ale_writing import ale_pieces, refuse_to_read_ale
from halfmesh.io.data import MeshData
from halfmesh.io.obj import read_obj
from halfmesh.io.obj_writing import obj_pieces
from halfmesh.io.off import read_off
from halfmesh.io.off_writing import off_pieces
from halfmesh.io.poly_files import read_poly
from halfmesh.io.source import Source
from halfmesh.io.triangle_files import read_ele, read_neigh, read_node
from halfmesh.io.triangle_writing import ele_pieces, neigh_pieces, node_pieces, poly_pieces

__all__ = ["FORMATS", "Format", "format_of"]


class Format(NamedTuple):
    """A file format.

    Attributes
    ----------
    name : str
    read : callable
        ``read(source) -> MeshData``.
    write : callable
        ``write(data, path)`` yields the bytes of the file, piece by piece.
    beside : tuple of str
        Suffixes of the files that are written with it: a mesh in this format is several files.
    """

    name: str
    read: Callable[[Source], MeshData]
    write: Callable[[MeshData, str], Iterator[bytes | memoryview]]
    beside: tuple[str, ...] = ()


FORMATS = {
    ".off": Format("OFF", read_off, off_pieces),
    ".obj": Format("Wavefront OBJ", read_obj, obj_pieces),
    ".ele": Format("Triangle's triangles", read_ele, ele_pieces, beside=(".node",)),
    ".node": Format("Triangle's points", read_node, node_pieces, beside=(".ele",)),
    ".neigh": Format("Triangle's neighbors", read_neigh, neigh_pieces, beside=(".node", ".ele")),
    ".poly": Format("Triangle's outline", read_poly, poly_pieces),
    ".ale": Format("VEM polygons, written only", refuse_to_read_ale, ale_pieces),
}


def format_of(path: str | os.PathLike[str]) -> Format:
    """The format that the suffix of `path` names, in capitals or not.

    Raises
    ------
    FormatError
        With the suffixes that are known.

    Examples
    --------
    >>> format_of("bunny.OFF").name
    'OFF'
    """
    suffix = os.path.splitext(os.fspath(path))[1]
    try:
        return FORMATS[suffix.lower()]
    except KeyError:
        known = ", ".join(f"{suffix} ({format.name})" for suffix, format in FORMATS.items())
        found = f"unknown suffix {suffix!r}" if suffix else "no suffix says which format this is"
        raise FormatError(f"{found}; known are {known}", path=path) from None
