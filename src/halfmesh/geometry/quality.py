"""How good polygons are as elements: what the virtual element method and its kin ask of their shapes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.navigation import halfedge_of_face
from halfmesh.geometry._passes import Floats, points_of, run
from halfmesh.geometry._shape import COLUMNS, shape_of

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["PolygonQuality", "QualitySummary", "polygon_quality"]


def polygon_quality(mesh: Mesh) -> PolygonQuality:
    """Measure the shape of every face.

    Parameters
    ----------
    mesh : Mesh
        Faces of any degree, flat or nearly so: each is measured on the plane of its normal (Newell's).

    Returns
    -------
    PolygonQuality
        An array for each measure; ``print(quality.summary())`` is a table.

    Notes
    -----
    O(k) for a convex face of k sides; for others O(k m), where the part of the kernel found so far has m corners, at
    the worst O(k^2). On all threads; a million polygons of Polylla take about a second.

    References
    ----------
    M. Attene, S. Biasotti, S. Bertoluzza and others, "Benchmark of polygon quality metrics for polytopal element
    methods", in "The Virtual Element Method and its Applications", SEMA SIMAI Springer Series 31, 2022. The kernel:
    D. T. Lee, F. P. Preparata, "An optimal algorithm for finding the kernel of a polygon", Journal of the ACM 26, 1979.

    Examples
    --------
    >>> import numpy as np, halfmesh as hm
    >>> ell = hm.Mesh([[0, 1, 2, 3, 4, 5]], [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]])
    >>> quality = hm.geometry.polygon_quality(ell)
    >>> quality.convex.tolist(), np.degrees(quality.max_angle).tolist(), quality.edge_ratio.tolist()
    ([False], [270.0], [0.5])
    >>> float(quality.kernel_ratio[0].round(9))  # seen from the square at the corner: 1 of 3
    0.333333333
    """
    t = mesh.topology
    n = len(t.face_halfedge)
    degrees = mesh.face_degrees()
    most = int(degrees.max(initial=3))
    table = np.zeros((n, len(COLUMNS)))

    def scratch() -> tuple[Floats, Floats, Floats]:
        return np.empty((2, most)), np.empty((2, most + 4)), np.empty((2, most + 4))

    run(_shapes, n, t, points_of(mesh), table, scratch=scratch)
    columns: dict[str, Any] = {name: table[:, i].copy() for i, name in enumerate(COLUMNS)}
    columns["convex"] = columns["convex"] > 0
    return PolygonQuality(degrees, **columns)


@dataclass(frozen=True, eq=False)
class PolygonQuality:
    """The measures of :func:`polygon_quality`; row `f` of each is face `f`. None depends on size, place or direction.

    Attributes
    ----------
    degree : ndarray of int, shape (n face slots,)
        The number of sides; 0 for deleted faces.
    min_angle, max_angle : ndarray of float64, shape (n face slots,)
        The smallest and the largest angle inside, in radians up to 2 pi.
    edge_ratio : ndarray of float64, shape (n face slots,)
        The shortest side over the longest, at most 1.
    area_perimeter_ratio : ndarray of float64, shape (n face slots,)
        ``4 pi area / perimeter^2``: 1 for a circle, less for all else; pi / 4 for a square.
    convex : ndarray of bool, shape (n face slots,)
        No corner turns inward (by a sine of more than 1e-12); straight ones don't matter.
    kernel_ratio : ndarray of float64, shape (n face slots,)
        The area of the kernel, which are the places inside from where all of the polygon is seen, over its area: 1 for
        convex polygons, 0 for those that are not star-shaped.

    Notes
    -----
    A face without area has 0 everywhere, and so have rows of deleted faces.
    """

    degree: NDArray[Any]
    min_angle: Floats
    max_angle: Floats
    edge_ratio: Floats
    area_perimeter_ratio: Floats
    kernel_ratio: Floats
    convex: NDArray[np.bool_]

    def summary(self) -> QualitySummary:
        """The least, the mean and the largest of each measure over the living faces."""
        living = self.degree > 0
        rows: dict[str, tuple[float, float, float]] = {}
        for name, label, unit in _ROWS:
            values = unit * getattr(self, name)[living]
            rows[label] = (float(values.min()), float(values.mean()), float(values.max())) if len(values) else _NONE
        n = int(living.sum())
        return QualitySummary(
            n_polygons=n,
            measures=rows,
            convex_share=float(self.convex[living].mean()) if n else 0.0,
            star_shaped_share=float((self.kernel_ratio[living] > 0).mean()) if n else 0.0,
        )


_NONE = (0.0, 0.0, 0.0)
_ROWS = (
    ("degree", "sides", 1.0),
    ("min_angle", "smallest angle, degrees", 180.0 / np.pi),
    ("max_angle", "largest angle, degrees", 180.0 / np.pi),
    ("edge_ratio", "edge ratio", 1.0),
    ("area_perimeter_ratio", "area-perimeter ratio", 1.0),
    ("kernel_ratio", "kernel ratio", 1.0),
)


@dataclass(frozen=True)
class QualitySummary:
    """What :class:`PolygonQuality` says of a whole mesh; printed, a table.

    Attributes
    ----------
    n_polygons : int
    measures : dict of str to (float, float, float)
        Least, mean and largest of each measure, by its label; angles in degrees.
    convex_share, star_shaped_share : float
        Of the polygons, from 0 to 1.

    Examples
    --------
    >>> import halfmesh as hm
    >>> print(hm.geometry.polygon_quality(hm.shapes.grid(3)).summary())
    9 polygons                   least     mean  largest
    sides                            4        4        4
    smallest angle, degrees         90       90       90
    largest angle, degrees          90       90       90
    edge ratio                       1        1        1
    area-perimeter ratio         0.785    0.785    0.785
    kernel ratio                     1        1        1
    convex                                100%
    star-shaped                           100%
    """

    n_polygons: int
    measures: dict[str, tuple[float, float, float]]
    convex_share: float
    star_shaped_share: float

    def rows(self) -> list[tuple[str, str, str, str]]:
        """The cells of the table, without its head."""
        made = [(label, f"{a:.3g}", f"{b:.3g}", f"{c:.3g}") for label, (a, b, c) in self.measures.items()]
        for label, share in (("convex", self.convex_share), ("star-shaped", self.star_shaped_share)):
            made.append((label, "", f"{100 * share:.4g}%", ""))
        return made

    @property
    def head(self) -> tuple[str, str, str, str]:
        """The first line of the table."""
        return f"{self.n_polygons:,} polygons", "least", "mean", "largest"

    def as_dict(self) -> dict[str, Any]:
        """Plain numbers, for JSON."""
        names = {label: name for name, label, _ in _ROWS}
        made: dict[str, Any] = {"polygons": self.n_polygons}
        for label, (least, mean, largest) in self.measures.items():
            made[names[label]] = {"least": least, "mean": mean, "largest": largest}
        return made | {"convex_share": self.convex_share, "star_shaped_share": self.star_shaped_share}

    def __str__(self) -> str:
        lines = [self.head, *self.rows()]
        return "\n".join(f"{a:<25}{b:>9}{c:>9}{d:>9}".rstrip() for a, b, c, d in lines)


@kernel
def _shapes(t: Any, points: Any, out: Any, p: Any, q: Any, r: Any, low: int, high: int) -> None:
    for f in range(low, high):
        if halfedge_of_face(t, f) >= 0:
            shape_of(t, points, f, p, q, r, out)
