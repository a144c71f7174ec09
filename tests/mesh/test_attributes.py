"""Named arrays on vertices, halfedges, edges and faces."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm

TABLES = {"vertex_data": 8, "halfedge_data": 24, "edge_data": 12, "face_data": 6}


@pytest.fixture
def mesh():
    return hm.testing.zoo()["cube"].mesh()


@pytest.mark.parametrize(("table", "n"), TABLES.items())
def test_attribute_has_a_row_for_each_element(mesh, table, n):
    values = getattr(mesh, table).add("x", np.float32, (2,), default=(1, 2))
    assert (values.shape, values.dtype) == ((n, 2), np.float32)
    assert values[n - 1].tolist() == [1, 2]


@pytest.mark.parametrize(("table", "n"), TABLES.items())
def test_assignment_copies_and_reading_gives_a_view(mesh, table, n):
    data, values = getattr(mesh, table), np.arange(n)
    data["x"] = values
    values[:] = -1
    data["x"][0] = 99
    assert data["x"].tolist() == [99, *range(1, n)]


@pytest.mark.parametrize("wrong", [np.zeros(7), np.zeros((0, 3)), 5, np.zeros((2, 8))])
def test_wrong_number_of_rows_is_refused(mesh, wrong):
    with pytest.raises(ValueError, match="8 rows"):
        mesh.vertex_data["x"] = wrong
    assert "x" not in mesh.vertex_data


def test_table_behaves_like_a_dictionary(mesh):
    mesh.face_data["a"] = np.zeros(6)
    mesh.face_data.update(b=np.ones(6, dtype=bool))
    assert (list(mesh.face_data), len(mesh.face_data), "a" in mesh.face_data) == (["a", "b"], 2, True)
    assert mesh.face_data.pop("a").tolist() == [0] * 6
    assert repr(mesh.face_data) == "<face data of 6: b: bool>"
    with pytest.raises(KeyError, match="there are: 'b'"):
        mesh.face_data["a"]
    with pytest.raises(KeyError):
        del mesh.face_data["a"]


def test_name_can_be_added_once(mesh):
    mesh.face_data.add("a")
    with pytest.raises(KeyError, match="exists already"):
        mesh.face_data.add("a")


@pytest.mark.parametrize("name", ["", 3, None])
def test_name_is_a_text(mesh, name):
    with pytest.raises(KeyError, match="non-empty"):
        mesh.face_data[name] = np.zeros(6)


def test_points_are_the_attribute_that_always_exists(mesh):
    assert mesh.vertex_data["points"].tolist() == mesh.points.tolist()
    with pytest.raises(KeyError, match="always exists"):
        del mesh.vertex_data["points"]
    with pytest.raises(ValueError, match="stays float64"):
        mesh.vertex_data["points"] = np.zeros((8, 2))
    with pytest.raises(ValueError, match="stays float64"):
        mesh.vertex_data["points"] = np.zeros((8, 3), dtype=np.float32)


def test_python_objects_are_refused(mesh):
    for values in (np.full(6, None), [{}] * 6):
        with pytest.raises(TypeError, match="numbers"):
            mesh.face_data["x"] = values
    with pytest.raises(TypeError):
        mesh.face_data.add("x", object)


def test_values_are_kept_in_the_byte_order_of_the_machine(mesh):
    """So that kernels take what files of the other order bring."""

    @hm.kernel
    def double(values):
        for i in range(len(values)):
            values[i] = 2 * values[i]

    mesh.face_data["x"] = np.arange(6, dtype=">f8")
    mesh.face_data.add("y", ">i4")
    assert (mesh.face_data["x"].dtype, mesh.face_data["y"].dtype) == (np.dtype("=f8"), np.dtype("=i4"))
    double(mesh.face_data["x"])
    assert mesh.face_data["x"].tolist() == [0, 2, 4, 6, 8, 10]


def test_default_is_kept_for_elements_to_come(mesh):
    mesh.edge_data.add("x", int, default=3)
    mesh.edge_data["x"] = np.zeros(12, dtype=int)
    assert mesh.edge_data.column("x").default == 3


def test_memory_of_attributes_is_counted(mesh):
    assert mesh.vertex_data.nbytes == 8 * 3 * 8
    mesh.vertex_data.add("x", np.uint8)
    assert mesh.vertex_data.nbytes == 8 * 3 * 8 + 8


def test_all_others_follow_once_where_the_formula_of_one_attribute_raises():
    def formula(values, weights):
        raise ZeroDivisionError

    mesh = hm.shapes.icosphere(1)
    mesh.vertex_data.add("bad", float, policy=formula)
    mesh.vertex_data.add("mass", float, policy="sum")[:] = 1.0
    mesh.edge_data.add("length", float, policy="sum")[:] = 1.0
    n, n_edges = mesh.n_vertices, mesh.n_edges
    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            mesh.split_edge(0)
        with pytest.raises(ZeroDivisionError):
            mesh.collapse(mesh.halfedges[40])
        mesh.compact()
    assert mesh.vertex_data["mass"].sum() == n
    assert np.isclose(mesh.edge_data["length"].sum(), n_edges - 2)
    mesh.check()
