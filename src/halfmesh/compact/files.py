r"""Compact meshes in files of their own, which are mapped into memory and not read.

All numbers are little-endian. The file begins with

======  ====================================================================================================
bytes   what
======  ====================================================================================================
8       ``\x89HMC\r\n\x1a\n``: a file that was sent as text or cut to seven bits is known by it
4, 4    version (1), number of arrays
8 each  halfedges, components with edges, those with a boundary, isolated vertices, vertices, faces, exterior halfedges;
        then zeros up to byte 128
64      for each array: name (24 bytes), type ("<i4", "<i8", "<f8" ...; 8 bytes), rows, columns (0: it has one axis
        only), its first byte, and eight zeros
======  ====================================================================================================

Each array begins at a multiple of 64 bytes, and zeros follow it up to one. Which arrays a compact mesh has says
`topology`; others may stand in the same file, under names that begin with a dot.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._files import replace_file
from halfmesh.compact.checking import complaint
from halfmesh.compact.directory import level_starts, n_words, sample_starts
from halfmesh.compact.topology import N_COMPONENTS, N_ISOLATED, N_OPEN, N_SYMBOLS, STORED, Arrays, CompactTopology
from halfmesh.core.topology import EDGE_SLOTS, FACE_SLOTS, N_COUNTS, N_EXTERIOR, VERTEX_SLOTS
from halfmesh.errors import FormatError

__all__ = ["read", "write"]

MAGIC = b"\x89HMC\r\n\x1a\n"
VERSION = 1
HEADER, ROW, ALIGNMENT = 128, 64, 64
_LIMIT = 1000  # arrays
_FIGURES = np.dtype("<i8")
_ROW = np.dtype(
    [("name", "S24"), ("type", "S8"), ("rows", "<i8"), ("columns", "<i8"), ("offset", "<i8"), ("zero", "<i8")]
)
_TYPES = {"<i1", "|i1", "|u1", "|b1", "<i2", "<u2", "<i4", "<u4", "<i8", "<u8", "<f4", "<f8"}


def write(
    path: str | os.PathLike[str], compact: CompactTopology, others: Mapping[str, NDArray[Any]] | None = None
) -> None:
    """Write a compact mesh, and other arrays with it, so that the file is there whole or not at all.

    Raises
    ------
    OSError
        Whatever the system says.
    """
    a = compact.__arrays__()
    arrays = {name: getattr(a, name) for name in STORED} | {f".{k}": v for k, v in (others or {}).items()}
    replace_file(path, _pieces(a, {name: _little(array) for name, array in arrays.items()}))


def _little(array: NDArray[Any]) -> NDArray[Any]:
    little = np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<"))
    if little.dtype.str not in _TYPES or little.ndim not in (1, 2):
        raise TypeError(f"arrays of numbers with one or two axes can be written, not {array.dtype} of {array.shape}")
    return little


def _pieces(a: Any, arrays: dict[str, NDArray[Any]]) -> Iterator[bytes | memoryview]:
    counts, sizes = a.counts, a.sizes
    figures = [*sizes, counts[VERTEX_SLOTS], counts[FACE_SLOTS], counts[N_EXTERIOR]]
    head = MAGIC + np.array([VERSION, len(arrays)], "<u4").tobytes() + np.array(figures, _FIGURES).tobytes()
    table, at = np.zeros(len(arrays), _ROW), _aligned(HEADER + ROW * len(arrays))
    for row, (name, array) in zip(table, arrays.items(), strict=True):
        if len(name.encode()) > _ROW["name"].itemsize:
            raise ValueError(f"the name of the array {name[1:]!r} is longer than 23 bytes")
        columns = array.shape[1] if array.ndim > 1 else 0
        row["name"], row["type"], row["rows"], row["columns"] = name.encode(), array.dtype.str, len(array), columns
        row["offset"] = at
        at = _aligned(at + array.nbytes)
    yield head.ljust(HEADER, b"\0")
    yield table.tobytes().ljust(_aligned(HEADER + ROW * len(arrays)) - HEADER, b"\0")
    for array in arrays.values():
        yield array.tobytes() if array.nbytes < ALIGNMENT else array.data.cast("B")
        yield bytes(_aligned(array.nbytes) - array.nbytes)


def _aligned(n: int) -> int:
    return -(-n // ALIGNMENT) * ALIGNMENT


# -- reading -----------------------------------------------------------------------------------------------------------


def read(path: str | os.PathLike[str]) -> tuple[CompactTopology, dict[str, NDArray[Any]]]:
    """Map a file into memory, and check it: the compact mesh, and the other arrays by their names.

    Returns
    -------
    (CompactTopology, dict of str to ndarray)
        The file is to stay as it is while they are in use; what is written into the other arrays does not reach it.

    Raises
    ------
    FormatError
        If the file is not one that `write` has written, whole and undamaged as far as the mesh goes. What passes is a
        valid mesh, and no question about it can hang or break the process.
    OSError
        Whatever the system says.

    Notes
    -----
    O(n): the directory is made anew and compared with the one in the file.
    """
    place = os.fspath(path)
    memory = _mapped(place)
    if bytes(memory[:8]) != MAGIC:
        raise FormatError("this is not a compact mesh: it begins otherwise", path=place, offset=0)
    if len(memory) < HEADER:
        raise FormatError("the file ends within its header", path=place, offset=len(memory))
    version, n_arrays = memory[8:16].view("<u4").tolist()
    if version != VERSION:
        raise FormatError(f"version {version} of the format is not known, only {VERSION}", path=place, offset=8)
    if n_arrays > _LIMIT or HEADER + ROW * n_arrays > len(memory):
        raise FormatError(f"there is no room for a table of {n_arrays} arrays", path=place, offset=12)
    figures = memory[16:72].view(_FIGURES).tolist()
    arrays: dict[str, NDArray[Any]] = {}
    for k in range(n_arrays):
        at = HEADER + ROW * k
        name, array = _array(memory, memory[at : at + ROW].view(_ROW)[0], place, at)
        if name in arrays:
            raise FormatError(f"there are two arrays {name!r}", path=place, offset=at)
        arrays[name] = array
    compact = _checked(figures, arrays, place)
    return compact, {name[1:]: array for name, array in arrays.items() if name.startswith(".")}


def _mapped(place: str) -> NDArray[np.uint8]:
    size = os.stat(place).st_size
    if size == 0:
        return np.empty(0, np.uint8)
    return np.asarray(np.memmap(place, np.uint8, "c"))


def _array(memory: NDArray[np.uint8], row: Any, place: str, at: int) -> tuple[str, NDArray[Any]]:
    name, kind = row["name"].decode("utf-8", "replace"), row["type"].decode("ascii", "replace")
    if kind not in _TYPES:
        raise FormatError(f"array {name!r} has the type {kind!r}, which is not known", path=place, offset=at)
    dtype = np.dtype(kind)
    n, columns, offset = int(row["rows"]), int(row["columns"]), int(row["offset"])
    size = n * max(columns, 1) * dtype.itemsize
    if n < 0 or columns < 0 or offset < 0 or offset % ALIGNMENT or offset + _aligned(size) > len(memory):
        raise FormatError(
            f"array {name!r} of {n} rows does not lie within the {len(memory)} bytes of the file: it was cut short, or "
            "is damaged",
            path=place,
            offset=at,
        )
    array = memory[offset : offset + size].view(dtype)
    native = array.astype(dtype.newbyteorder("="), copy=False)
    return name, native.reshape(n, columns) if columns else native


def _checked(figures: list[int], arrays: dict[str, NDArray[Any]], place: str) -> CompactTopology:
    def expect(holds: bool, what: str) -> None:
        if not holds:
            raise FormatError(f"{what}; the file is damaged", path=place)

    n, n_components, n_open, n_isolated, n_vertices, n_faces, n_exterior = figures
    expect(all(0 <= x < 2**31 for x in figures) and n % 2 == 0 and n_open <= n_components <= n, "the figures are wrong")
    missing = [name for name in STORED if name not in arrays]
    expect(not missing, f"the arrays {', '.join(missing)} are missing")
    a = Arrays()
    for name in STORED:
        expected = np.int64 if name in ("bits", "records") else np.int32
        expect(arrays[name].dtype == expected and arrays[name].ndim == 1, f"array {name!r} has another type")
        setattr(a, name, arrays[name])
    expect(len(a.bits) == n_words(n) and len(a.starts) == n_components + 1, "the arrays are too long or too short")
    n_nodes = n_vertices - n_isolated - n_components
    n_dual_nodes = n_faces + n_open + len(a.holes) - n_components
    expect(n_nodes >= 0 and n_dual_nodes >= 0 and n_nodes + n_dual_nodes == n // 2, "the figures do not fit together")
    a.levels, a.sample_starts = level_starts(len(a.bits) // 8), sample_starts((n_nodes, n_dual_nodes))
    a.sizes = np.zeros(4, np.int64)
    for at, x in ((N_SYMBOLS, n), (N_COMPONENTS, n_components), (N_OPEN, n_open), (N_ISOLATED, n_isolated)):
        a.sizes[at] = x
    a.counts = np.zeros(N_COUNTS, np.int64)
    for at, x in ((VERTEX_SLOTS, n_vertices), (EDGE_SLOTS, n // 2), (FACE_SLOTS, n_faces), (N_EXTERIOR, n_exterior)):
        a.counts[at] = x
    wrong = complaint(a)
    expect(not wrong, wrong)
    return CompactTopology(a)
