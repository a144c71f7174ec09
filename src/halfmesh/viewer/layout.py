"""From a mesh to a laid-out picture: pure, and without a word of SVG."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from halfmesh.viewer.arrows import Arrows, draw_arrows, segments_of
from halfmesh.viewer.board import Label
from halfmesh.viewer.labels import Roles, place_labels, roles_of
from halfmesh.viewer.plane import Box
from halfmesh.viewer.style import FACE_FILLS, Measures
from halfmesh.viewer.wiring import Drawable, Wiring, chosen_halfedge, read_wiring

__all__ = ["Layout", "lay_out"]

_MARGIN = 26.0  # between the frame and whatever comes nearest to it


@dataclass(frozen=True)
class Layout:
    """Everything on its place, in pixels, y downwards.

    Attributes
    ----------
    wiring : Wiring
        The links of the mesh.
    place : list of complex
        The vertices on the screen.
    arrows : Arrows
        Half-arrows, bends, twin marks and edges.
    labels : list of Label
        All texts within the picture, with their boxes.
    roles : Roles
        What the highlighted halfedge makes of its surroundings.
    fills : dict of int to int
        For each face the number of its fill.
    size : Measures
        The measures that were used.
    height : float
        Where the picture ends; the legend comes below.
    highlight : int or None
        The halfedge that is explained.
    """

    wiring: Wiring
    place: list[complex]
    arrows: Arrows
    labels: list[Label]
    roles: Roles
    fills: dict[int, int]
    size: Measures
    height: float
    highlight: int | None


def lay_out(mesh: Drawable, *, width: float = 830.0, highlight: int | None = None, labels: bool = True) -> Layout:
    """Lay out the structure diagram of ``mesh``.

    Parameters
    ----------
    mesh
        Anything with ``points`` and ``topology``; x and y are used.
    width : float
        Width in pixels.
    highlight : int, optional
        The halfedge to explain; by default one that is well surrounded by faces.
    labels : bool
        Whether the elements show their numbers.

    Returns
    -------
    Layout
        Positions in pixels.

    Raises
    ------
    PreconditionError
        The mesh is too large to be labelled, or a point isn't finite.
    ElementError
        There is no halfedge ``highlight``.

    Notes
    -----
    O(n^2) in the number of elements, which is small by the precondition.
    """
    wiring = read_wiring(mesh)
    chosen = chosen_halfedge(wiring, highlight)
    roles = roles_of(wiring, chosen)
    scale = _scale(wiring, width)
    place, size = _placed(wiring, scale, width), _measures(wiring, scale, roles.face)
    for shrink in (1.0, 0.88, 0.77, 0.68, 0.6):  # until every label has found a free spot
        measures = size.scaled(shrink)
        arrows = draw_arrows(wiring, place, measures)
        texts = place_labels(wiring, place, arrows, roles, measures, width=width, numbers=labels)
        if all(text.free for text in texts):
            break
    top, bottom = _extent([text.box for text in texts], segments_of(arrows))
    down = 1j * (_MARGIN - top)
    place = [z + down for z in place]
    texts = [replace(text, box=replace(text.box, center=text.box.center + down)) for text in texts]
    arrows = draw_arrows(wiring, place, measures)
    height = bottom - top + 2 * _MARGIN
    return Layout(wiring, place, arrows, texts, roles, _fills(wiring), measures, height, chosen)


def _scale(wiring: Wiring, width: float) -> float:
    """Pixels per unit: the picture fills the width, less the room for exterior labels, unless it gets too high."""
    x = max((wiring.points[v].real for v in wiring.vertices), default=0.0)
    y = max((wiring.points[v].imag for v in wiring.vertices), default=0.0)
    return min((width - 2 * (_MARGIN + 48.0)) / max(x, 1e-9), 0.72 * width / max(y, 1e-9))


def _placed(wiring: Wiring, scale: float, width: float) -> list[complex]:
    """The points turned upside down, scaled, and centred."""
    x = max((wiring.points[v].real for v in wiring.vertices), default=0.0)
    return [complex(width / 2 + scale * (z.real - x / 2), -scale * z.imag) for z in wiring.points]


def _measures(wiring: Wiring, scale: float, chosen: int) -> Measures:
    """Measures that fit the shorter edges, the narrowest face, and the face that also holds words; never larger."""
    sides = sorted(abs(wiring.points[wiring.origin[h]] - wiring.points[wiring.target(h)]) for h in wiring.halfedges)
    fitting = [1.0, scale * sides[len(sides) // 5] / 135.0 if sides else 1.0]
    fitting += (scale * abs(wiring.roominess(f)) / (66.0 if f == chosen else 52.0) for f in wiring.faces)
    return Measures().scaled(max(0.35, min(fitting)))


def _fills(wiring: Wiring) -> dict[int, int]:
    """A fill of its own for each of a few faces, else the lowest that no neighbor has, face after face."""
    if len(wiring.faces) <= len(FACE_FILLS):
        return {f: i for i, f in enumerate(wiring.faces)}
    fills: dict[int, int] = {}
    for f, loop in wiring.faces.items():
        taken = {fills.get(wiring.face[h ^ 1]) for h in loop}
        fills[f] = next(i for i in range(len(loop) + 1) if i not in taken)
    return fills


def _extent(boxes: list[Box], lines: np.ndarray) -> tuple[float, float]:
    """The least and the greatest y of everything drawn."""
    tops = [box.center.imag - box.half_height for box in boxes]
    bottoms = [box.center.imag + box.half_height for box in boxes]
    heights = lines[:, 1::2].ravel().tolist()
    return min(tops + heights, default=0.0), max(bottoms + heights, default=0.0)
