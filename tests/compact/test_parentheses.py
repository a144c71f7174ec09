"""Matching, counting and finding parentheses, against a stack; within words and across all borders."""

from __future__ import annotations

import numpy as np
import pytest
from mullin import from_symbols, from_text, partners, random_symbols

from halfmesh._jit import kernel
from halfmesh.compact import parentheses, words


@kernel
def ask(t, match, opening, before, depth):
    for i in range(len(match)):
        match[i] = parentheses.match(t, i)
        for kind in range(2):
            opening[kind, i] = parentheses.opening(t, i, kind)
            before[kind, i] = parentheses.opens_before(t, i, kind)
            depth[kind, i] = parentheses.depth_at(t, i, kind)
        before[2, i] = parentheses.openings_before(t, i)


@kernel
def find(t, kind, place):
    for n in range(len(place)):
        place[n] = parentheses.select(t, n, kind)


def assert_right(tree, opens):
    t, n = from_symbols(tree, opens), len(tree)
    match, opening, before, depth = (np.empty(s, np.int64) for s in (n, (2, n), (3, n), (2, n)))
    ask.at(n)(t, match, opening, before, depth)
    partner, enclosing = partners(tree, opens)
    assert np.array_equal(match, partner)
    assert np.array_equal(opening, enclosing)
    for kind, members in enumerate((tree, ~tree, np.ones(n, bool))):
        counted = np.cumsum(members & opens) - (members & opens)
        assert np.array_equal(before[kind], counted)
        place = np.empty(int((members & opens).sum()), np.int64)
        find.at(len(place))(t, kind, place)
        assert np.array_equal(place, np.flatnonzero(members & opens))
    steps = np.where(opens, 1, -1)
    for kind, members in enumerate((tree, ~tree)):
        assert np.array_equal(depth[kind], np.cumsum(steps * members) - steps * members)


def test_the_two_kinds_do_not_see_each_other():
    t = from_text("([)]")
    assert [parentheses.match(t, i) for i in range(4)] == [2, 3, 0, 1]


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("n_edges", [1, 15, 16, 17, 64, 127, 128, 129, 700])
def test_random_tours_in_and_around_a_block(n_edges, share):
    assert_right(*random_symbols(np.random.default_rng(n_edges), n_edges, share, depth=0.5))


@pytest.mark.large
@pytest.mark.parametrize(
    ("n_edges", "share"),
    [(n, share) for n in (2047, 2048, 2049, 33_000) for share in (0.0, 0.1, 0.9, 1.0)] + [(600_000, 1 / 3)],
)
def test_random_tours_across_superblocks_and_levels(n_edges, share):
    assert_right(*random_symbols(np.random.default_rng(n_edges), n_edges, share, depth=0.5))


@pytest.mark.large
def test_as_deep_as_can_be():
    assert_right(*random_symbols(np.random.default_rng(0), 1_000_000, 0.5, depth=1))


@pytest.mark.large
@pytest.mark.parametrize("kind", [True, False])
def test_one_pair_around_all(kind):
    """A pair that is as wide as the mesh, around flat ones of both kinds: every level is climbed."""
    rng = np.random.default_rng(1)
    tree, opens = random_symbols(rng, 700_000, 0.5, depth=0.5)
    assert_right(np.array([kind, *tree, kind]), np.array([True, *opens, False]))


def test_fall_and_rise_in_a_word_as_step_by_step():
    """Every depth that is asked for, in random words of one kind or two."""
    rng = np.random.default_rng(2)
    for _ in range(200):
        present = rng.random(32) < rng.random()
        rises = present & (rng.random(32) < rng.random())
        falls = present & ~rises
        bits = [sum(1 << words.bit_of(i) for i in range(32) if of[i]) for of in (falls, rises)]
        depths = np.cumsum(rises.astype(int) - falls)
        back = np.cumsum((rises.astype(int) - falls)[::-1])[::-1]
        for depth in (1, 2, 3, 7, 20, 32):
            low, high = np.flatnonzero(depths <= -depth), np.flatnonzero(back <= -depth)
            assert words.falling(*bits, depth) == (words.bit_of(int(low[0])) if len(low) else -1)
            assert words.rising(*bits, depth) == (words.bit_of(int(high[-1])) if len(high) else -1)


def test_bits_and_symbols_are_inverse():
    assert [words.symbol_of(words.bit_of(i)) for i in range(32)] == list(range(32))


def test_nth_bit():
    bits = 0b1001_0000_1100 << 30
    assert [words.nth_bit(bits, n) for n in range(4)] == [32, 33, 38, 41]
