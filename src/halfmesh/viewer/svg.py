"""Writing SVG as text: numbers rounded to hundredths, attributes in the order given: the same every time."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.sax.saxutils import escape, quoteattr

from halfmesh.viewer.plane import Cubic

__all__ = ["closed", "curve", "element", "number", "segment", "text"]


def number(x: float) -> str:
    """``x`` to two decimals, without trailing zeros."""
    rounded = f"{x:.2f}".rstrip("0").rstrip(".")
    return "0" if rounded in {"-0", ""} else rounded


def element(tag: str, content: str | Iterable[str] = "", **attributes: str | float | None) -> str:
    """An element; underscores in attribute names become hyphens, None leaves an attribute out."""
    parts = [tag]
    for name, value in attributes.items():
        if value is not None:
            written = value if isinstance(value, str) else number(value)
            parts.append(f"{name.rstrip('_').replace('_', '-')}={quoteattr(written)}")
    inner = content if isinstance(content, str) else "".join(content)
    return f"<{' '.join(parts)}>{inner}</{tag}>" if inner else f"<{' '.join(parts)}/>"


def point(z: complex) -> str:
    """Two coordinates."""
    return f"{number(z.real)} {number(z.imag)}"


def segment(a: complex, b: complex) -> str:
    """Path data of a straight line."""
    return f"M{point(a)}L{point(b)}"


def closed(points: Sequence[complex]) -> str:
    """Path data of a polygon."""
    return "M" + "L".join(point(z) for z in points) + "Z"


def curve(start: complex, pieces: Sequence[Cubic]) -> str:
    """Path data of a chain of Bezier pieces."""
    return f"M{point(start)}" + "".join("C" + " ".join(point(z) for z in piece) for piece in pieces)


def text(z: complex, content: str, size: float, fill: str, **attributes: str | float | None) -> str:
    """A text whose middle lies at ``z`` unless ``text_anchor`` says otherwise; centred upright on its x-height."""
    attributes.setdefault("text_anchor", "middle")
    return element("text", escape(content), x=z.real, y=z.imag + 0.35 * size, font_size=size, fill=fill, **attributes)
