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
    polygons = _polygons(mesh)
    flat = bool(np.ptp(mesh.points[:, 2]) == 0.0)
    axes = _axes(flat) if ax is None else ax
    axes.add_collection(_collection(polygons, _values(mesh, values), flat, edge_width))
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    names = "xy" if flat else "xyz"
    for i, name in enumerate(names):
        margin = 0.02 * (high[i] - low[i]) or 1.0
        getattr(axes, f"set_{name}lim")(low[i] - margin, high[i] + margin)
    axes.set_aspect("equal")
    return axes


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


def _collection(polygons: list[Any], values: Any, flat: bool, edge_width: float) -> Any:
    style: dict[str, Any] = {"linewidths": edge_width, "edgecolors": "#1b2733" if edge_width else "none"}
    if values is None:
        style["facecolors"] = "#9ecae1"
    if flat:
        from matplotlib.collections import PolyCollection

        made = PolyCollection([polygon[:, :2] for polygon in polygons], **style)
    else:
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        made = Poly3DCollection(polygons, **style)
    if values is not None:
        made.set_array(values)
    return made
