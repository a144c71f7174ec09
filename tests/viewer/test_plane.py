"""The plane geometry of the pictures: screen coordinates, y downwards."""

from __future__ import annotations

import math

import numpy as np
import pytest

from halfmesh.viewer.plane import Box, arc, inside, left, sampled, turn

EAST, NORTH, WEST, SOUTH = 1 + 0j, -1j, -1 + 0j, 1j


def test_left_of_east_is_north_on_the_screen() -> None:
    assert left(EAST) == NORTH


@pytest.mark.parametrize(
    ("end", "angle"), [(NORTH, 0.25), (WEST, 0.5), (SOUTH, 0.75), (EAST, 1.0)], ids=["quarter", "half", "three", "full"]
)
def test_turns_are_counter_clockwise_and_a_full_one_is_not_nothing(end: complex, angle: float) -> None:
    assert turn(EAST, end) == pytest.approx(angle * math.tau)


def test_an_arc_keeps_its_radius_and_turns_clockwise() -> None:
    pieces = arc(0j, NORTH, math.pi / 2)
    assert pieces[-1][2] == pytest.approx(EAST)
    assert [abs(z) for z in sampled(NORTH, pieces)] == pytest.approx([1.0] * 9, abs=1e-3)


@pytest.mark.parametrize(
    ("segment", "hit"),
    [((-9, 0, 9, 0), 1), ((-9, 3, 9, 3), 0), ((0, 0, 0.1, 0), 1), ((3, -9, 3, 9), 0), ((1, -9, 9, 3), 0)],
    ids=["through", "above", "within", "beside", "around_the_corner"],
)
def test_a_box_is_hit_by_what_enters_it(segment: tuple[float, ...], hit: int) -> None:
    assert Box(0j, 2.0, 1.0).hits(np.array([segment], dtype=np.float64)) == hit


def test_boxes_side_by_side_do_not_overlap() -> None:
    assert not Box(0j, 1.0, 1.0).overlaps(Box(2 + 0j, 1.0, 1.0))
    assert Box(0j, 1.0, 1.0).overlaps(Box(2 + 0j, 1.0, 1.0), gap=0.1)


def test_a_notch_is_outside_of_its_polygon() -> None:
    notched = [0j, 4 + 0j, 4 + 4j, 2 + 1j, 4j]
    assert inside(1 + 1j, notched)
    assert not inside(2 + 3j, notched)
