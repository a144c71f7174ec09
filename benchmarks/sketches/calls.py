"""Where the time of one operator called from plain Python goes: ``python -m benchmarks.sketches.calls``."""

from __future__ import annotations

import timeit
from typing import Any

import halfmesh as hm
from benchmarks.compare.halfmesh_loops import flip_every_fifth
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
        ("an empty handle, object.__new__(Vertex)", lambda: object.__new__(hm.Vertex)),
        ("an empty handle, as they are made", lambda: hm.Vertex._empty()),
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


def in_a_kernel() -> None:
    best = 1e9
    for _ in range(4):
        mesh = hm.shapes.icosphere(7)
        started = timeit.default_timer()
        n = flip_every_fifth(mesh)
        best = min(best, (timeit.default_timer() - started) / n)
    print(f"{'a flip asked and done in a kernel':45}{1e9 * best:6.0f} ns")


def nanoseconds(call: Any) -> float:
    return 1e9 * min(timeit.repeat(call, number=CALLS, repeat=5)) / CALLS


if __name__ == "__main__":
    main()
