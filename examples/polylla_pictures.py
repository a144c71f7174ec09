"""Polylla: triangulate a lake with islands and a gear, join the triangles into polygons, judge and draw them.

``python examples/polylla_pictures.py docs/images`` draws the pictures of the documentation.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

import halfmesh as hm


def ring(radius, n, center=(0.0, 0.0)):
    """A closed curve: `n` points equally far apart, at the distance from the center that each angle has."""
    angles = np.linspace(0, 2 * np.pi, 40 * n + 1)
    curve = (radius(angles) * [np.cos(angles), np.sin(angles)]).T + center
    way = np.cumsum(np.linalg.norm(np.diff(curve, axis=0, prepend=curve[:1]), axis=1))
    stops = np.linspace(0, way[-1], n, endpoint=False)
    return np.column_stack([np.interp(stops, way, curve[:, i]) for i in (0, 1)])


def triangulated_domain(rings, holes, n_darts, seed=0):
    """Triangles between the rings, larger away from them: darts are thrown, and those that find room are kept."""
    firsts = np.cumsum([0] + [len(r) for r in rings])
    sides = np.concatenate([f + np.column_stack([np.arange(n), np.arange(1, n + 1) % n])
                            for f, n in zip(firsts, map(len, rings), strict=False)])  # fmt: skip
    spacing = np.linalg.norm(rings[0][1] - rings[0][0])
    points = np.concatenate(rings)
    n_fixed, rng = len(points), np.random.default_rng(seed)
    for dart in rng.uniform(points.min(axis=0), points.max(axis=0), (n_darts, 2)):
        gaps = np.linalg.norm(points - dart, axis=1)
        if gaps.min() > 0.8 * spacing + 0.2 * gaps[:n_fixed].min():
            points = np.vstack([points, dart])
    return hm.delaunay(points, segments=sides, holes=holes)


def lake():
    def shore(a):
        return 1 + 0.16 * np.sin(2 * a + 0.4) + 0.1 * np.sin(3 * a) + 0.05 * np.sin(7 * a + 1) + 0.025 * np.sin(13 * a)

    islands = [((-0.35, 0.25), 0.2, 0.0), ((0.42, 0.3), 0.13, 1.0), ((0.15, -0.45), 0.16, 2.0)]
    rings = [
        ring(lambda a, r=size, b=turn: r * (1 + 0.25 * np.sin(2 * a + b) + 0.12 * np.sin(5 * a)), int(220 * size), at)
        for at, size, turn in islands
    ]
    return triangulated_domain([ring(shore, 190), *rings], [at for at, *_ in islands], 6000)


def gear(teeth=14):
    def rim(a):
        return 1 + 0.1 * np.tanh(5 * np.sin(teeth * a))

    bores = [(0.0, 0.0)] + [(0.56 * np.cos(a), 0.56 * np.sin(a)) for a in np.arange(6) * np.pi / 3]
    rings = [ring(lambda a, r=0.14 if i else 0.25: r + 0 * a, 30 if i else 48, at) for i, at in enumerate(bores)]
    return triangulated_domain([ring(rim, 20 * teeth), *rings], bores, 6000)


def draw(polygons, triangles, path):
    hm.viewer.save_polygons_plot(polygons, path, triangulation=triangles)
    Image.open(path).convert("RGB").quantize(128).save(path, optimize=True)  # a third of the size


def main(folder):
    for name, triangles in (("seed", hm.shapes.seed_triangulation()), ("lake", lake()), ("gear", gear())):
        polygons, report = hm.polylla(triangles, report=True)
        summary = hm.geometry.polygon_quality(polygons).summary()
        print(f"{name}: {report.n_triangles:,} triangles became {report.n_polygons:,} polygons\n{summary}\n")
        draw(polygons, triangles, Path(folder) / f"polylla-{name}.png")
        assert polygons.n_faces == report.n_polygons == summary.n_polygons
        assert polygons.n_boundary_loops == triangles.n_boundary_loops
        assert abs(hm.geometry.area(polygons) - hm.geometry.area(triangles)) < 1e-12
        assert (Path(folder) / f"polylla-{name}.png").stat().st_size < 200_000


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        main(sys.argv[1] if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir() else temporary)
