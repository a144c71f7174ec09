"""What measures are tried on: every mesh of the zoo, with points at random."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm

ZOO = hm.testing.zoo()
MEASURES = (
    {
        name: getattr(hm.geometry, name)
        for name in hm.geometry.__all__
        if name.islower() and name not in {"kernels", "volume", "centroid", "bounding_box", "polygon_quality"}
    }
    | {"polygon_quality": lambda mesh: quality_table(mesh)}
    | {"vertex_normals by area": lambda mesh: hm.geometry.vertex_normals(mesh, weights="area")}
)


def quality_table(mesh):
    return np.stack([np.asarray(column) for column in vars(hm.geometry.polygon_quality(mesh)).values()], axis=1)


def randomly_placed(mesh, seed=0):
    mesh.points = np.random.default_rng(seed).normal(size=mesh.points.shape)
    return mesh


@pytest.fixture(params=ZOO.values(), ids=ZOO)
def animal(request):
    """A mesh of the zoo with its vertices anywhere: no face but a triangle is flat."""
    return randomly_placed(request.param.mesh())


@pytest.fixture(params=MEASURES.values(), ids=MEASURES)
def measure(request):
    return request.param
