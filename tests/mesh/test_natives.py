"""Operators as built-in functions: they do what the methods in plain Python do, whatever they are called with."""

from __future__ import annotations

import inspect
import pickle
import random
import types

import numpy as np
import pytest

import halfmesh as hm
from halfmesh import _jit
from halfmesh.mesh import desk
from halfmesh.testing import assert_valid
from nimble import NATIVE, decorate, frozen, nimble, outcome, plain, same

pytestmark = [
    pytest.mark.large,
    pytest.mark.skipif(not _jit.are_possible(), reason="this Python has no natives"),
]


# -- what they are called with ----------------------------------------------------------------------------------------

nan, inf = float("nan"), float("inf")
POINTS = (
    None, [1.0, 2.0, 3.0], (1.0, -2.5, 0.0), [1, 2, -1], [2**53, 0, 0], [2**60, 1, 1], [10**400, 0, 0], [1.0, 2],
    np.array([1.0, 2.0, 3.0]), np.array([1, 2, 3]), np.arange(12.0).reshape(4, 3)[1],
    np.arange(12.0).reshape(4, 3)[:3, 1],
    np.array([1.0, 2.0, 3.0], ">f8"), np.array([1.0, 2.0, 3.0], "f4"), np.array([[1.0, 2.0, 3.0]]),
    np.array([1.0, 2.0]),
    np.zeros(25, np.uint8)[1:].view(np.float64), [np.float64(1), 2.0, 3], [np.float32(1), 2.0, 3], [True, 1.0, 2.0],
    [True, False, True], [nan, 0.0, 0.0], (0.0, inf, 0.0), [1e308, 1e308, 1e308], "abc", ["a", "b", "c"], 5, [1.0],
    [], {}, [None, 1.0, 2.0], np.float64(3), range(3), np.ma.masked_array([1.0, 2.0, 3.0]), np.zeros((0, 3))[:0],
)  # fmt: skip
ELEMENTS = (0, 7, 10**9, -1, 2**31, 2**63, -(2**70), True, 1.0, "a", None, np.int32(3), np.int64(4), [0], 5 + 0j)
NUMBERS = (
    0.5,
    0.0,
    1.0,
    1,
    0,
    -1,
    2,
    nan,
    "x",
    np.float64(0.25),
    np.float32(0.25),
    np.array(0.25),
    np.ones(2),
    None,
    True,
)


def fresh():
    mesh = hm.shapes.icosphere(1)
    mesh.remove_face(11)
    mesh.split_edge(7)
    mesh.collapse(40)
    return mesh


@pytest.mark.parametrize("name", NATIVE)
@pytest.mark.parametrize("has_points", [True, False])
def test_arguments_of_every_kind_give_what_the_method_gives(name, has_points):
    start = fresh() if has_points else hm.Mesh(hm.shapes.icosphere(1).triangles())
    other = hm.shapes.cube()
    tests = [((), {}), ((0, None, 0), {}), ((0,), {"nonsense": 1}), ((), {"edge": 0}), ((0,), {"allow_parallel": True})]
    tests += [((x,), {}) for x in ELEMENTS]
    tests += [((x,), {}) for kind in ("vertices", "halfedges", "edges", "faces") for x in (getattr(other, kind)[1],)]
    tests += [((("vertices", "halfedges", "edges", "faces")[i], 5), "own") for i in range(4)]
    tests += [((0, p), {}) for p in POINTS] + [((0,), {"point": p}) for p in POINTS] + [((p,), {}) for p in POINTS]
    tests += [((9,), {"at": x}) for x in NUMBERS] + [((9, [1.0, 2.0, 3.0]), {"at": x}) for x in NUMBERS]
    tests += [
        ((9, [1.0, 2.0, 3.0]), {"at": 0.25, "point": [1.0, 2.0, 3.0]}),
        ((9,), {"point": (1.0, 2.0, 3.0), "at": 0.75}),
    ]
    tests += [((9,), {"a" + "t": 0.125}), ((9,), {"".join(["a", "t"]): 0.125})]
    tests += [
        ((x,), {}) for x in ([0, 1], [0, 1, 2], (0, 1, 2, 3), [5, 5, 5], [0, 1, 10**9], [0, 1, "a"], [0, 1, 2, 3, 4])
    ]
    for args, more in tests:
        meshes = nimble(start.copy()), plain(start)
        calls = [
            (getattr(m, name), *(((getattr(m, args[0])[args[1]],), {}) if more == "own" else (args, more)))
            for m in meshes
        ]
        one, another = (outcome(lambda f=f, a=a, k=k: f(*a, **k)) for f, a, k in calls)
        assert repr(one) == repr(another), (args, more)
        same(*meshes)


@pytest.mark.parametrize("form", [list, tuple, iter])
@pytest.mark.parametrize("n", [3, 4, 5])
def test_lists_of_handles_make_faces(form, n):
    start = hm.Mesh([], points=np.arange(30.0).reshape(10, 3))
    meshes = nimble(start.copy()), plain(start)
    for mesh in meshes:
        corners = [v if v.index % 2 else v.index for v in mesh.vertices]
        assert mesh.add_face(form(corners[:n])).degree == n
        assert mesh.add_face(form(corners[n - 1 :: -1])).index == 1
        with pytest.raises(hm.TopologyError, match=str(corners[1].index)):
            mesh.add_face(form(corners[:n]))
    same(*meshes)


# -- walks ------------------------------------------------------------------------------------------------------------


