"""Triangulations of domains with holes, as they are in practice: a lake with islands, a gear."""

from __future__ import annotations

import numpy as np

from halfmesh.mesh.mesh import Mesh
from halfmesh.shapes._outlines import Domain, lake_domain, resampled, wheel_domain
from halfmesh.shapes._parameters import holdable, whole
from halfmesh.shapes._scattering import DistanceGrid, scattered, spacing
from halfmesh.shapes.triangulations import delaunay

__all__ = ["gear", "lake"]

_MOST_STEPS = 400_000  # along the rims
_POINTS_A_SQUARE = 0.6  # of the side of the distance between them: what random disks fill


def lake(n: int = 2000, *, islands: int = 5, seed: int = 3) -> Mesh:
    """A lake with islands as triangles: small ones at the shores, larger ones on open water.

    Needs the library CDT: ``pip install halfmesh[delaunay]``.

    Parameters
    ----------
    n : int
        About how many vertices.
    islands : int
        How many holes; fewer if there is no room for more.
    seed : int
        Of the shores and of the points: the same seed, the same mesh.

    Returns
    -------
    Mesh
        In the plane z = 0, about 3 long and 2 high, with ``islands + 1`` boundary loops.

    Raises
    ------
    ImportError
        The library is not installed.
    ValueError
        If a number is too small.

    See Also
    --------
    gear, halfmesh.delaunay

    Examples
    --------
    >>> import halfmesh as hm
    >>> lake = hm.shapes.lake(800, islands=3)
    >>> lake.is_triangular, lake.n_boundary_loops, lake.n_isolated_vertices
    (True, 4, 0)
    """
    n, islands = whole("n", n, 100), whole("islands", islands, 0)
    holdable(6 * n, f"lake({n})")
    random = np.random.default_rng(seed)
    return _filled(lake_domain(islands, random), n, 0.16, random)


def gear(n: int = 2000, *, teeth: int = 18, spokes: int = 6, seed: int = 0) -> Mesh:
    """A gear wheel as triangles: teeth, a bore with a keyway, and round holes.

    Needs the library CDT: ``pip install halfmesh[delaunay]``.

    Parameters
    ----------
    n : int
        About how many vertices.
    teeth : int
        At least 5.
    spokes : int
        At least 3: there is a round hole between each two.
    seed : int
        Of the points inside.

    Returns
    -------
    Mesh
        In the plane z = 0, in the unit circle, with ``spokes + 2`` boundary loops.

    Raises
    ------
    ImportError
        The library is not installed.
    ValueError
        If a number is too small.

    See Also
    --------
    lake, halfmesh.delaunay

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.gear(1000, teeth=12, spokes=5).n_boundary_loops
    7
    """
    n, teeth, spokes = whole("n", n, 100), whole("teeth", teeth, 5), whole("spokes", spokes, 3)
    holdable(6 * n, f"gear({n})")
    return _filled(wheel_domain(teeth, spokes), n, 0.12, np.random.default_rng(seed))


def _filled(domain: Domain, n: int, growth: float, random: np.random.Generator) -> Mesh:
    """Rims and points inside, as a constrained Delaunay triangulation of about `n` vertices."""
    outlines = [resampled(pieces, 0.02) for pieces in domain.curves]
    grid = DistanceGrid.of(outlines)
    step = _step_for(grid, sum(_length(outline) for outline in outlines), n, growth)
    rims = [resampled(pieces, step) for pieces in domain.curves]
    rim = np.concatenate(rims)
    points = np.concatenate([rim, scattered(grid, rim, step, growth, random)])
    sides, first = [], 0
    for curve in rims:
        along = np.arange(first, first + len(curve), dtype=np.int32)
        sides.append(np.column_stack([along, np.roll(along, -1)]))
        first += len(curve)
    mesh = delaunay(points, segments=np.concatenate(sides), holes=domain.holes)
    triangles = mesh.triangles()
    used, number = np.unique(triangles, return_inverse=True)  # near a corner a point may lie outside
    return Mesh(number.reshape(triangles.shape), mesh.points[used])


def _length(outline: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> float:
    return float(np.hypot(*(outline - np.roll(outline, 1, axis=0)).T).sum())


def _step_for(grid: DistanceGrid, length: float, n: int, growth: float) -> float:
    """The distance between points at the rim that makes about `n` of them, by bisection."""
    distance = grid.values[grid.values > 0.0]

    def count(step: float) -> float:
        inside = _POINTS_A_SQUARE * grid.cell**2 / spacing(distance, step, growth) ** 2
        return float(inside.sum()) + length / step

    low, high = length / _MOST_STEPS, length
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if count(middle) > n else (low, middle)
    return high
