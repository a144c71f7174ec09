"""One text, three representations: a pass over all rings of an icosphere of 327,680 triangles.

``python -m benchmarks.sketches.bound``
"""

from __future__ import annotations

import timeit
from typing import Any

import numpy as np

import halfmesh as hm


@hm.kernel
def sums(t: Any, points: Any, out: Any) -> None:
    for v in range(len(out)):
        total = 0.0
        for u in hm.neighbors(t, v):
            total += points[u, 0]
        out[v] = total


def main() -> None:
    mesh = hm.shapes.icosphere(7)
    for form in (mesh, hm.TriangleMesh(mesh), hm.CompactMesh(mesh)):
        out = np.zeros(form.n_vertices)
        sums(form, form.points, out)
        best = min(timeit.repeat(lambda form=form, out=out: sums(form, form.points, out), number=1, repeat=10))
        print(
            f"{type(form).__name__:14}{1e3 * best:8.1f} ms{form.topology.nbytes / form.n_faces:8.1f} bytes a triangle"
        )


if __name__ == "__main__":
    main()
