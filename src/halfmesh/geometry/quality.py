"""How good the shapes of polygons are, as those who solve equations on them measure it."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.circulation import face_halfedges
from halfmesh.core.navigation import face_slots, halfedge_of_face, origin_of, prev_of, twin_of
from halfmesh.geometry._passes import Floats, points_of, run
from halfmesh.geometry._quality_summary import QualitySummary, summarized
from halfmesh.geometry._vectors import Vector, difference, dot, length, point, unit
from halfmesh.geometry._visible import area_inside, area_seeing_all
from halfmesh.geometry.angles import FULL_TURN
from halfmesh.geometry.kernels import angle_from, face_vector

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["PolygonQuality", "QualitySummary", "polygon_quality"]

ROUNDING = 1e-9  # a kernel that lacks less of its polygon than this is all of it
NOTHING = 1e-12  # a kernel smaller than this part of its polygon is a segment or a point, measured with rounding errors


@dataclass(frozen=True, eq=False)
class PolygonQuality:
    """The shapes of the faces of a mesh, see :func:`polygon_quality`; row `i` belongs to the face in slot `i`.

    Attributes
    ----------
    n_sides : ndarray of int32, shape (n face slots,)
        The number of sides; 0 for a deleted face, as are its other rows.
    min_angle, max_angle : ndarray of float64
        The smallest and the largest interior angle, in radians from 0 to 2 pi.
    edge_ratio : ndarray of float64
        The shortest side over the longest, 0 to 1.
    area_perimeter_ratio : ndarray of float64
        4 pi area / perimeter^2: 1 for a disk, pi/4 for a square, near 0 for what is thin or ragged.
    kernel_ratio : ndarray of float64
        The area of the kernel over the area of the polygon. The kernel are the points that see the whole polygon: 1
        for a convex polygon, 0 for one that is not star-shaped.
    convex : ndarray of bool
        Whether the kernel is the whole polygon, but for rounding errors (a part of 1e-9).
    """

    n_sides: NDArray[np.int32]
    min_angle: Floats
    max_angle: Floats
    edge_ratio: Floats
    area_perimeter_ratio: Floats
    kernel_ratio: Floats
    convex: NDArray[np.bool_]

    def as_dict(self) -> dict[str, NDArray[Any]]:
        """The arrays by their names."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def summary(self) -> QualitySummary:
        """Least, mean and greatest of each measure over the faces that are not deleted; ``print`` it for a table."""
        return summarized(self.as_dict())

    def __repr__(self) -> str:
        return f"<PolygonQuality of {np.count_nonzero(self.n_sides):,} polygons>"


def polygon_quality(mesh: Mesh) -> PolygonQuality:
    """Measure the shape of every face: its angles, sides, roundness and what can be seen from inside.

    Parameters
    ----------
    mesh : Mesh
        Faces of any degree. A face that isn't flat is measured by its shadow along its normal
        (:func:`face_vectors`); one that crosses itself is given numbers that mean little.

    Returns
    -------
    PolygonQuality
        An array for each measure. All are free of units: moving, turning and scaling the points changes nothing. A
        face without area has 0 everywhere.

    Notes
    -----
    The measures are those by which polygons are judged for the virtual element method and its kin, whose theory asks
    for star-shaped polygons without short sides: smallest and largest angle, edge ratio, area-perimeter ratio,
    kernel-area ratio. The area-perimeter ratio is normalized differently by different authors; ``sqrt(area) /
    perimeter``, for one, is ``sqrt(ratio / (4 pi))``.

    The kernel is cut out of the polygon's bounding box by the lines through its sides. O(n) for polygons of bounded
    degree, on all threads; a polygon of k sides that is not convex takes O(k m), where m <= k + 4 is the number of
    sides that the kernel has on the way.

    References
    ----------
    M. Attene, S. Biasotti, S. Bertoluzza, D. Cabiddu, M. Livesu, G. Patanè, M. Pennacchio, D. Prada, M. Spagnuolo,
    "Benchmark of polygon quality metrics for polytopal element methods", arXiv:1906.01627 (2019), and in "The Virtual
    Element Method and its Applications", SEMA SIMAI Springer Series 31 (2022).

    Examples
    --------
    >>> import halfmesh as hm
    >>> letter_l = hm.Mesh([range(6)], [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]])
    >>> quality = hm.geometry.polygon_quality(letter_l)
    >>> quality.kernel_ratio.round(9).tolist(), quality.convex.tolist()
    ([0.2], [False])
    >>> print(hm.geometry.polygon_quality(hm.shapes.grid(2, 2)).summary())
    polygons                 4
      convex                 4 (100.0%)
      star-shaped            4 (100.0%)
                             least   mean  greatest
    sides                        4   4.00         4
    smallest angle, degrees   90.0   90.0      90.0
    largest angle, degrees    90.0   90.0      90.0
    edge ratio               1.000  1.000     1.000
    area-perimeter ratio     0.785  0.785     0.785
    kernel ratio             1.000  1.000     1.000
    """
    t = mesh.topology
    n = face_slots(t)
    degrees = mesh.face_degrees()
    room = int(degrees.max(initial=0)) + 4  # a kernel may have all sides of its polygon, and those of the box
    least, largest, edge_ratios, roundness, visible = (np.zeros(n) for _ in range(5))
    measures = (least, largest, edge_ratios, roundness, visible)
    run(_polygon_quality, n, t, points_of(mesh), *measures, scratch=lambda: tuple(np.empty(room) for _ in range(6)))
    sides = degrees.astype(np.int32, copy=False)
    return PolygonQuality(sides, least, largest, edge_ratios, roundness, visible, visible >= 1.0 - ROUNDING)


