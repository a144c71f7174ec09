"""What all measures promise: one result in every gear and on any number of threads, and none of the usual accidents."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm
from halfmesh._jit import compiling_always
from halfmesh.core.topology import DELETED, N_DEAD_FACES, N_DEAD_VERTICES
from halfmesh.geometry._passes import points_of

g = hm.geometry
ORDER = {"edge_vectors": 1, "edge_lengths": 1, "face_areas": 2, "face_vectors": 2, "area": 2, "volume": 3}


def test_compiled_and_interpreted_give_the_same_bits(animal, measure, monkeypatch):
    with compiling_always():
        compiled = measure(animal)
    monkeypatch.setattr("halfmesh._jit.gears.interpret_only", True)
    assert np.asarray(measure(animal)).tobytes() == np.asarray(compiled).tobytes()


@pytest.mark.large
def test_threads_do_not_change_a_bit(measure, monkeypatch):
    mesh = hm.shapes.torus(300, 200)
    mesh.points += np.random.default_rng(0).normal(scale=0.001, size=mesh.points.shape)
    results = []
    for n in (1, 3):
        monkeypatch.setattr("halfmesh.geometry._passes.n_threads", lambda n=n: n)
        results.append(np.asarray(measure(mesh)).tobytes())
    assert results[0] == results[1]


def test_nothing_is_changed(animal, measure):
    before = animal.points.copy(), animal.revision
    measure(animal)
    assert np.array_equal(animal.points, before[0])
    assert animal.revision == before[1]


@pytest.mark.parametrize("place", [lambda p: p * 0, lambda p: p * [1, 0, 0], lambda p: p * 0 + 1e9])
def test_a_mesh_without_extent_measures_without_nan_or_warning(animal, measure, place):
    animal.points = place(animal.points)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert np.isfinite(measure(animal)).all()


@pytest.mark.parametrize("scale", [2.0**-498, 2.0**498])
def test_tiny_and_huge_meshes_measure_alike(measure, scale):
    """1e-150 and 1e150: powers of two, so that nothing is rounded."""
    mesh = hm.shapes.icosphere(1)
    expected = np.asarray(measure(mesh))
    order = ORDER.get(measure.__name__, 1 if "center" in measure.__name__ or "centroid" in measure.__name__ else 0)
    mesh.points *= scale
    assert np.allclose(np.asarray(measure(mesh)) / scale**order, expected, rtol=1e-12, atol=1e-13)


def test_kernels_get_points_in_one_form_so_that_they_are_compiled_once():
    class Odd(hm.Mesh):
        points = np.asfortranarray(np.arange(9, dtype=">f4").reshape(3, 3))

    Odd.points.flags.writeable = False
    points = points_of(Odd([[0, 1, 2]]))
    assert points.tolist() == Odd.points.tolist()
    assert (points.dtype, points.flags.c_contiguous, points.flags.writeable) == (np.float64, True, True)
    assert points_of(hm.shapes.cube()).base is not None  # no copy where none is needed


def two_triangles():
    return hm.Mesh([[0, 1, 2], [3, 4, 5]], np.random.default_rng(0).normal(size=(6, 3)))


def with_one_triangle_deleted():
    """The second of two triangles is marked as deleted, by hand."""
    mesh = two_triangles()
    a = mesh.topology.__arrays__()
    a.next[6:] = a.prev[6:] = DELETED
    a.face[6:] = -1
    a.vertex_halfedge[3:] = a.face_halfedge[1] = DELETED
    a.counts[N_DEAD_VERTICES], a.counts[N_DEAD_FACES] = 3, 1
    return mesh


def test_rows_are_slots_and_those_of_the_deleted_are_zero(measure):
    mesh = with_one_triangle_deleted()
    whole, half = np.asarray(measure(two_triangles())), np.asarray(measure(mesh))
    if measure is g.area:
        assert half == g.face_areas(mesh)[0] > 0
    else:
        living = len(whole) // 2
        assert np.array_equal(half[:living], whole[:living])
        assert not half[living:].any()


def test_the_deleted_are_not_in_the_bounding_box():
    mesh = with_one_triangle_deleted()
    assert g.bounding_box(mesh).tolist() == [mesh.points[:3].min(axis=0).tolist(), mesh.points[:3].max(axis=0).tolist()]


def rotation_about(axis, angle):
    """Rodrigues' formula; the rows of points are turned by multiplying from the right."""
    x, y, z = np.divide(axis, np.linalg.norm(axis))
    k = np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


angles = st.floats(-3, 3)
axes = st.tuples(st.integers(1, 5), st.integers(-5, 5), st.integers(-5, 5))
offsets = st.floats(-100, 100)


@given(axes, angles, st.tuples(offsets, offsets, offsets), st.integers(0, 99))
def test_rigid_motion_turns_vectors_moves_points_and_leaves_numbers(axis, angle, shift, seed):
    mesh = hm.shapes.torus(5, 4)
    mesh.points += np.random.default_rng(seed).normal(scale=0.1, size=mesh.points.shape)
    moved = mesh.copy()
    rotation = rotation_about(axis, angle)
    moved.points = mesh.points @ rotation + shift
    for numbers in (g.edge_lengths, g.face_areas, g.corner_angles, g.area, g.volume):
        assert np.allclose(numbers(moved), numbers(mesh), atol=1e-9)
    quality, same = (g.polygon_quality(m).as_dict().values() for m in (moved, mesh))
    assert np.allclose(list(quality), list(same), atol=1e-9)
    for vectors in (g.edge_vectors, g.face_vectors, g.face_normals, g.vertex_normals):
        assert np.allclose(vectors(moved), vectors(mesh) @ rotation, atol=1e-9)
    for centers in (g.face_barycenters, g.face_centroids):
        assert np.allclose(centers(moved), centers(mesh) @ rotation + shift, atol=1e-9)
    assert np.allclose(g.centroid(moved), g.centroid(mesh) @ rotation + shift, atol=1e-9)


def test_formulas_for_one_element_agree_with_the_arrays(animal):
    t, points = animal.topology, animal.points
    for name, of in (("edge_length", g.edge_lengths), ("edge_vector", g.edge_vectors), ("face_area", g.face_areas),
                     ("face_normal", g.face_normals), ("face_vector", g.face_vectors),
                     ("face_centroid", g.face_centroids), ("face_barycenter", g.face_barycenters),
                     ("corner_angle", g.corner_angles)):  # fmt: skip
        formula = getattr(g.kernels, name).interpreted
        rows = [formula(t, points, i) for i in range(len(of(animal)))]
        assert np.allclose(rows, of(animal).reshape(np.shape(rows)), atol=1e-13), name


def test_no_kernel_reads_through_a_minus_one(animal, measure, monkeypatch):
    """With views that refuse negative indices."""
    monkeypatch.setattr("halfmesh._jit.gears.interpret_only", True)
    monkeypatch.setattr("halfmesh._jit.gears.strict", True)
    measure(animal.copy())
