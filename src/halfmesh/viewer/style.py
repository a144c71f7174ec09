"""Colours, fonts and measures of the pictures, in one place.

The colours are variants of the Okabe-Ito palette, darkened until text in them has a contrast of 4.5 on white. No
meaning rests on colour alone: exterior halfedges are dashed, and whatever is highlighted carries its word.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

__all__ = ["COLORS", "FACE_FILLS", "MONO", "SANS", "Measures"]

SANS = "-apple-system, BlinkMacSystemFont, 'Segoe UI', 'Noto Sans', Helvetica, Arial, 'Liberation Sans', sans-serif"
MONO = "ui-monospace, SFMono-Regular, 'SF Mono', Menlo, Consolas, 'Liberation Mono', 'DejaVu Sans Mono', monospace"

COLORS = {
    "paper": "#ffffff",
    "frame": "#d5dce6",
    "ink": "#172033",
    "muted": "#55627a",
    "edge": "#b4bfce",
    "interior": "#64748f",
    "exterior": "#c84f00",
    "h": "#172033",
    "twin": "#0069ad",
    "next": "#007a5a",
    "prev": "#a43d86",
}

FACE_FILLS = ("#e1eefb", "#fdf3d6", "#e0f3e8", "#f5e8f5", "#fbe7de", "#e9eaf6")
"""Pale fills; neighbors get different ones as long as they last."""


@dataclass(frozen=True)
class Measures:
    """Lengths in pixels, as they are for edges of about 150 pixels."""

    offset: float = 14.5  # from the edge to its halfedges
    radius: float = 11.0  # of a vertex
    stub: float = 22.0  # least distance from a vertex to the end of a halfedge
    bend: float = 21.0  # from a halfedge's end to where it would meet the next one
    head: float = 13.0  # length of a half-arrow's head
    line: float = 2.4  # width of a halfedge
    gap: float = 3.5  # air around labels
    small: float = 14.0  # font sizes: halfedges and words
    disc: float = 12.0  # vertices
    large: float = 18.0  # faces

    def scaled(self, factor: float) -> Measures:
        """The same for shorter edges: every length times ``factor``."""
        return Measures(*(factor * getattr(self, field.name) for field in fields(self)))