@kernel
def _polygon_quality(
    t: Any, points: Any, least: Any, largest: Any, edge_ratios: Any, roundness: Any, visible: Any,
    x: Any, y: Any, ax: Any, ay: Any, bx: Any, by: Any, low: int, high: int,
) -> None:  # fmt: skip
    for f in range(low, high):
        if halfedge_of_face(t, f) < 0:
            continue
        n = _flatten(t, points, f, x, y)
        area = area_inside(x, y, n)
        if n == 0 or area <= 0.0:
            continue
        edge_ratios[f], perimeter = _sides(x, y, n)
        roundness[f] = 4.0 * math.pi * (area / perimeter) / perimeter
        least[f], largest[f], total = _angles(t, f, x, y, n)
        if largest[f] <= math.pi and abs(total - (n - 2) * math.pi) < 1.0:  # no corner inward, and once around
            visible[f] = 1.0
        else:
            ratio = area_seeing_all(x, y, n, ax, ay, bx, by) / area
            visible[f] = min(ratio, 1.0) if ratio > NOTHING else 0.0


@kernel
def _flatten(t: Any, points: Any, f: int, x: Any, y: Any) -> int:
    """Write the corners of face `f` in coordinates of its plane, from its first corner; 0 if it has no plane."""
    normal = unit(face_vector(t, points, f))
    if not length(normal) > 0.0:
        return 0
    right, up = _across(normal)
    corner = point(points, origin_of(t, halfedge_of_face(t, f)))
    n = 0
    size = 0.0
    for h in face_halfedges(t, f):
        arm = difference(point(points, origin_of(t, h)), corner)
        x[n], y[n] = dot(arm, right), dot(arm, up)
        size = max(size, abs(x[n]), abs(y[n]))
        n += 1
    if size > 0.0 and not 1e-100 < size < 1e100:  # else products overflow or vanish
        for i in range(n):
            x[i], y[i] = x[i] / size, y[i] / size
    return n


@kernel
def _across(normal: Vector) -> tuple[Vector, Vector]:
    """Two units that make a right-handed system with a third; exact if that is along an axis.

    T. Duff and others, "Building an orthonormal basis, revisited", Journal of Computer Graphics Techniques 6 (2017).
    """
    nx, ny, nz = normal
    sign = 1.0 if nz >= 0.0 else -1.0
    a = -1.0 / (sign + nz)
    b = nx * ny * a
    return (1.0 + sign * nx * nx * a, sign * b, -sign * nx), (b, sign + ny * ny * a, -ny)


@kernel
def _sides(x: Any, y: Any, n: int) -> tuple[float, float]:
    """The shortest side over the longest, and the perimeter."""
    perimeter = longest = 0.0
    shortest = math.inf
    i = n - 1
    for j in range(n):
        dx, dy = x[j] - x[i], y[j] - y[i]
        side = math.sqrt(dx * dx + dy * dy)
        perimeter += side
        shortest, longest = min(shortest, side), max(longest, side)
        i = j
    return shortest / longest, perimeter


@kernel
def _angles(t: Any, f: int, x: Any, y: Any, n: int) -> tuple[float, float, float]:
    """The smallest and the largest angle, and the sum of all."""
    least, largest, total = math.inf, 0.0, 0.0
    i, j = n - 1, 0
    for h in face_halfedges(t, f):
        k = j + 1 if j + 1 < n else 0
        ax, ay, bx, by = x[k] - x[j], y[k] - y[j], x[i] - x[j], y[i] - y[j]
        sine, cosine = ax * by - ay * bx, ax * bx + ay * by
        if prev_of(t, h) == twin_of(t, h):
            sine, cosine = FULL_TURN, 1.0
        angle = angle_from(sine, cosine)
        least, largest, total = min(least, angle), max(largest, angle), total + angle
        i, j = j, k
    return least, largest, total
