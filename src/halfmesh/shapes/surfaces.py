"""Grids and what can be rolled from them."""

from __future__ import annotations

import numpy as np

from halfmesh.mesh.mesh import Mesh
from halfmesh.shapes._lattice import cells, circle, fan, halved, mixed
from halfmesh.shapes._parameters import holdable, positive, real, whole

__all__ = ["cone_fan", "cylinder", "disk", "grid", "polygon", "torus"]


def grid(columns: int = 10, rows: int | None = None, *, triangles: bool = False) -> Mesh:
    """A flat rectangle of square cells with sides of length 1, from the origin to (columns, rows, 0).

    Parameters
    ----------
    columns, rows : int
        Cells along x and along y; as many rows as columns if `rows` is not given.
    triangles : bool
        Cut each cell into two triangles, along the diagonal that rises to the right.

    Returns
    -------
    Mesh
        Vertex (x, y) is number ``y * (columns + 1) + x``, cell (x, y) is face ``y * columns + x``.

    Raises
    ------
    ValueError
        If there is less than one cell.

    Notes
    -----
    O(n).

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.grid(3, 2)
    <Mesh: 12 vertices, 17 edges, 6 faces, with boundary>
    >>> hm.shapes.grid(3, 2, triangles=True).n_faces
    12
    """
    columns = whole("columns", columns, 1)
    rows = columns if rows is None else whole("rows", rows, 1)
    holdable((6 if triangles else 4) * rows * columns, f"grid({columns}, {rows})")
    points = np.zeros((rows + 1, columns + 1, 3))
    points[:, :, 0] = np.arange(columns + 1)
    points[:, :, 1] = np.arange(rows + 1)[:, None]
    quads = cells(columns, rows)
    return Mesh(halved(quads) if triangles else quads, points.reshape(-1, 3))


def disk(rings: int = 4, sectors: int = 16, *, radius: float = 1.0, triangles: bool = False) -> Mesh:
    """A flat disk around the origin: triangles about the center, and rings of quads around them.

    Parameters
    ----------
    rings : int
        Rings of faces, the innermost of triangles.
    sectors : int
        Faces in each ring, at least 3.
    radius : float
        Distance of the rim from the center.
    triangles : bool
        Cut the quads into two triangles each.

    Returns
    -------
    Mesh
        Vertex 0 is the center; then ring after ring, counter-clockwise from the x axis.

    Raises
    ------
    ValueError
        If a number is too small.

    Notes
    -----
    O(n).

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.disk(2, 6)
    <Mesh: 13 vertices, 24 edges, 12 faces, with boundary>
    """
    rings, sectors = whole("rings", rings, 1), whole("sectors", sectors, 3)
    radius = positive("radius", radius)
    holdable((6 if triangles else 4) * rings * sectors, f"disk({rings}, {sectors})")
    distances = radius * np.arange(1, rings + 1) / rings
    points = np.zeros((rings * sectors + 1, 3))
    points[1:] = (distances[:, None, None] * circle(sectors)).reshape(-1, 3)
    # columns of the lattice run around, rows outward: reversed, the quads face up
    quads = cells(sectors, rings - 1, around=True)[:, ::-1] + np.int32(1)
    center = fan(0, np.arange(1, sectors + 1, dtype=np.int32))
    return Mesh(mixed(center, halved(quads) if triangles or rings == 1 else quads), points)


def cylinder(
    sectors: int = 32,
    rings: int = 8,
    *,
    radius: float = 1.0,
    height: float = 2.0,
    closed: bool = False,
    triangles: bool = False,
) -> Mesh:
    """A cylinder around the z axis, from z = 0 up.

    Parameters
    ----------
    sectors, rings : int
        Faces around (at least 3), and faces from the bottom to the top.
    radius, height : float
        Its size.
    closed : bool
        Close the bottom and the top: by one polygon each, or by a fan around a center if `triangles`.
    triangles : bool
        Cut the quads into two triangles each.

    Returns
    -------
    Mesh
        Vertices ring after ring from the bottom, counter-clockwise from the x axis; then the two centers, if any.

    Raises
    ------
    ValueError
        If a number is too small.

    Notes
    -----
    O(n).

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.cylinder(12, 3).n_boundary_loops
    2
    >>> can = hm.shapes.cylinder(12, 3, closed=True)
    >>> can.faces[36].degree, can.has_boundary
    (12, False)
    """
    sectors, rings = whole("sectors", sectors, 3), whole("rings", rings, 1)
    radius, height = positive("radius", radius), positive("height", height)
    holdable((6 if triangles else 4) * (rings + 1) * sectors, f"cylinder({sectors}, {rings})")
    n = sectors * (rings + 1)
    points = np.zeros((n + 2, 3))
    levels = points[:n].reshape(rings + 1, sectors, 3)
    levels[:] = circle(sectors, radius)
    levels[:, :, 2] = height * np.arange(rings + 1)[:, None] / rings
    points[n + 1, 2] = height
    quads = cells(sectors, rings, around=True)
    faces = [halved(quads) if triangles else quads]
    bottom, top = np.arange(sectors, dtype=np.int32)[::-1], np.arange(n - sectors, n, dtype=np.int32)
    if closed and triangles:
        faces += [fan(n, bottom), fan(n + 1, top)]
    elif closed:
        faces += [bottom[None], top[None]]
    return Mesh(mixed(*faces), points if closed and triangles else points[:n])


