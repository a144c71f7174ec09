"""A boundary walk: the length of the rim of a mesh, hole by hole."""

from __future__ import annotations

import math

import numpy as np

import halfmesh as hm
from halfmesh import halfedge_slots, is_exterior, loop, origin_of, target_of


@hm.kernel
def rim_lengths(t, points, seen, lengths):
    n = 0
    for start in range(halfedge_slots(t)):
        if seen[start] == 1 or not is_exterior(t, start):
            continue
        length = 0.0
        for h in loop(t, start):
            seen[h] = 1
            a = origin_of(t, h)
            b = target_of(t, h)
            dx = points[b, 0] - points[a, 0]
            dy = points[b, 1] - points[a, 1]
            dz = points[b, 2] - points[a, 2]
            length += math.sqrt(dx * dx + dy * dy + dz * dz)
        lengths[n] = length
        n += 1
    return n


def main() -> None:
    mesh = hm.shapes.cylinder()
    seen = np.zeros(mesh.n_halfedges, dtype=np.uint8)
    lengths = np.empty(mesh.n_boundary_loops)
    n = rim_lengths(mesh, mesh.points, seen, lengths)
    print(f"{n} rims of lengths {np.round(lengths, 3)}")
    assert n == 2
    assert np.all(np.abs(lengths - 2 * math.pi) < 0.5)


if __name__ == "__main__":
    main()
