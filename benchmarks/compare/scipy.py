"""SciPy: what sparse matrices alone give."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, summed, triangles


class SciPy(Peer):
    name = "scipy"
    module = "scipy.sparse"

    def builds(self, surface: Surface) -> Ways:
        note = "matrix of vertex neighbors only"
        return {"csr_array": Way(lambda: adjacency(surface), note, facts=lambda matrix: {"edges": matrix.nnz // 2})}

    def rings(self, surface: Surface) -> Ways:
        matrix = adjacency(surface)

        def means() -> Array:
            means: Array = (matrix @ surface.points) / np.diff(matrix.indptr)[:, None]
            return means

        return {"matrix product": Way(means, "sums and means only, no loop of one's own", facts=summed)}


def adjacency(surface: Surface) -> csr_array:
    faces = triangles(surface)
    rows, columns = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    n = len(surface.points)
    one_way = csr_array((np.ones(len(rows), np.int8), (rows, columns)), shape=(n, n))
    return ((one_way + one_way.T) > 0).astype(float)


peer = SciPy()