def torus(n: int = 32, m: int = 16, *, radius: float = 1.0, tube_radius: float = 0.4, triangles: bool = False) -> Mesh:
    """A torus around the z axis.

    Parameters
    ----------
    n, m : int
        Faces the long way, around the axis, and the short way, around the tube; at least 3 each.
    radius, tube_radius : float
        From the axis to the middle of the tube, and from there to the surface.
    triangles : bool
        Cut the quads into two triangles each.

    Returns
    -------
    Mesh
        Every vertex has degree 4, or 6 with triangles. The smooth torus has the area ``4 pi^2 radius tube_radius`` and
        the volume ``2 pi^2 radius tube_radius^2``.

    Raises
    ------
    ValueError
        If a number is too small, or the tube would meet itself.

    Notes
    -----
    O(n m).

    Examples
    --------
    >>> import halfmesh as hm
    >>> torus = hm.shapes.torus(12, 6)
    >>> torus, torus.genus
    (<Mesh: 72 vertices, 144 edges, 72 faces, closed>, 1)
    """
    n, m = whole("n", n, 3), whole("m", m, 3)
    radius, tube_radius = positive("radius", radius), positive("tube_radius", tube_radius)
    if tube_radius >= radius:
        raise ValueError(
            f"tube_radius must be less than radius, {radius}: the torus would meet itself with {tube_radius}"
        )
    holdable((6 if triangles else 4) * n * m, f"torus({n}, {m})")
    along, section = circle(n), circle(m, tube_radius)
    points = np.empty((m, n, 3))
    points[:] = (radius + section[:, 0])[:, None, None] * along
    points[:, :, 2] = section[:, 1, None]
    quads = cells(n, m, around=True, over=True)
    return Mesh(halved(quads) if triangles else quads, points.reshape(-1, 3))


def polygon(n: int = 6, *, radius: float = 1.0) -> Mesh:
    """One flat face: a regular polygon around the origin.

    Parameters
    ----------
    n : int
        Number of sides, at least 3. A million is fine.
    radius : float
        Distance of the corners from the origin.

    Raises
    ------
    ValueError
        If a number is too small.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.polygon(7)
    <Mesh: 7 vertices, 7 edges, 1 face, with boundary>
    """
    n = whole("n", n, 3)
    holdable(n, f"polygon({n})")
    return Mesh(np.arange(n, dtype=np.int32)[None], circle(n, positive("radius", radius)))


def cone_fan(n: int = 16, *, height: float = 1.0) -> Mesh:
    """The side of a cone: `n` triangles around vertex 0, which lies `height` above the middle of a unit circle.

    Parameters
    ----------
    n : int
        Number of triangles, at least 3. With 100,000 it is what makes careless code quadratic.
    height : float
        Of the apex; 0 makes the fan flat.

    Returns
    -------
    Mesh
        Vertices 1 to n are the rim, counter-clockwise from the x axis.

    Raises
    ------
    ValueError
        If `n` is less than 3.

    Examples
    --------
    >>> import halfmesh as hm
    >>> fan = hm.shapes.cone_fan(5)
    >>> fan.vertices[0].degree, fan.n_boundary_vertices
    (5, 5)
    """
    n = whole("n", n, 3)
    holdable(3 * n, f"cone_fan({n})")
    points = np.concatenate([[(0.0, 0.0, real("height", height))], circle(n)])
    return Mesh(fan(0, np.arange(1, n + 1, dtype=np.int32)), points)
