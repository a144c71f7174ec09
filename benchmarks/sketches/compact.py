"""The compact mesh: bits for each edge, time to make it, time of each rule; and what a depth-first tree would cost.

``python -m benchmarks.sketches.compact [vertices of a random triangulation of the plane, 1,000,000]``
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import halfmesh as hm
from halfmesh.compact import encoding
from halfmesh.compact.encoding import compacted
from halfmesh.compact.planting import TREE_EDGE, has_bit, put_bit
from halfmesh.core import navigation
from halfmesh.core.navigation import cw_of, edge_of, next_of, origin_of, target_of, twin_of

CALLS = 500_000
ON = {"halfedge_of_vertex": "n_vertices", "halfedge_of_face": "n_faces", "halfedge_of_edge": "n_edges"}
RULES = (
    "twin_of", "next_of", "prev_of", "ccw_of", "cw_of", "origin_of", "target_of", "face_of", "opposite_face_of",
    "edge_of", "is_exterior", "halfedge_of_vertex", "halfedge_of_face", "halfedge_of_edge",
)  # fmt: skip


def main() -> None:
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    side = max(3, round(n**0.5))
    for order, faces in (("coherent", triangulation(side)), ("shuffled", shuffled(triangulation(side)))):
        mesh = hm.Mesh(faces, n_vertices=side * side)
        print(f"{mesh!r}, {order}")
        seconds = best(lambda t: compacted(t), mesh.topology, runs=3)
        made = compacted(mesh.topology).topology
        print(f"  made in {1e6 * seconds / mesh.n_edges:.3f} us an edge; {made.bits_per_edge:.2f} bits an edge")
        if order == "coherent":
            table(made, mesh.topology)
            trees(mesh)


def triangulation(side: int) -> Any:
    """The plane in squares, each cut along one of its diagonals at random."""
    i = np.arange(side - 1)
    a = (side * i[:, None] + i).ravel()
    b, c, d = a + 1, a + side + 1, a + side
    one = np.stack([np.stack([a, b, c], 1), np.stack([a, c, d], 1)], 1)
    other = np.stack([np.stack([a, b, d], 1), np.stack([b, c, d], 1)], 1)
    choice = np.random.default_rng(0).random(len(a)) < 0.5
    return np.where(choice[:, None, None], one, other).reshape(-1, 3).astype(np.int32)


def shuffled(faces: Any) -> Any:
    rng = np.random.default_rng(1)
    return rng.permutation(faces.max() + 1).astype(np.int32)[faces[rng.permutation(len(faces))]]


def table(made: Any, t: Any) -> None:
    print("  ns, in a kernel:        random   one after the other   random in columns")
    rng = np.random.default_rng(2)
    for name in RULES:
        n = getattr(made, ON.get(name, "n_halfedges"))
        scattered, in_order = rng.integers(0, n, CALLS), np.arange(CALLS) % n
        ask = asked(getattr(navigation, name))
        figures = [1e9 * best(ask, x, i) / CALLS for x, i in ((made, scattered), (made, in_order), (t, scattered))]
        print(f"  {name:20}{figures[0]:10.1f}{figures[1]:14.1f}{figures[2]:18.1f}")


def asked(rule: Any) -> Any:
    @hm.kernel
    def ask(t: Any, elements: Any) -> int:
        total = 0
        for i in range(len(elements)):
            total += rule(t, elements[i])
        return total

    return ask


def best(run: Callable[..., Any], *arguments: Any, runs: int = 12) -> float:
    run(*arguments)
    times = []
    for _ in range(runs):
        started = time.perf_counter()
        run(*arguments)
        times.append(time.perf_counter() - started)
    return min(times)


# -- another tree ------------------------------------------------------------------------------------------------------


def trees(mesh: hm.Mesh) -> None:
    print("  tree            us an edge   twin, ns   same word, block, superblock, %")
    breadth_first = encoding._plant_trees
    for name, plant in (("breadth first", breadth_first), ("depth first", plant_depth_first)):
        encoding._plant_trees = plant  # type: ignore[assignment]
        seconds = best(lambda t: compacted(t), mesh.topology, runs=3)
        made = compacted(mesh.topology).topology
        h = np.random.default_rng(3).integers(0, made.n_halfedges, CALLS)
        twin = twin_of(made, h)
        near = [100 * np.mean(h >> bits == twin >> bits) for bits in (5, 8, 12)]
        nanoseconds = 1e9 * best(asked(twin_of), made, h) / CALLS
        shares = " ".join(f"{share:.0f}" for share in near)
        print(f"  {name:16}{1e6 * seconds / mesh.n_edges:8.3f}{nanoseconds:12.1f}   {shares}")
    encoding._plant_trees = breadth_first


def plant_depth_first(t: Any, states: Any, touches: Any, late: Any, n_vertices: int) -> Any:
    """Of a mesh of one component with a boundary."""
    root = int(np.flatnonzero(t.face < 0)[0])
    take_depth_first(t, root, np.zeros_like(late), np.zeros_like(states), states)
    starts, nodes = np.array([0, len(t.next)], np.int32), np.array([0, n_vertices - 1], np.int32)
    return encoding._Forest(np.array([root], np.int32), starts, nodes, 1)


@hm.kernel
def take_depth_first(t: Any, root: int, seen: Any, met: Any, states: Any) -> None:
    """The edges that lead to a vertex that the tour along them has not seen."""
    put_bit(seen, origin_of(t, root))
    h = root
    while True:
        e = edge_of(t, h)
        shift = 4 * (e & 1)
        if (met[e >> 1] >> shift) & 1 == 0:
            met[e >> 1] |= 1 << shift
            if not has_bit(seen, target_of(t, h)):
                put_bit(seen, target_of(t, h))
                states[e >> 1] |= TREE_EDGE << shift
        h = next_of(t, h) if (states[e >> 1] >> shift) & TREE_EDGE else cw_of(t, h)
        if h == root:
            break


if __name__ == "__main__":
    main()
