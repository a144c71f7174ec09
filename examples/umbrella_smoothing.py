"""Umbrella smoothing: every interior vertex moves to the mean of its neighbors; the boundary stays."""

from __future__ import annotations

import numpy as np

import halfmesh as hm
from halfmesh import is_boundary_vertex, neighbors, vertex_slots


@hm.kernel
def smooth(t, points, out):
    for v in range(vertex_slots(t)):
        x = y = z = 0.0
        n = 0
        for u in neighbors(t, v):
            x += points[u, 0]
            y += points[u, 1]
            z += points[u, 2]
            n += 1
        if n == 0 or is_boundary_vertex(t, v):
            x, y, z, n = points[v, 0], points[v, 1], points[v, 2], 1
        out[v, 0] = x / n
        out[v, 1] = y / n
        out[v, 2] = z / n


def main() -> None:
    mesh = hm.shapes.icosphere(3)
    noise = np.random.default_rng(0).normal(scale=0.02, size=mesh.points.shape)
    rough = mesh.points + noise
    smoothed = np.empty_like(rough)
    smooth(mesh, rough, smoothed)

    def roughness(points: np.ndarray) -> float:
        return float(np.std(np.linalg.norm(points, axis=1)))

    print(f"deviation from the sphere: {roughness(rough):.4f} before, {roughness(smoothed):.4f} after")
    assert roughness(smoothed) < 0.6 * roughness(rough)


if __name__ == "__main__":
    main()
