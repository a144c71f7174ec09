"""Meshes drawn by matplotlib."""

from __future__ import annotations

import matplotlib
import numpy as np
import pytest

import halfmesh as hm

matplotlib.use("Agg")


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    import matplotlib.pyplot as plt

    plt.close("all")


def test_flat_mesh_is_drawn_in_the_plane_with_every_face():
    ax = hm.viewer.plot(hm.shapes.grid(3, 2))
    assert ax.name == "rectilinear"
    assert len(ax.collections[0].get_paths()) == 6


def test_mesh_in_space_is_drawn_in_space_and_colored_by_value(tmp_path):
    mesh = hm.shapes.icosphere(1)
    ax = hm.viewer.plot(mesh, values=np.arange(mesh.n_faces))
    assert ax.name == "3d"
    ax.figure.savefig(tmp_path / "sphere.png")
    assert ax.collections[0].get_array().tolist() == list(range(80))
    assert (tmp_path / "sphere.png").stat().st_size > 1000


def test_axes_of_ones_own_are_drawn_into():
    import matplotlib.pyplot as plt

    _, mine = plt.subplots()
    assert hm.viewer.plot(hm.shapes.disk(2, 6), ax=mine) is mine


def test_mesh_without_faces_and_wrong_values_are_refused():
    with pytest.raises(hm.PreconditionError, match="0 faces"):
        hm.viewer.plot(hm.Mesh([], n_vertices=3))
    with pytest.raises(hm.PreconditionError, match="one for each face"):
        hm.viewer.plot(hm.shapes.cube(), values=[1.0])
