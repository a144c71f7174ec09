"""The legend below a structure diagram: what each word means, told for the highlighted halfedge."""

from __future__ import annotations

from halfmesh.viewer.layout import Layout
from halfmesh.viewer.style import COLORS, FACE_FILLS, MONO
from halfmesh.viewer.svg import closed, element, segment, text

__all__ = ["LEGEND_HEIGHT", "legend"]

LEGEND_HEIGHT = 148.0
_COLUMNS = 4
_ROW = 64.0

Entry = tuple[str, str, str, tuple[str, str]]
"""Glyph, word in code, value, two lines of meaning."""


def entries(layout: Layout) -> list[Entry]:
    """The rows of the legend; without any halfedge only the loop remains."""
    h, w = layout.highlight, layout.wiring
    rows: list[Entry] = []
    if h is not None:
        face = w.face[h]
        whose = f"face f{face}" if face >= 0 else "the loop"
        rows = [
            ("h", "h", f"h{h}", ("a halfedge: one of the", f"two sides of edge e{h >> 1}")),
            ("twin", "h.twin", f"h{h ^ 1}", ("the same edge,", "the other way round")),
            ("next", "h.next", f"h{w.next[h]}", ("the one after h", f"around {whose}")),
            ("prev", "h.prev", f"h{w.prev[h]}", ("the one before h", f"around {whose}")),
            ("vertex", "h.origin", f"v{w.origin[h]}", ("the vertex where", "h starts")),
            ("vertex", "h.target", f"v{w.target(h)}", ("the vertex where", "h ends")),
            ("face", "h.face", f"f{face}" if face >= 0 else "-1", ("the face on its left,", "-1 if there is none")),
        ]
    if any(w.is_exterior(g) for g in w.halfedges):
        rows.append(("exterior", "boundary loop", "", ("halfedges without face,", "linked by next as well")))
    return rows


def legend(layout: Layout, width: float, top: float) -> str:
    """The legend as SVG, four entries in a row."""
    left, right = 30.0, width - 16.0
    parts = [element("path", d=segment(complex(26, top), complex(width - 26, top)), stroke=COLORS["frame"])]
    for i, entry in enumerate(entries(layout)):
        row, column = divmod(i, _COLUMNS)
        corner = complex(left + column * (right - left) / _COLUMNS, top + 24 + row * _ROW)
        parts.append(_entry(corner, entry, layout))
    return element("g", parts, class_="legend")


def _entry(corner: complex, entry: Entry, layout: Layout) -> str:
    glyph, word, value, meaning = entry
    color = COLORS.get(glyph, COLORS["h"])
    x = corner + 38
    code = element("tspan", word, font_weight="700")
    if value:
        code += element("tspan", f"= {value}", dx=8.0, font_weight="400")
    font = MONO if value else None
    title = element("text", code, x=x.real, y=corner.imag + 5, font_size=14.5, fill=color, font_family=font)
    if not value:
        title = text(x, word, 14.5, color, text_anchor="start", font_weight="700")
    lines = [
        text(x + 1j * (19 + 16 * i), line, 13, COLORS["muted"], text_anchor="start") for i, line in enumerate(meaning)
    ]
    return element("g", [_glyph(glyph, value, corner, color, layout), title, *lines])


def _glyph(glyph: str, name: str, corner: complex, color: str, layout: Layout) -> str:
    middle = corner + 13
    if glyph == "vertex":
        disc = element("circle", cx=middle.real, cy=middle.imag, r=10.5, fill=color)
        return disc + text(middle, name, 11.5, COLORS["paper"], font_weight="600")
    if glyph == "face":
        face = layout.roles.face
        fill = FACE_FILLS[layout.fills[face] % len(FACE_FILLS)] if face in layout.fills else "none"
        sides = [middle + z for z in (-11 + 7j, -7 - 8j, 8 - 8j, 11 + 5j)]
        return element("path", d=closed(sides), fill=fill, stroke=COLORS["edge"], stroke_width=1.6)
    dash = "5 4" if glyph == "exterior" else None
    tail, tip = corner + 3j, corner + 26 + 3j
    shaft = element("path", d=segment(tail, tip - 4), stroke=color, stroke_width=3, fill="none", stroke_dasharray=dash)
    head = element("path", d=closed([tip + 1.5j, tip - 11 - 7j, tip - 8 + 1.5j]), fill=color)
    return shaft + head
