"""The small mesh of the explaining figure: a pentagon, two quads and a triangle around two interior vertices.

Plain lists, so that anything that takes faces and points can use them. Halfedge 0 runs between the two interior
vertices, with the pentagon on its left: everything it is linked to lies inside the patch.
"""

from __future__ import annotations

from typing import Final

__all__ = ["FIGURE_FACES", "FIGURE_POINTS"]

FIGURE_FACES: Final[list[list[int]]] = [
    [0, 1, 2, 3, 4],
    [1, 0, 6, 7],
    [0, 4, 5, 6],
    [1, 7, 2],
]
"""Vertex indices of the four faces, counter-clockwise."""

FIGURE_POINTS: Final[list[list[float]]] = [
    [2.60, 1.90],
    [4.95, 2.05],
    [6.70, 3.75],
    [4.10, 4.45],
    [1.55, 3.95],
    [0.00, 2.10],
    [1.45, 0.15],
    [6.45, 0.00],
]
"""x and y of the eight vertices."""
