"""Ten million random points, from the triangulation on: Polylla, the compact mesh, Polylla on that; and peak memory.

``python -m benchmarks.sketches.large [points, 10,000,000]``
"""

from __future__ import annotations

import resource
import sys
from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np

import halfmesh as hm


def main() -> None:
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000_000
    warm_up()
    small, report = meshes(np.random.default_rng(1).random((n, 2)))
    _, again = told("hm.polylla on it", lambda: hm.polylla(small, report=True), small.n_faces)
    print("the same counts:", (again.n_polygons, again.n_tips) == (report.n_polygons, report.n_tips))
    told("to_mesh", small.to_mesh, small.n_faces)


def meshes(points: Any) -> tuple[hm.CompactMesh, hm.PolyllaReport]:
    """All that needs the mesh, which is gone afterwards."""
    mesh = told("hm.delaunay", lambda: hm.delaunay(points), len(points))
    told("hm.Mesh", lambda: hm.Mesh(mesh.triangles(), mesh.points), mesh.n_faces)
    _, report = told("hm.polylla", lambda: hm.polylla(mesh, report=True), mesh.n_faces)
    print(report)
    small = told("hm.CompactMesh", lambda: hm.CompactMesh(mesh), mesh.n_edges)
    print(f"{small.bits_per_edge:.2f} bits an edge")
    return small, report


def warm_up() -> None:
    """Compile everything on a mesh that is not worth compiling for."""
    mesh = hm.delaunay(np.random.default_rng(2).random((20_000, 2)))
    for form in (mesh, hm.CompactMesh(mesh)):
        hm.polylla(form)
    hm.CompactMesh(mesh).to_mesh()


def told(what: str, run: Callable[[], Any], items: int) -> Any:
    started = perf_counter()
    made = run()
    seconds = perf_counter() - started
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    print(f"{what:20}{seconds:8.2f} s {1e9 * seconds / items:8.0f} ns each; peak so far {peak:.2f} GB", flush=True)
    return made


if __name__ == "__main__":
    main()
