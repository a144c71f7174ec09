"""A mesh of polygons as a picture: colored by the number of sides, strong outlines, the triangles below if wanted."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from halfmesh.errors import FormatError
from halfmesh.viewer.plotting import drawn, is_flat

if TYPE_CHECKING:
    from halfmesh.mesh import Mesh

__all__ = ["plot_polygons", "save_polygons_plot"]

CLASSES = (3, 4, 5, 6, 7, 9, 12, 16)
"""The least number of sides of each color."""

COLORS = ("#fffbe0", "#e3f1b5", "#b5dfb0", "#7fcbb6", "#55b3c4", "#4a93c7", "#5c74bd", "#7a5aa8")
"""From light to dark, so that they tell without their hues; none so dark that an outline is lost in it."""

OUTLINE, BELOW = "#16202e", "#3b4a5a"
PICTURES = (".png", ".svg", ".pdf", ".jpg", ".webp")
FINE, COARSE = 0.4, 2.2  # outlines of many polygons and of few, in points


def plot_polygons(mesh: Mesh, *, triangulation: Mesh | None = None, ax: Any = None, legend: bool = True) -> Any:
    """Draw the faces of a mesh colored by their number of sides, with matplotlib (``pip install halfmesh[plot]``).

    Parameters
    ----------
    mesh : Mesh
        Drawn in the plane if all z are equal, in space otherwise.
    triangulation : Mesh, optional
        Its edges are drawn thin below the outlines: the triangles of which the polygons were made. In the plane only.
    ax : matplotlib Axes, optional
        Where to draw; new axes in a new figure by default.
    legend : bool
        Say beside the picture which color is how many sides, and how many polygons have it.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ImportError
        matplotlib is not installed.
    PreconditionError
        There are no faces, or too many to draw.

    Notes
    -----
    O(n), about 10 us a face.

    Examples
    --------
    >>> import halfmesh as hm
    >>> triangles = hm.shapes.seed_triangulation()
    >>> ax = hm.viewer.plot_polygons(hm.polylla(triangles), triangulation=triangles)  # doctest: +SKIP
    """
    sides = mesh.face_degrees()[mesh.faces.indices]
    classes = np.searchsorted(CLASSES, np.maximum(sides, CLASSES[0]), side="right") - 1
    colors = [COLORS[i] for i in classes.tolist()]
    width = float(np.clip(22.0 / max(len(sides), 1) ** 0.5, FINE, COARSE))
    if is_flat(mesh):
        axes = drawn(mesh, ax, facecolors=colors, edgecolors="none", zorder=1)
        if triangulation is not None:
            axes.add_collection(_lines(triangulation, colors=BELOW, linewidths=0.3 * width, alpha=0.6, zorder=2))
        rim = (mesh.edge_faces()[mesh.edges.indices] < 0).any(axis=1)
        widths = np.where(rim, 1.5 * width, width)
        axes.add_collection(_lines(mesh, colors=OUTLINE, linewidths=widths, capstyle="round", zorder=3))
    else:
        axes = drawn(mesh, ax, facecolors=colors, edgecolors=OUTLINE, linewidths=width)
        axes.set_box_aspect(np.diff(axes.get_w_lims())[::2], zoom=1.4)  # of the room that hidden axes leave
    if legend:
        _add_legend(axes, np.bincount(classes, minlength=len(CLASSES)).tolist())
    axes.set_axis_off()
    return axes


def save_polygons_plot(mesh: Mesh, path: str | os.PathLike[str], *, triangulation: Mesh | None = None) -> None:
    """Write the picture of :func:`plot_polygons` to a file; the suffix decides: png, svg, pdf, jpg, webp.

    Parameters
    ----------
    mesh, triangulation : Mesh
        As in :func:`plot_polygons`.
    path : path-like

    Raises
    ------
    ImportError, PreconditionError
        As :func:`plot_polygons`.
    FormatError
        Another suffix.
    OSError
        The file can't be written.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.viewer.save_polygons_plot(hm.shapes.dodecahedron(), "dodecahedron.png")  # doctest: +SKIP
    """
    figure = check_picture(path)
    axes = figure.add_subplot(**({} if is_flat(mesh) else {"projection": "3d"}))
    plot_polygons(mesh, triangulation=triangulation, ax=axes)
    figure.savefig(path, dpi=130, bbox_inches="tight", pad_inches=0.05)


def check_picture(path: str | os.PathLike[str]) -> Any:
    """An empty figure, if matplotlib is there and writes files like `path`."""
    try:
        from matplotlib.figure import Figure  # without pyplot, which may want a screen
    except ImportError:
        raise ImportError("pictures need matplotlib: pip install halfmesh[plot]") from None
    suffix = os.path.splitext(os.fspath(path))[1].lower()
    if suffix not in PICTURES:
        found = f"unknown suffix {suffix!r}" if suffix else "no suffix says which kind of picture this is"
        raise FormatError(f"{found}; pictures are written as {', '.join(PICTURES)}", path=path)
    return Figure(figsize=(7, 6))


def _lines(mesh: Mesh, **style: Any) -> Any:
    from matplotlib.collections import LineCollection

    ends = mesh.edge_vertices()[mesh.edges.indices]
    return LineCollection(mesh.points[ends][:, :, :2].tolist(), **style)


def _add_legend(axes: Any, counts: list[int]) -> None:
    from matplotlib.patches import Patch

    patches = [
        Patch(facecolor=COLORS[i], edgecolor=OUTLINE, linewidth=0.6, label=f"{_label(i)}  ({count:,})")
        for i, count in enumerate(counts)
        if count
    ]
    axes.legend(
        handles=patches, title="sides", loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, handlelength=1.2,
        handleheight=1.2, alignment="left",
    )  # fmt: skip


def _label(i: int) -> str:
    if i + 1 == len(CLASSES):
        return f"{CLASSES[i]} or more"
    last = CLASSES[i + 1] - 1
    return str(last) if last == CLASSES[i] else f"{CLASSES[i]} to {last}"
