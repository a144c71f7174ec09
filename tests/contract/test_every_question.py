"""Every question that a mesh answers, on every mesh of the zoo: nothing is changed, and every gear says the same.

Questions are found by looking at the class, so a new one is tested without a word here.
"""

from __future__ import annotations

import inspect

import numpy as np
import pytest

import halfmesh as hm
from halfmesh._jit import compiling_always
from halfmesh.core.topology import COLUMNS

ZOO = hm.testing.zoo()
every_mesh = pytest.mark.parametrize("specimen", ZOO.values(), ids=ZOO)

CHANGES = {"compact", "reverse"}  # what changes the mesh has its own contracts


def questions():
    """Name and callable of every public property, and of every method that takes nothing."""
    for name, word in inspect.getmembers(hm.Mesh):
        if name.startswith("_") or name in CHANGES:
            continue
        if isinstance(word, property):
            yield name, lambda mesh, name=name: getattr(mesh, name)
        elif inspect.isfunction(word) and len(inspect.signature(word).parameters) == 1:
            yield name, lambda mesh, name=name: getattr(mesh, name)()


QUESTIONS = dict(questions())


def plain(answer):
    """Anything that compares: arrays as lists, objects as what they hold."""
    if isinstance(answer, np.ndarray):
        return answer.dtype.str, answer.tolist()
    if isinstance(answer, list | tuple):
        return [plain(item) for item in answer]
    if isinstance(answer, hm.mesh.Collection):
        return [handle.index for handle in answer]
    if isinstance(answer, hm.mesh.Ids):
        return {kind: plain(getattr(answer, kind)) for kind in ("vertices", "halfedges", "edges", "faces")}
    if isinstance(answer, hm.core.topology.Topology):
        return {name: plain(getattr(answer, name)) for name in COLUMNS[:-1]}
    if isinstance(answer, hm.Mesh):
        return plain(answer.topology)
    if hasattr(answer, "__dataclass_fields__"):
        return {name: plain(getattr(answer, name)) for name in answer.__dataclass_fields__ if name != "build_seconds"}
    return answer


def answered(question, mesh):
    try:
        return plain(question(mesh))
    except hm.PreconditionError as error:
        return str(error)


def state(mesh):
    arrays = mesh.topology.__arrays__()
    tables = (mesh.vertex_data, mesh.halfedge_data, mesh.edge_data, mesh.face_data)
    return [getattr(arrays, name).tobytes() for name in COLUMNS], [
        {n: a.tobytes() for n, a in t.items()} for t in tables
    ]


@every_mesh
def test_no_question_changes_the_mesh(specimen):
    mesh = specimen.mesh()
    before = state(mesh)
    for name, question in QUESTIONS.items():
        answered(question, mesh)
        assert state(mesh) == before, name
    hm.testing.assert_valid(mesh)


@every_mesh
def test_every_question_has_one_answer(specimen):
    """Asked twice, in the other order, of a copy."""
    mesh = specimen.mesh()
    first = {name: answered(question, mesh) for name, question in QUESTIONS.items()}
    again = {name: answered(question, mesh) for name, question in reversed(QUESTIONS.items())}
    of_copy = {name: answered(question, mesh.copy()) for name, question in QUESTIONS.items()}
    assert first == again == of_copy


@pytest.mark.large
@pytest.mark.parametrize("name", QUESTIONS)
def test_every_question_is_answered_alike_compiled_and_interpreted(name):
    """Small meshes are never compiled for, large ones always: it must not show."""
    interpreted = {s.name: answered(QUESTIONS[name], s.mesh()) for s in ZOO.values()}
    with compiling_always():
        compiled = {s.name: answered(QUESTIONS[name], s.mesh()) for s in ZOO.values()}
    assert interpreted == compiled


@pytest.mark.large
@every_mesh
def test_building_is_alike_compiled_and_interpreted(specimen):
    interpreted = plain(specimen.mesh().topology)
    with compiling_always():
        assert plain(specimen.mesh().topology) == interpreted


def test_no_question_of_the_api_is_missing():
    """The words of the public contract."""
    promised = """
        points n_vertices n_interior_vertices n_boundary_vertices n_isolated_vertices n_edges n_faces n_halfedges
        n_interior_halfedges n_exterior_halfedges n_boundary_loops n_connected_components euler_characteristic genus
        has_boundary is_triangular components vertices halfedges edges faces boundary_loops topology face_vertices
        vertex_neighbors vertex_faces face_neighbors triangles edge_vertices edge_faces check copy summary revision ids
        meta
    """
    assert set(promised.split()) <= set(QUESTIONS)
    assert callable(hm.Mesh.find_halfedge)


# ------------------------------------------------------------------------------------------ `testing` itself


BREAKS = {
    "a column": lambda mesh: mesh.topology.__arrays__().next.__setitem__(0, 0),
    "a kept count": lambda mesh: mesh.topology.__arrays__().counts.__setitem__(2, 5),
    "a cached count": lambda mesh: mesh._cache.update(loops=(mesh.revision, (np.zeros(0), np.zeros(9)))),
    "the shape of points": lambda mesh: setattr(mesh.vertex_data.column("points"), "values", np.zeros((8, 2))),
    "the dtype of points": lambda mesh: setattr(
        mesh.vertex_data.column("points"), "values", np.zeros((8, 3), np.float32)
    ),
}


@pytest.mark.parametrize("harm", BREAKS.values(), ids=BREAKS)
def test_assert_valid_notices(harm):
    mesh = ZOO["cube"].mesh()
    hm.testing.assert_valid(mesh)
    harm(mesh)
    with pytest.raises(AssertionError):
        hm.testing.assert_valid(mesh)


def test_figures_are_compared_one_by_one():
    with pytest.raises(AssertionError, match="genus is 0, expected 1"):
        hm.testing.Figures(8, 12, 6, genus=1).assert_of(ZOO["cube"].mesh())


def test_specimens_build_a_mesh_of_their_own_each_time():
    assert ZOO["cube"].mesh() is not ZOO["cube"].mesh()
    assert len(ZOO) > 40
    assert all(name == specimen.name for name, specimen in ZOO.items())
