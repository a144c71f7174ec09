"""The arrays of a compact mesh, and the class that holds them."""

from __future__ import annotations

import os
import weakref
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh import _jit
from halfmesh.compact.carrier import ReadOnly
from halfmesh.core.topology import EDGE_SLOTS, FACE_SLOTS, VERTEX_SLOTS

__all__ = [
    "FIELDS",
    "N_COMPONENTS",
    "N_ISOLATED",
    "N_OPEN",
    "N_SYMBOLS",
    "STORED",
    "Arrays",
    "CompactTopology",
]

# places in `sizes`
N_SYMBOLS = 0  # as many as halfedges
N_COMPONENTS = 1  # that have edges
N_OPEN = 2  # the first so many of them have a boundary, and begin along it
N_ISOLATED = 3  # vertices; they come last

STORED = (
    "bits", "records", "supers", "minima", "samples", "starts", "holes", "gap_vertices", "gap_halfedges",
)  # fmt: skip
FIELDS = (*STORED, "levels", "sample_starts", "sizes", "counts")
CARRIER = _jit.declare_carrier("CompactTopology", FIELDS)


class Views(_jit.Views):
    """The arrays as memoryviews, on which the rules mean those of `navigation`."""

    carrier: Any  # gives the topology, whose views these are
    sizes: Any

    def __init__(self) -> None:
        self.entries: dict[Any, Any] = {}  # compiled code, for the types that this carrier has

    def ask(self, rule: Any, index: int) -> Any:
        """The answer of a rule for one element: compiled in 0.3 us and more, where interpreting it takes 20."""
        topology = self.carrier()
        if topology is None:  # its mesh is gone, and the handle walks on with what it holds
            return super().ask(rule, index)
        entry = self.entries.get(rule)
        if entry is not None:
            return entry(topology.__compiled__(), index)
        operation = _jit.asking(rule)
        answer = operation.at(self.sizes[N_SYMBOLS])(topology, index)
        if "compiled" in operation.__dict__:
            self.entries[rule] = operation.entry(topology.__compiled__(), index)
        return answer


class Arrays:
    """The arrays of `parentheses`, and those that say what the numbers of vertices and faces are.

    ``starts`` has the first halfedge of every component, and one more; ``holes`` the nodes of the dual trees that
    are boundary loops and not roots, ascending; ``gap_vertices`` the vertices whose exterior halfedge is not the one
    after their opening parenthesis, ascending, and ``gap_halfedges`` which it is.
    """

    __slots__ = FIELDS

    bits: NDArray[np.int64]
    records: NDArray[np.int64]
    supers: NDArray[np.int32]
    minima: NDArray[np.int32]
    samples: NDArray[np.int32]
    starts: NDArray[np.int32]
    holes: NDArray[np.int32]
    gap_vertices: NDArray[np.int32]
    gap_halfedges: NDArray[np.int32]
    levels: NDArray[np.int64]
    sample_starts: NDArray[np.int64]
    sizes: NDArray[np.int64]
    counts: NDArray[np.int64]

    @property
    def nbytes(self) -> int:
        """Bytes of all arrays."""
        return sum(getattr(self, name).nbytes for name in FIELDS)


class CompactTopology(ReadOnly):
    """The connectivity of a mesh in less than five bits per edge, directories included; it can't be changed.

    Kernels take it as ``t``, like a :class:`~halfmesh.core.topology.Topology`: all rules and circulators have the
    same names. It is made by :func:`~halfmesh.compact.encoding.compacted`.
    """

    fields, carrier, views = FIELDS, CARRIER, Views

    def __init__(self, arrays: Arrays) -> None:
        self._arrays = arrays
        for name in FIELDS:
            getattr(arrays, name).flags.writeable = False
        super().__init__({name: getattr(arrays, name) for name in FIELDS})
        self._views.carrier = weakref.ref(self)  # type: ignore[attr-defined]

    @property
    def n_vertices(self) -> int:
        """The number of vertices, isolated ones included."""
        return int(self._arrays.counts[VERTEX_SLOTS])

    @property
    def n_halfedges(self) -> int:
        """The number of halfedges, two for each edge."""
        return 2 * self.n_edges

    @property
    def n_edges(self) -> int:
        """The number of edges."""
        return int(self._arrays.counts[EDGE_SLOTS])

    @property
    def n_faces(self) -> int:
        """The number of faces."""
        return int(self._arrays.counts[FACE_SLOTS])

    @property
    def bits_per_edge(self) -> float:
        """All that is held, by edges; Turan's bound for the symbols alone is 4."""
        return 8 * self.nbytes / max(1, self.n_edges)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file of its own format, see `files`; the file is there whole or not at all."""
        from halfmesh.compact.files import write

        write(path, self)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> CompactTopology:
        """Map a file into memory and check it, see `files`.

        Raises
        ------
        FormatError
            If it is not a compact mesh, whole and undamaged.
        """
        from halfmesh.compact.files import read

        return read(path)[0]

    def __arrays__(self) -> Any:
        return self._arrays

    def __setstate__(self, state: dict[str, Any]) -> None:
        arrays = Arrays()
        for name in FIELDS:
            setattr(arrays, name, state["arrays"][name])
        self.__init__(arrays)  # type: ignore[misc]
