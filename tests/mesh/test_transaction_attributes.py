"""Transactions and attributes: arrays that are held, columns, policies and notes are as they were."""

from __future__ import annotations

import numpy as np

import halfmesh as hm
from halfmesh.testing import assert_valid
from wandering import RefusedError, everything, fail, furnish


def test_arrays_that_were_held_before_are_watched():
    mesh = hm.shapes.cube()
    rows, row, part = mesh.points, mesh.vertices[3].point, mesh.points[:, 1][::2]
    before = rows.tobytes()
    del rows

    def change(mesh):
        row[:] = 9.0
        part[:] = 8.0

    fail(mesh, change)
    assert mesh.points.tobytes() == before
    row[0] = 5.0
    assert mesh.points[3, 0] == 5.0  # and they are still arrays of the mesh


def test_arrays_held_before_are_arrays_of_the_mesh_after_growth_was_rolled_back():
    mesh = hm.shapes.cube()
    points = mesh.points
    fail(mesh, lambda mesh: mesh.split_face(0))
    points[2] = 4.0
    assert mesh.points[2].tolist() == [4.0, 4.0, 4.0]


def test_held_arrays_can_be_left_out():
    mesh = hm.shapes.cube()
    points = mesh.points

    def change(mesh):
        points[0] = 9.0
        mesh.vertices[1].point = [8.0, 8.0, 8.0]

    fail(mesh, change, include_held=False)
    assert mesh.points[:2].max(axis=1).tolist() == [9.0, 1.0]


def test_column_held_before_is_watched():
    mesh = hm.shapes.cube()
    column = mesh.vertex_data.column("points")
    before = everything(mesh)
    fail(mesh, lambda mesh: column.__setitem__((2, 0), 9.0))
    assert everything(mesh) == before


def test_array_from_an_outer_transaction_is_watched_inside():
    mesh = hm.shapes.cube()
    with mesh.transaction():
        points = mesh.points
        points[0] = 2.0
        fail(mesh, lambda mesh: points.__setitem__(0, 3.0))
        assert points[0, 0] == 2.0


def test_attributes_that_come_and_go_in_it():
    mesh = furnish(hm.shapes.cube())
    before = everything(mesh)

    def change(mesh):
        del mesh.vertex_data["label"]
        mesh.face_data["fresh"] = np.zeros(6)
        mesh.vertex_data["x"] = np.arange(8)  # another dtype
        mesh.points = np.ones((8, 3))
        mesh.vertex_data.set_policy("total", "max")

    fail(mesh, change)
    assert everything(mesh) == before


def test_mesh_without_points_has_none_again():
    mesh = hm.Mesh([[0, 1, 2]])
    fail(mesh, lambda mesh: mesh.add_vertex([1, 2, 3]))
    assert not mesh.has_points


def test_meta_is_as_it_was_and_the_same_dict():
    mesh = furnish(hm.shapes.cube())
    meta = mesh.meta

    def change(mesh):
        mesh.meta["groups"].append("c")
        mesh.meta = {"other": 1}

    fail(mesh, change)
    assert mesh.meta == {"groups": ["a", "b"]}
    assert mesh.meta is meta


def test_policy_that_raises_leaves_nothing_behind():
    def refuse(values, weights):
        raise RefusedError

    mesh = furnish(hm.shapes.cube())
    mesh.vertex_data.set_policy("x", refuse)
    before = everything(mesh)
    fail(mesh, lambda mesh: mesh.split_face(0))
    assert everything(mesh) == before
    mesh.vertex_data.set_policy("x", "lerp")
    mesh.split_face(0)
    assert_valid(mesh)


def test_meta_and_arrays_of_an_inner_transaction_go_back_with_the_outer():
    mesh = furnish(hm.shapes.cube())
    before = everything(mesh)

    def change(mesh):
        with mesh.transaction():
            mesh.meta["groups"].append("c")
            mesh.points[:] = 3.0
        mesh.vertices[0].point = [4.0, 4.0, 4.0]

    fail(mesh, change)
    assert everything(mesh) == before
