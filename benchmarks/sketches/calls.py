"""Where the time of one operator called from plain Python goes: ``python -m benchmarks.sketches.calls``."""

from __future__ import annotations

import timeit
from typing import Any

import halfmesh as hm
from halfmesh.core.operators.collapses import try_collapse
from halfmesh.mesh.editing.placing import collapse_at

CALLS = 200_000


def main() -> None:
    worn = hm.shapes.icosphere(3)
    for f in range(1000):
        worn.split_face(f)
    for v in range(642, worn.n_vertices):  # until all is compiled, and its shortest way is known
        worn.try_collapse(worn.vertices[v].halfedge)
    mesh = hm.shapes.tetrahedron()  # on which every collapse is refused: nothing changes
    mesh.try_collapse(0)
    carrier, points = mesh.topology.__compiled__(), mesh.vertex_data.column("points").__compiled__()
    told = carrier, points, True, False, 0.0, 0.0, 0.0
    h = mesh.halfedges[0]
    for what, call in (
        ("the operator, refusing", lambda: try_collapse.quick(carrier, 0, 1.0)),
        ("with the points and the place", lambda: collapse_at.quick(*told, 0, 1.0)),
        ("with the way to it", lambda: mesh._act_at(try_collapse, collapse_at, 0, 1.0, None)),
        ("the method", lambda: mesh.try_collapse(h)),
        ("a handle made", lambda: mesh._made(hm.Vertex, 0)),
        ("an empty call, which all of these contain", lambda: None),
    ):
        print(f"{what:45}{nanoseconds(call):6.0f} ns")
    in_a_kernel()


@hm.kernel
def collapse_from(t: Any, first: int) -> int:
    n = 0
    for v in range(first, hm.vertex_slots(t)):
        h = hm.halfedge_of_vertex(t, v)
        if hm.collapse_status(t, h) == 0:
            hm.collapse(t, h)
            n += 1
    return n


@hm.kernel
def split_all(t: Any) -> None:
    for f in range(hm.face_slots(t)):
        hm.split_face(t, f)


def in_a_kernel() -> None:
    best = 1e9
    for _ in range(4):
        mesh = hm.shapes.icosphere(7)
        n = mesh.n_vertices
        split_all(mesh)
        best = min(best, timeit.timeit(lambda m=mesh, n=n: collapse_from(m, n), number=1) / 327_680)
    print(f"{'asked and done in a kernel, 327,680 triangles':45}{1e9 * best:6.0f} ns")


def nanoseconds(call: Any) -> float:
    return 1e9 * min(timeit.repeat(call, number=CALLS, repeat=5)) / CALLS


if __name__ == "__main__":
    main()
