"""The picture that explains the half-edge structure, as SVG text."""

from __future__ import annotations

import os
from pathlib import Path

from halfmesh.viewer.arrows import full_head, half_head
from halfmesh.viewer.board import Label
from halfmesh.viewer.layout import Layout, lay_out
from halfmesh.viewer.legend import LEGEND_HEIGHT, legend
from halfmesh.viewer.plane import left
from halfmesh.viewer.style import COLORS, FACE_FILLS, SANS
from halfmesh.viewer.svg import closed, curve, element, number, segment, text
from halfmesh.viewer.wiring import Drawable

__all__ = ["save_structure_diagram", "structure_diagram"]


def structure_diagram(mesh: Drawable, *, width: int = 830, highlight: int | None = None, labels: bool = True) -> str:
    """Draw the halfedges of a small mesh, how they are linked, and what the words mean.

    Every halfedge is a half-arrow on its own side of its edge; curved arrows lead from each to its next; a small
    double arrow joins twins; exterior halfedges are dashed. One halfedge is explained: its twin, next, prev, origin,
    target and face carry their words.

    Parameters
    ----------
    mesh
        A :class:`halfmesh.Mesh` of at most 60 faces. It is drawn as seen from above: x to the right, y upwards.
    width : int
        Width of the picture in pixels; its height follows from the mesh.
    highlight : int, optional
        The halfedge to explain. By default the first one that is well surrounded by faces.
    labels : bool
        Whether to write the numbers of the elements.

    Returns
    -------
    str
        An SVG document. The same mesh always gives the same text.

    Raises
    ------
    PreconditionError
        The mesh is too large to be labelled, or a point is not finite.
    ElementError
        There is no halfedge ``highlight``.

    Notes
    -----
    Only ``mesh.points`` and ``mesh.topology`` are read. Overlapping or degenerate meshes are drawn as they come.

    Examples
    --------
    >>> import halfmesh as hm
    >>> from halfmesh.viewer import FIGURE_FACES, FIGURE_POINTS, structure_diagram
    >>> svg = structure_diagram(hm.Mesh(FIGURE_FACES, FIGURE_POINTS))
    >>> svg.count("data-index")  # 8 vertices, 22 halfedges, 11 edges, 4 faces
    45
    """
    layout = lay_out(mesh, width=float(width), highlight=highlight, labels=labels)
    height = layout.height + (LEGEND_HEIGHT if layout.wiring.halfedges else 0.0)
    frame = element(
        "rect", x=0.75, y=0.75, width=width - 1.5, height=height - 1.5, rx=14, fill=COLORS["paper"],
        stroke=COLORS["frame"], stroke_width=1.5,
    )  # fmt: skip
    title = element("title", "Halfedge structure of a small mesh")
    parts = [title, frame, *_picture(layout)]
    if layout.wiring.halfedges:
        parts.append(legend(layout, float(width), layout.height))
    return (
        element(
            "svg", "\n".join(parts), xmlns="http://www.w3.org/2000/svg", width=float(width), height=height,
            viewBox=f"0 0 {number(width)} {number(height)}", font_family=SANS, role="img",
        )
        + "\n"
    )  # fmt: skip


def save_structure_diagram(
    mesh: Drawable,
    path: str | os.PathLike[str],
    *,
    width: int = 830,
    highlight: int | None = None,
    labels: bool = True,
) -> None:
    """Write the :func:`structure_diagram` of ``mesh`` to an SVG file.

    Parameters
    ----------
    mesh
        The mesh.
    path : str or path
        The file, replaced if it exists.
    width, highlight, labels
        As for :func:`structure_diagram`.

    Raises
    ------
    PreconditionError, ElementError
        As :func:`structure_diagram`; no file is written then.
    OSError
        The file can't be written.

    Examples
    --------
    >>> import halfmesh as hm, pathlib, tempfile
    >>> from halfmesh.viewer import save_structure_diagram
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "triangle.svg"
    ...     save_structure_diagram(hm.Mesh([[0, 1, 2]], [[0, 0], [1, 0], [0, 1]]), path)
    ...     path.read_text()[:4]
    '<svg'
    """
    svg = structure_diagram(mesh, width=width, highlight=highlight, labels=labels)
    Path(path).write_text(svg, encoding="utf-8", newline="\n")


def _picture(layout: Layout) -> list[str]:
    """The layers from bottom to top: faces, edges, halfedges, vertices, words."""
    named = {(label.kind, label.index): label for label in layout.labels if label.kind != "word"}
    return [
        element("g", (_face(layout, named, f) for f in layout.wiring.faces), class_="faces"),
        element("g", (_edge(layout, e) for e in layout.arrows.edges), class_="edges", fill="none"),
        element("g", (_halfedge(layout, named, h) for h in layout.wiring.halfedges), class_="halfedges"),
        element("g", (_vertex(layout, named, v) for v in layout.wiring.vertices), class_="vertices"),
        element("g", (_written(label) for label in layout.labels if label.kind == "word"), class_="words"),
    ]


