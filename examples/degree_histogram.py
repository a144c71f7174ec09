"""Vertices counted by degree: how regular is a mesh?"""

from __future__ import annotations

import numpy as np

import halfmesh as hm
from halfmesh import outgoing, vertex_slots


@hm.kernel
def count_by_degree(t, counts):
    for v in range(vertex_slots(t)):
        degree = 0
        for _h in outgoing(t, v):
            degree += 1
        counts[min(degree, len(counts) - 1)] += 1


def main() -> None:
    mesh = hm.shapes.icosphere(3)
    counts = np.zeros(10, dtype=np.int64)
    count_by_degree(mesh, counts)
    for degree in np.flatnonzero(counts):
        print(f"degree {degree}: {counts[degree]} vertices")
    assert counts[5] == 12  # the corners of the icosahedron
    assert counts[6] == mesh.n_vertices - 12


if __name__ == "__main__":
    main()
