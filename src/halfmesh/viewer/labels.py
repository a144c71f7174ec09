"""Which labels a structure diagram has, and in which order they take their places."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from halfmesh.viewer.arrows import segments_of
from halfmesh.viewer.board import Board, Label

if TYPE_CHECKING:
    from halfmesh.viewer.arrows import Arrows
    from halfmesh.viewer.style import Measures
    from halfmesh.viewer.wiring import Wiring

__all__ = ["Roles", "place_labels", "roles_of"]


@dataclass(frozen=True)
class Roles:
    """What the highlighted halfedge makes of the elements around it: element to role, for each kind."""

    halfedges: dict[int, str] = field(default_factory=dict)
    origin: int = -1
    target: int = -1
    face: int = -1


def roles_of(wiring: Wiring, h: int | None) -> Roles:
    """The roles around halfedge ``h``; where two coincide (a lone edge), the earlier word wins."""
    if h is None:
        return Roles()
    halfedges = {wiring.prev[h]: "prev", wiring.next[h]: "next", h ^ 1: "twin", h: "h"}
    return Roles(halfedges, wiring.origin[h], wiring.target(h), wiring.face[h])


def place_labels(
    wiring: Wiring,
    place: list[complex],
    arrows: Arrows,
    roles: Roles,
    size: Measures,
    *,
    width: float,
    numbers: bool = True,
) -> list[Label]:
    """All labels of the picture, the least movable first.

    Parameters
    ----------
    wiring, place, arrows
        The mesh, its vertices on the screen, its arrows.
    roles
        What is highlighted.
    size
        The measures to use.
    width : float
        Width of the picture, which no label leaves.
    numbers : bool
        Whether elements show their numbers; without them only the words of the highlight remain.
    """
    board = Board(segments_of(arrows), size, width)
    for v in wiring.vertices:
        board.fix(place[v], f"v{v}" if numbers else "", v)
    order = sorted(wiring.halfedges, key=lambda h: (h not in roles.halfedges, h))
    for h in order:
        role = roles.halfedges.get(h, "")
        joint = " = " if role == "h" else " "
        text = joint.join(filter(None, (role, f"h{h}" if numbers else "")))
        if text:
            board.beside(arrows.halfedges[h], text, role, short=role or text)
    if roles.halfedges:
        _place_ends(board, wiring, place, arrows, roles)
    for f, loop in wiring.faces.items():
        text = " ".join(filter(None, ("face" if f == roles.face else "", f"f{f}" if numbers else "")))
        role = "h" if f == roles.face else ""
        below = wiring.roominess(f) < 0  # seen from below: its inside is the outside of the picture
        sides = [arrows.halfedges[h] for h in loop]
        if text and not (below and board.along(sides, "face", f, f"{text} (outside)", role)):
            board.within([place[wiring.origin[h]] for h in loop], f, text, role, short=f"f{f}" if numbers else text)
    outer = [arrows.halfedges[h] for h in wiring.halfedges if wiring.is_exterior(h)]
    if outer:
        board.along(outer, "word", -1, "boundary loop", "exterior")
    return board.labels


def _place_ends(board: Board, wiring: Wiring, place: list[complex], arrows: Arrows, roles: Roles) -> None:
    h = next(h for h, role in roles.halfedges.items() if role == "h")
    along = arrows.halfedges[h].direction
    board.near(place[roles.origin], -along, "origin", roles.origin)
    if roles.target != roles.origin:
        board.near(place[roles.target], along, "target", roles.target)
