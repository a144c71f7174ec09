"""A mesh of polygons from triangles: longest edges joined, and the data of the triangles gathered by polygon."""

from __future__ import annotations

import numpy as np

import halfmesh as hm


def jittered_grid(n: int, seed: int = 0) -> hm.Mesh:
    """A grid of triangles whose inner vertices are moved by chance."""
    mesh = hm.shapes.grid(n, triangles=True)
    inner = [v.index for v in mesh.vertices if not v.is_boundary]
    mesh.points[inner, :2] += np.random.default_rng(seed).uniform(-0.2, 0.2, (len(inner), 2))
    return mesh


def main() -> None:
    mesh = jittered_grid(60)
    polygons, report = hm.polylla(mesh, report=True)
    print(report)

    areas = np.bincount(report.triangle_polygon, weights=hm.geometry.face_areas(mesh))
    print(f"corners: {np.bincount(polygons.face_degrees())[3:].tolist()} polygons with 3, 4, 5 ... of them")

    assert np.allclose(areas, hm.geometry.face_areas(polygons))
    assert polygons.euler_characteristic == mesh.euler_characteristic == 1
    assert all(len({v.index for v in f.vertices()}) == f.degree >= 3 for f in polygons.faces)


if __name__ == "__main__":
    main()