def _face(layout: Layout, named: dict[tuple[str, int], Label], f: int) -> str:
    corners = [layout.place[layout.wiring.origin[h]] for h in layout.wiring.faces[f]]
    # A face seen from below lies on the outside of the others: it isn't filled.
    fill = FACE_FILLS[layout.fills[f] % len(FACE_FILLS)] if layout.wiring.roominess(f) >= 0 else "none"
    shape = element("path", d=closed(corners), fill=fill)
    return element("g", [shape, _written(named.get(("face", f)))], class_="face", data_index=str(f))


def _edge(layout: Layout, e: int) -> str:
    size = layout.size
    line = element("path", d=segment(*layout.arrows.edges[e]), stroke=COLORS["edge"], stroke_width=0.8 * size.line)
    chosen = layout.highlight is not None and layout.highlight >> 1 == e
    color = COLORS["twin" if chosen else "interior"]
    a, b = layout.arrows.twins[e]
    along = (b - a) / (abs(b - a) or 1.0)
    head = size.head * (0.5 if chosen else 0.38)
    inset = 0.6 * head * along
    thick = size.line * (0.9 if chosen else 0.5)
    shaft = element("path", d=segment(a + inset, b - inset), stroke=color, stroke_width=thick)
    heads = (element("path", d=closed(full_head(tip, way, head)), fill=color) for tip, way in ((a, -along), (b, along)))
    return element("g", [line, shaft, *heads], class_="edge", data_index=str(e))


def _halfedge(layout: Layout, named: dict[tuple[str, int], Label], h: int) -> str:
    w, size, arrow = layout.wiring, layout.size, layout.arrows.halfedges[h]
    role = layout.roles.halfedges.get(h, "")
    color = COLORS[role or ("exterior" if w.is_exterior(h) else "interior")]
    thick = size.line * (1.75 if role else 1.0)
    dash = f"{number(2.6 * size.line)} {number(2.0 * size.line)}" if w.is_exterior(h) else None
    head = size.head * (1.25 if role else 1.0)
    end = arrow.tip - 0.55 * head * arrow.direction
    shaft = element("path", d=segment(end, arrow.tail), stroke=color, stroke_width=thick, stroke_dasharray=dash)
    nudge = -0.5 * thick * left(arrow.direction)  # the head's straight side continues the shaft's outer side
    barb = element("path", d=closed([z + nudge for z in half_head(arrow, head, thick)]), fill=color)
    face = f"face f{w.face[h]}" if w.face[h] >= 0 else "exterior"
    tip = f"h{h}: v{w.origin[h]} to v{w.target(h)}, {face}, twin h{h ^ 1}, next h{w.next[h]}, prev h{w.prev[h]}"
    parts = [element("title", tip), shaft, barb, _bend(layout, h, color), _written(named.get(("halfedge", h)))]
    return element("g", parts, class_="halfedge exterior" if w.is_exterior(h) else "halfedge", data_index=str(h))


def _bend(layout: Layout, h: int, color: str) -> str:
    size, bend = layout.size, layout.arrows.bends[h]
    role = layout.roles.halfedges.get(h, "")
    linked = {"h": COLORS["next"], "prev": COLORS["prev"]}.get(role)
    plain = COLORS["exterior" if layout.wiring.is_exterior(h) else "interior"]
    thick = size.line * (1.2 if linked else 0.55)
    head = size.head * (0.72 if linked else 0.5)
    tip = bend.pieces[-1][2]
    pieces = [*bend.pieces[:-1], (*bend.pieces[-1][:2], tip - 0.7 * head * bend.direction)]
    line = element("path", d=curve(bend.start, pieces), stroke=linked or plain, stroke_width=thick, fill="none")
    return line + element("path", d=closed(full_head(tip, bend.direction, head)), fill=linked or plain)


def _vertex(layout: Layout, named: dict[tuple[str, int], Label], v: int) -> str:
    z, size = layout.place[v], layout.size
    special = v in (layout.roles.origin, layout.roles.target)
    fill, rim = COLORS["h" if special else "paper"], COLORS["h" if special else "interior"]
    disc = element("circle", cx=z.real, cy=z.imag, r=size.radius, fill=fill, stroke=rim, stroke_width=0.7 * size.line)
    label = named.get(("vertex", v))
    ink = COLORS["paper" if special else "ink"]
    name = text(z, label.text, label.size, ink, font_weight="600") if label and label.text else ""
    return element("g", [disc, name], class_="vertex", data_index=str(v))


def _written(label: Label | None) -> str:
    """A label: on a pill if it has a role among halfedges and faces, else plain with a halo."""
    if label is None:
        return ""
    box = label.box
    if label.role and label.kind != "word":
        pill = element(
            "rect", x=box.center.real - box.half_width, y=box.center.imag - box.half_height, width=2 * box.half_width,
            height=2 * box.half_height, rx=box.half_height, fill=COLORS[label.role],
        )  # fmt: skip
        return pill + text(box.center, label.text, label.size, COLORS["paper"], font_weight="700")
    ink = COLORS[label.role or ("ink" if label.kind == "face" else "muted")]
    weight = "700" if label.role or label.kind == "face" else "500"
    halo = 0.22 * label.size
    return text(
        box.center, label.text, label.size, ink, font_weight=weight, stroke=COLORS["paper"], stroke_width=halo,
        stroke_linejoin="round", stroke_opacity=0.7, paint_order="stroke",
    )  # fmt: skip
