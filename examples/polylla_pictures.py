"""Polylla: join the triangles of a lake with islands and of a gear into polygons, judge them and draw them.

``python examples/polylla_pictures.py docs/images`` draws the pictures of the documentation.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from PIL import Image

import halfmesh as hm


def draw(polygons: hm.Mesh, triangles: hm.Mesh, path: Path) -> None:
    hm.viewer.save_polygons_plot(polygons, path, triangulation=triangles)
    Image.open(path).convert("RGB").quantize(256).save(path, optimize=True)  # a third of the size


def main(folder: Path) -> None:
    domains = {
        "seed": hm.shapes.seed_triangulation(),
        "lake": hm.shapes.lake(700, islands=4, seed=1),
        "gear": hm.shapes.gear(900, teeth=16),
    }
    for name, triangles in domains.items():
        polygons, report = hm.polylla(triangles, report=True)
        summary = hm.geometry.polygon_quality(polygons).summary()
        print(f"{name}: {report.n_triangles:,} triangles became {report.n_polygons:,} polygons\n{summary}\n")
        path = folder / f"polylla-{name}.png"
        draw(polygons, triangles, path)
        assert polygons.n_faces == report.n_polygons == summary.n_polygons
        assert polygons.n_boundary_loops == triangles.n_boundary_loops
        assert abs(hm.geometry.area(polygons) - hm.geometry.area(triangles)) < 1e-12
        assert path.stat().st_size < 200_000


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        main(Path(sys.argv[1] if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir() else temporary))
