"""A mesh drawn by matplotlib, into axes of your own or new ones."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from halfmesh.errors import PreconditionError

if TYPE_CHECKING:
    from halfmesh.mesh import Mesh

__all__ = ["plot"]

MOST_FACES = 200_000  # matplotlib draws each polygon by itself; more than that takes minutes


def plot(mesh: Mesh, *, values: ArrayLike | None = None, ax: Any = None, edge_width: float = 0.3) -> Any:
    """Draw the faces of a mesh with matplotlib, which ``pip install halfmesh[plot]`` brings.

    Parameters
    ----------
    mesh : Mesh
        Drawn in the plane if all z are equal, in space otherwise.
    values : array_like of float, shape (n face slots,), optional
        Colors the faces by number.
    ax : matplotlib Axes, optional
        Where to draw; new axes in a new figure by default.
    edge_width : float
        Of the lines between faces, in points; 0 for none.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ImportError
        matplotlib is not installed.
    PreconditionError
        There are no faces, too many, or not one value for each.

    Notes
    -----
    O(n), about 5 us a face.

    Examples
    --------
    >>> import halfmesh as hm
    >>> mesh = hm.shapes.icosphere(2)
    >>> ax = hm.viewer.plot(mesh, values=hm.geometry.face_areas(mesh))  # doctest: +SKIP
    """
    checked = _values(mesh, values)
    style = {} if checked is not None else {"facecolors": "#9ecae1"}
    axes = drawn(mesh, ax, linewidths=edge_width, edgecolors="#1b2733" if edge_width else "none", **style)
    if checked is not None:
        axes.collections[-1].set_array(checked)
    return axes


def drawn(mesh: Mesh, ax: Any, **style: Any) -> Any:
    """Axes with the faces in them as the last collection, in a style of matplotlib's; the faces fill the axes."""
    polygons, flat = _polygons(mesh), is_flat(mesh)
    axes = _axes(flat) if ax is None else ax
    axes.add_collection(_collection(polygons, flat, style))
    used = np.concatenate(polygons)
    low, high = used.min(axis=0), used.max(axis=0)
    for i, name in enumerate("xy" if flat else "xyz"):
        margin = 0.02 * (high[i] - low[i]) or 1.0
        getattr(axes, f"set_{name}lim")(low[i] - margin, high[i] + margin)
    axes.set_aspect("equal")
    return axes


def is_flat(mesh: Mesh) -> bool:
    """Whether the mesh lies in a plane of constant z, and is drawn in the plane."""
    return bool(np.ptp(mesh.points[:, 2]) == 0.0)


def _polygons(mesh: Mesh) -> list[Any]:
    if not 0 < mesh.n_faces <= MOST_FACES:
        raise PreconditionError(f"the mesh has {mesh.n_faces} faces; plot draws 1 to {MOST_FACES}")
    indices, offsets = mesh.face_vertices()
    rows = np.split(mesh.points[indices], offsets[1:-1])
    return [rows[f] for f in mesh.faces.indices]


def _values(mesh: Mesh, values: ArrayLike | None) -> Any:
    if values is None:
        return None
    array = np.asarray(values, dtype=np.float64)
    if array.shape != (len(mesh.topology.face_halfedge),):
        raise PreconditionError(f"values has shape {array.shape}; expected one for each face")
    return array[mesh.faces.indices]


def _axes(flat: bool) -> Any:
    import matplotlib.pyplot as plt

    return plt.figure().add_subplot(**({} if flat else {"projection": "3d"}))


def _collection(polygons: list[Any], flat: bool, style: dict[str, Any]) -> Any:
    if flat:
        from matplotlib.collections import PolyCollection

        return PolyCollection([polygon[:, :2] for polygon in polygons], **style)
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    return Poly3DCollection(polygons, **style)