def step(mesh, rng):
    """One operator with arguments drawn at random: the same for equal meshes."""
    kind = rng.randrange(9)
    e, f, h = rng.choice(mesh.edges.indices), rng.choice(mesh.faces.indices), rng.choice(mesh.halfedges.indices)
    e, f, h = int(e), int(f), int(h)
    if rng.random() < 0.5:
        e, f, h = mesh.edges[e], mesh.faces[f], mesh.halfedges[h]
    more = [{}, {"at": rng.random()}, {"point": [rng.random(), 1.0, 2.0]}, {"point": np.ones(3), "at": 0.25}][
        rng.randrange(4)
    ]
    place = rng.choice([(), (None,), ((1.0, 2.0, rng.random()),)])
    acts = (
        lambda: mesh.try_flip(e), lambda: mesh.flip(e), lambda: (mesh.can_flip(e), mesh.can_collapse(h)),
        lambda: mesh.split_edge(rng.choice([e, h]) if isinstance(e, hm.Edge) else e, **more),
        lambda: mesh.split_edge_triangular(e, **more), lambda: mesh.split_face(f, *place),
        lambda: mesh.try_collapse(h, **more), lambda: mesh.collapse(h, **more), lambda: grown(mesh, rng),
    )  # fmt: skip
    return outcome(acts[kind])


def grown(mesh, rng):
    rim = mesh.topology.face == -1
    v = mesh.add_vertex([rng.random(), 0.0, 1.0])
    if not rim.any():
        return mesh.remove_face(int(mesh.faces.indices[0]))
    h = mesh.halfedges[int(np.flatnonzero(rim)[0])]
    return mesh.add_face([h.origin, h.target, v])


@pytest.mark.parametrize("is_decorated", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_walks_lead_to_the_same_mesh(seed, is_decorated):
    start = (hm.shapes.icosphere(1), hm.shapes.grid(4, 4), hm.shapes.cube())[seed % 3]
    if is_decorated:
        decorate(start)
    one, other = nimble(start.copy()), plain(start)
    first, second = random.Random(seed), random.Random(seed)
    for k in range(400):
        assert step(one, first) == step(other, second)
        if k % 20 == 0:
            same(one, other)
            assert_valid(one)
        if k == 200:
            one.compact(), other.compact()
        if one.n_faces > 400:
            break
    same(one, other)


def test_natives_do_the_work():
    """What a walk proves is nothing if the methods are called."""
    mesh = nimble(hm.shapes.icosphere(2))
    mesh.split_face(0), mesh.split_edge(0), mesh.add_vertex()  # which make room

    def refuse(*args, **kwargs):
        raise AssertionError("the method was called")

    with pytest.MonkeyPatch.context() as patch:
        for name in ("_act", "_act_and_place"):
            patch.setattr(hm.Mesh, name, refuse)
        e, h = mesh.edges[50], mesh.halfedges[300]
        assert mesh.can_flip(e)
        assert mesh.try_flip(e)
        assert mesh.flip(51) is None
        assert mesh.split_face(7, point=(1.0, 2.0, 3.0)).point.tolist() == [1, 2, 3]
        assert mesh.split_edge(e, np.ones(3)).point.tolist() == [1, 1, 1]
        assert mesh.split_edge_triangular(h, at=0.25).degree == 4
        assert mesh.can_collapse(h)
        assert mesh.try_collapse(h) is not None
        assert mesh.collapse(420, at=0.5).is_alive
        a, b, c, d = (mesh.add_vertex([float(i), 0.0, 1.0]) for i in range(4))
        assert [f.degree for f in (mesh.add_face([a, b, c]), mesh.add_face((c, b, a, d)))] == [3, 4]
    assert_valid(mesh)


# -- as methods -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NATIVE)
def test_natives_say_what_the_methods_say(name):
    mesh = nimble(hm.shapes.cube())
    native, method = getattr(mesh, name), getattr(plain(mesh), name)
    assert isinstance(native, types.BuiltinFunctionType)
    assert not isinstance(method, types.BuiltinFunctionType)
    described = getattr(hm.Mesh, name)
    assert native.__name__ == name
    assert native.__doc__.strip() == inspect.getdoc(described)
    expected = list(inspect.signature(described).parameters.values())[1:]
    assert [(p.name, p.kind, p.default) for p in inspect.signature(native).parameters.values()] == [
        (p.name, p.kind, p.default) for p in expected
    ]


def test_subclass_keeps_its_own_operators():
    class Counting(hm.Mesh):
        n_flips = 0

        def flip(self, edge, **more):
            self.n_flips += 1
            return super().flip(edge, **more)

    mesh = Counting(hm.shapes.icosphere(1).triangles())
    with _jit.compiling_always():
        for _ in range(5):
            mesh.flip(3)
            mesh.try_flip(4)
    assert mesh.n_flips == 5
    assert "flip" not in vars(mesh)
    assert "try_flip" in vars(mesh)


def test_copies_have_natives_of_their_own():
    mesh = nimble(hm.shapes.icosphere(1))
    for made in (mesh.copy(), pickle.loads(pickle.dumps(mesh))):
        assert not set(NATIVE) & set(vars(made))
        before = frozen(mesh)
        nimble(made).flip(0)
        assert frozen(mesh) == before
        assert frozen(made) != before


def test_without_knowing_objects_there_are_no_natives(monkeypatch):
    monkeypatch.setattr(desk, "_of_process", lambda: None)
    mesh = hm.shapes.icosphere(1)
    with _jit.compiling_always():
        mesh.flip(0), mesh.flip(0)
    assert "flip" not in vars(mesh)


def test_places_of_slots_are_found_not_assumed():
    class Strange:
        __slots__ = ("a", "b")

    x = Strange()
    x.a, x.b = object(), object()
    places = _jit.slots_of(x, a=x.a, b=x.b)
    assert sorted(places) == ["a", "b", "type"]
    assert len(set(places.values())) == 3
    x.b = x.a
    with pytest.raises(LookupError):
        _jit.slots_of(x, a=x.a)
