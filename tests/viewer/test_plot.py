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


def test_polygons_are_colored_by_their_sides_above_the_triangles():
    triangles = hm.shapes.seed_triangulation()
    ax = hm.viewer.plot_polygons(hm.polylla(triangles), triangulation=triangles)
    faces, below, outlines = ax.collections
    assert len(np.unique(faces.get_facecolor(), axis=0)) == 4
    assert (len(below.get_segments()), len(outlines.get_segments())) == (triangles.n_edges, 15)
    assert [text.get_text() for text in ax.get_legend().texts] == ["3  (1)", "4  (2)", "5  (1)", "6  (1)"]


def test_many_sides_share_a_color_and_two_have_the_first():
    mesh = hm.Mesh([range(11), range(11, 28)], np.random.default_rng(0).random((28, 2)))
    ax = hm.viewer.plot_polygons(mesh)
    assert [text.get_text() for text in ax.get_legend().texts] == ["9 to 11  (1)", "16 or more  (1)"]
    loop = hm.Mesh([[0, 1, 2], [2, 1, 0]], np.eye(3))
    assert not hm.viewer.plot_polygons(loop, legend=False).get_legend()


def test_polygons_in_space_and_every_kind_of_picture(tmp_path):
    for suffix in (".png", ".svg", ".PDF"):
        hm.viewer.save_polygons_plot(hm.shapes.dodecahedron(), tmp_path / f"it{suffix}")
        assert (tmp_path / f"it{suffix}").stat().st_size > 1000
    with pytest.raises(hm.FormatError, match="no suffix says"):
        hm.viewer.save_polygons_plot(hm.shapes.dodecahedron(), tmp_path / "it")


def test_vertices_of_no_face_make_no_room():
    mesh = hm.Mesh([[0, 1, 2]], [[0, 0], [1, 0], [0, 1], [50, 50]])
    assert hm.viewer.plot(mesh).get_xlim()[1] < 1.1
