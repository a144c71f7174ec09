"""Where the time of one operator called from plain Python goes: ``python -m benchmarks.sketches.calls``."""

from __future__ import annotations

import timeit
from typing import Any

import halfmesh as hm
from halfmesh._jit import compiling_always
from halfmesh.core.operators.flips import flip_status

CALLS = 200_000


def main() -> None:
    with compiling_always():
        mesh = hm.shapes.tetrahedron()  # on which every flip and collapse is refused: nothing changes
        mesh.add_vertex(), mesh.try_flip(0), mesh.can_flip(0), mesh.try_collapse(0)
    carrier, e, v = mesh.topology.__compiled__(), mesh.edges[0], mesh.vertices[0]
    in_python = type(mesh).can_flip
    for what, call in (
        ("an empty call, which all of these contain", lambda: None),
        ("an operation, as Numba calls it", lambda: flip_status.quick(carrier, 0, False)),
        ("the method in plain Python around it", lambda: in_python(mesh, e)),
        ("the native that does the same", lambda: mesh.can_flip(e)),
        ("a handle made in plain Python", lambda: mesh._made(hm.Vertex, 0)),
        ("a collapse, refused", lambda: mesh.try_collapse(0)),
        ("a step, v.halfedge", lambda: v.halfedge),
    ):
        print(f"{what:45}{nanoseconds(call):6.0f} ns")
    print(f"{'a native that makes a vertex and its handle':45}{growing():6.0f} ns")
    in_a_kernel()


def growing() -> float:
    """With the doubling of the columns that comes with it."""
    mesh = hm.shapes.tetrahedron()
    mesh.add_vertex()
    add = mesh.add_vertex
    return 1e9 * timeit.timeit(lambda: add(), number=CALLS) / CALLS


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
