"""Compact meshes from symbols: any two balanced sequences, mixed in whatever way, are one (Mullin's bijection)."""

from __future__ import annotations

import numpy as np

from halfmesh.compact.directory import add_directory, n_words
from halfmesh.compact.topology import Arrays, CompactTopology

TREE, DUAL = "()", "[]"


def from_text(text):
    """The closed mesh with this tour: ``()`` are tree edges, ``[]`` the others; `;` parts the components."""
    parts = text.split(";")
    symbols = np.array(["()[]".index(c) for c in "".join(parts)], np.int64)
    return from_symbols(symbols < 2, symbols % 2 == 0, np.cumsum([0, *map(len, parts)]))


def from_symbols(tree, opens, starts=None):
    """The closed mesh whose halfedges are these symbols."""
    n = len(tree)
    a = Arrays()
    as_bytes = np.full(8 * n_words(n), 255, np.uint8)
    bits = np.ones((2, 4 * len(as_bytes)), np.int64)
    bits[0, :n], bits[1, :n] = tree, opens
    as_bytes[:] = (bits[0].reshape(-1, 4) << [0, 1, 2, 3]).sum(1) | (bits[1].reshape(-1, 4) << [4, 5, 6, 7]).sum(1)
    a.bits = as_bytes.view("<i8").astype(np.int64)
    a.starts = np.array([0, n] if starts is None else starts, np.int32)
    a.holes = a.gap_vertices = a.gap_halfedges = np.empty(0, np.int32)
    n_components = len(a.starts) - 1
    n_opens = int((tree & opens).sum())
    a.sizes = np.array([n, n_components, 0, 0], np.int64)
    a.counts = np.zeros(13, np.int64)
    a.counts[:3] = n_opens + n_components, n // 2, n // 2 - n_opens + n_components
    add_directory(a, n, (n_opens, n // 2 - n_opens))
    return CompactTopology(a)


def random_symbols(rng, n_edges, share_of_tree=0.5, depth=1.0):
    """A random tour; `depth` from 0 to 1 from flat to as deep as it can be."""
    n_tree = round(n_edges * share_of_tree)
    tree = np.zeros(2 * n_edges, bool)
    tree[rng.permutation(2 * n_edges)[: 2 * n_tree]] = True
    opens = np.empty(2 * n_edges, bool)
    for of_kind, n in ((tree, n_tree), (~tree, n_edges - n_tree)):
        opens[of_kind] = balanced(rng, n, depth)
    return tree, opens


def balanced(rng, n, depth):
    """A random balanced sequence of `n` pairs."""
    if depth == 1:
        return np.arange(2 * n) < n
    steps = np.where(rng.permutation(2 * n) < n, 1, -1)
    lowest = int(np.argmin(np.cumsum(steps))) + 1 if n else 0
    return np.roll(steps, -lowest) > 0  # the cycle lemma: from its lowest point on a sequence is balanced


def partners(tree, opens):
    """By a stack for each kind: the partner of every symbol, and what is open of each kind before it (-1: nothing)."""
    stacks, partner, enclosing = ([], []), np.empty(len(tree), np.int64), np.full((2, len(tree)), -1)
    for i, (is_tree, is_open) in enumerate(zip(tree, opens, strict=True)):
        for kind in range(2):
            if stacks[kind]:
                enclosing[kind, i] = stacks[kind][-1]
        stack = stacks[1 - is_tree]
        if is_open:
            stack.append(i)
        else:
            partner[i] = stack.pop()
            partner[partner[i]] = i
    return partner, enclosing
