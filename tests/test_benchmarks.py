"""The benchmarks themselves: what changes a mesh gets a fresh one, and does what it says."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import halfmesh as hm
from benchmarks.data import make
from benchmarks.operators import FLIP, SPLIT
from benchmarks.polylla import beside_each_other, n_not_simple
from benchmarks.timing import QUICK, Way, race

hm_peer: Any = pytest.importorskip("benchmarks.compare.halfmesh").peer
SPHERE = make("sphere-1")  # 42 vertices, 120 edges, 80 faces


def results(ways: dict[str, Way]) -> list[dict[str, float]]:
    return [way.facts(way.run(*([way.fresh()] if way.fresh else []))) for way in ways.values()]


def test_every_call_gets_a_fresh_state() -> None:
    lengths: list[int] = []

    def use_up(state: list[int]) -> None:
        lengths.append(len(state))
        state.clear()

    race({"way": Way(use_up, fresh=lambda: [1, 2, 3])}, QUICK, 1)
    assert len(lengths) >= 2  # a busy machine gets fewer rounds
    assert set(lengths) == {3}


@pytest.mark.parametrize(
    ("kind", "operations", "vertices", "faces"),
    [("split_edge", 120, 42 + 120, 80 + 2 * 120), ("split_face", 80, 42 + 80, 3 * 80), ("collapse", 80, 42, 80)],
)
def test_edits_do_what_they_say(kind: str, operations: int, vertices: int, faces: int) -> None:
    for facts in results(hm_peer.edits(SPHERE, kind)):
        assert facts == {"operations": operations, "vertices": vertices, "faces": faces}


def test_ways_to_flip_agree() -> None:
    first, *others = results(hm_peer.edits(SPHERE, "flip"))
    assert 0 < first["operations"] <= 120
    assert others == [first] * len(others)


def test_operators_in_a_kernel_come_back_to_where_they_began() -> None:
    split, flip = results(hm_peer.operators(SPHERE))
    assert split == {"collapses": 80, "vertices": 42, "faces": 80}
    assert 0 < flip["flips"] <= 24
    assert list(hm_peer.operators(SPHERE)) == [SPLIT, FLIP]


def test_polygons_are_counted_and_looked_at() -> None:
    (facts,) = results(hm_peer.polylla(SPHERE))
    assert facts["not simple"] == 0
    assert 0 < facts["polygons"] < 80
    assert n_not_simple(np.array([0, 1, 2, 0, 1, 2, 1, 0, 1]), np.array([0, 3, 7, 9])) == 2


def test_copies_are_components() -> None:
    assert hm.Mesh(*beside_each_other(SPHERE, 3)).n_connected_components == 3


def test_growing_gives_as_many_as_asked() -> None:
    grid = make("grid-11")
    assert [facts["vertices"] for facts in results(hm_peer.growth(grid, "add_vertex"))] == [11]
    assert {facts["faces"] for facts in results(hm_peer.growth(grid, "add_face"))} == {11}
