"""Breadth-first distance: how many edges is every vertex away from one of them?"""

from __future__ import annotations

import numpy as np

import halfmesh as hm
from halfmesh import neighbors


@hm.kernel
def distances(t, source, steps, queue):
    steps[source] = 0
    queue[0] = source
    head = 0
    tail = 1
    while head < tail:
        v = queue[head]
        head += 1
        for u in neighbors(t, v):
            if steps[u] < 0:
                steps[u] = steps[v] + 1
                queue[tail] = u
                tail += 1
    return tail


def main() -> None:
    mesh = hm.shapes.icosphere(3)
    steps = np.full(mesh.n_vertices, -1, dtype=np.int64)
    queue = np.empty(mesh.n_vertices, dtype=np.int64)
    reached = distances(mesh, 0, steps, queue)
    print(f"reached {reached} vertices, the farthest {steps.max()} edges away")
    assert reached == mesh.n_vertices
    pairs = mesh.edge_vertices()
    assert np.abs(steps[pairs[:, 0]] - steps[pairs[:, 1]]).max() == 1  # an edge is one step


if __name__ == "__main__":
    main()
