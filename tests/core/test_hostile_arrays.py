"""Any array of integers is read right; anything else is refused with one exception (O12, anchors 4.4 I)."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import halfmesh as hm
from halfmesh._jit import all_kernels, compiling_always

FACES = np.array([[0, 1, 2], [2, 1, 3], [2, 3, 4]])
COLUMNS = ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge")


def same_mesh(faces, **options):
    made, plain = hm.Mesh(faces, **options).topology, hm.Mesh(FACES.tolist()).topology
    return all(np.array_equal(getattr(made, name), getattr(plain, name)) for name in COLUMNS)


INTEGERS = ["i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", ">i2", ">i4", ">i8", ">u4", "<u8", "intp", "longlong"]


@pytest.mark.parametrize("dtype", INTEGERS)
def test_every_integer_dtype_is_read(dtype):
    assert same_mesh(FACES.astype(dtype))


BUILDERS = ("halfmesh.core.construction", "halfmesh.core.matching")


def readonly():
    faces = FACES.astype(np.int32)
    faces.flags.writeable = False
    return faces


def unaligned():
    faces = np.frombuffer(bytearray(1 + 4 * FACES.size), dtype=np.int32, offset=1).reshape(FACES.shape)
    faces[...] = FACES
    return faces


LAYOUTS = {
    "Fortran order": np.asfortranarray(FACES),
    "transposed": np.ascontiguousarray(FACES.T).T,
    "negative strides": np.ascontiguousarray(FACES[::-1, ::-1])[::-1, ::-1],
    "every second row": np.repeat(FACES, 2, axis=0)[::2],
    "some columns of a wide array": np.hstack([np.full((3, 2), -7), FACES])[:, 2:],
    "read-only": readonly(),
    "unaligned": unaligned(),
    "matrix": np.asarray(FACES).view(np.matrix),
    "list of arrays": list(FACES),
    "tuple of tuples": tuple(map(tuple, FACES.tolist())),
    "generator": None,
    "list of sets in order": [tuple(row) for row in FACES],
    "object array of lists": None,
    "ragged": (FACES.ravel(), np.array([0, 3, 6, 9])),
    "ragged, offsets uint8": (FACES.ravel().astype(">u2"), np.array([0, 3, 6, 9], dtype=np.uint8)),
}


@pytest.mark.filterwarnings("ignore:the matrix subclass:PendingDeprecationWarning")
@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_memory_layout_is_read(layout):
    faces = LAYOUTS[layout]
    if layout == "generator":
        faces = (list(row) for row in FACES)
    if layout == "object array of lists":
        faces = np.empty(3, dtype=object)
        faces[:] = FACES.tolist()
    assert same_mesh(faces)


def test_a_broadcast_array_is_read_as_what_it_shows():
    """Overlapping memory: three times the same face."""
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(np.broadcast_to(np.array([0, 1, 2]), (3, 3)))
    assert caught.value.reason == "nonmanifold_edge"


def test_the_mesh_keeps_no_hold_of_the_arrays_it_was_made_from():
    faces, points = FACES.astype(np.int32), np.zeros((5, 3))
    mesh = hm.Mesh(faces, points)
    faces[:], points[:] = 0, 7.0
    assert mesh.triangles().tolist() == FACES.tolist()
    assert not mesh.points.any()


REFUSED = {
    "floats": FACES.astype(float),
    "whole floats in lists": [[0.0, 1.0, 2.0]],
    "NaN": np.full((1, 3), np.nan),
    "one float": [[0, 1, 2.0]],
    "booleans": np.ones((1, 3), dtype=bool),
    "booleans in lists": [[True, False, 2]],
    "complex": FACES.astype(complex),
    "strings": np.array([["0", "1", "2"]]),
    "text": "0 1 2",
    "bytes": b"012",
    "dates": FACES.astype("M8[s]"),
    "objects": FACES.astype(object),
    "structures": np.zeros(3, dtype=[("a", int), ("b", int), ("c", int)]),
    "None": None,
    "a number": 3,
    "a dictionary": {0: [0, 1, 2]},
    "None inside": [[0, 1, None]],
    "a row that is none": [[0, 1, 2], None],
    "flat": np.arange(6),
    "scalar array": np.array(5),
    "three dimensions": np.zeros((2, 2, 3), dtype=int),
    "lists three deep": [[[0, 1, 2], [2, 1, 3]]],
    "rows without columns": np.zeros((5, 0), dtype=int),
    "pairs": np.zeros((5, 2), dtype=int),
    "empty rows": [[], [], []],
    "masked": np.ma.masked_array(FACES, mask=FACES == 3),
    "beyond int64": np.full((1, 3), 2**63, dtype=np.uint64),
    "beyond int32": np.array([[0, 1, 2**32]]),
    "beyond everything": [[0, 1, 2**70]],
    "int64 that wraps to a good index": np.array([[0, 1, 2**32 + 2]]),
    "lowest int64": np.array([[0, 1, -(2**63)]]),
    "ragged masked": (np.ma.masked_array([0, 1, 2], mask=[0, 0, 1]), np.array([0, 3])),
    "ragged with floats": (np.array([0.0, 1, 2]), np.array([0, 3])),
    "offsets of floats": (np.array([0, 1, 2]), np.array([0.0, 3])),
    "offsets that start late": (np.array([0, 1, 2]), np.array([1, 3])),
    "offsets that stop early": (np.array([0, 1, 2]), np.array([0, 2])),
    "offsets that step back": (np.array([0, 1, 2, 3]), np.array([0, 4, 1, 4])),
    "offsets beyond int32": (np.array([0, 1, 2]), np.array([0, 2**40, 3])),
    "no offsets": (np.array([0, 1, 2]), np.array([], dtype=int)),
}


@pytest.mark.parametrize("faces", REFUSED.values(), ids=REFUSED)
def test_anything_else_is_refused_with_one_exception(faces):
    with pytest.raises(hm.InvalidMeshError):
        hm.Mesh(faces)


@pytest.mark.parametrize(
    "faces", [[], (), np.zeros((0, 3), int), np.zeros(0, int), (np.zeros(0, int), np.zeros(1, int))]
)
def test_no_faces_make_an_empty_mesh(faces):
    mesh = hm.Mesh(faces)
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces) == (0, 0, 0)
    hm.testing.assert_valid(mesh)


@pytest.mark.parametrize(
    "points",
    [
        np.zeros((4, 3)),
        np.zeros((5, 4)),
        np.zeros(15),
        np.zeros((5, 3), dtype=complex),
        np.zeros((5, 3), dtype=bool),
        np.full((5, 3), "x"),
        [[0, 1], [1], [2, 3], [4], [5]],
        np.ma.masked_array(np.zeros((5, 3)), mask=True),
        "points",
        {},
    ],
    ids=["too few", "4-D", "flat", "complex", "bool", "strings", "ragged", "masked", "text", "dictionary"],
)
def test_bad_points_are_refused(points):
    with pytest.raises(hm.InvalidMeshError):
        hm.Mesh(FACES, points)


@pytest.mark.parametrize("dtype", ["f2", "f4", "f8", ">f8", "i4", "u8", "longdouble"])
def test_points_of_any_real_dtype_become_float64(dtype):
    points = np.arange(15).reshape(5, 3).astype(dtype)
    mesh = hm.Mesh(FACES, points)
    assert mesh.points.dtype == np.dtype("=f8")
    assert mesh.points.tolist() == points.tolist()


@pytest.mark.parametrize("wrapping", [2**32, 2**32 + 2, -(2**32), 2**63 - 1, -(2**63), 2**31])
def test_no_index_wraps_around_to_another_one(wrapping):
    faces = FACES.astype(np.int64)
    faces[1, 2] = wrapping
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(faces, n_vertices=5)
    assert (caught.value.reason, caught.value.elements["corners"].tolist()) == ("index_out_of_range", [5])
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(FACES, n_vertices=5, edges=[[0, 4], [0, wrapping]])
    assert (caught.value.reason, caught.value.elements["rows"].tolist()) == ("index_out_of_range", [1])


def test_plane_points_get_z_zero():
    assert hm.Mesh([[0, 1, 2]], [(1, 2), (3, 4), (5, 6)]).points.tolist() == [[1, 2, 0], [3, 4, 0], [5, 6, 0]]


@pytest.mark.parametrize("n", [True, 2.5, "3", -1, 2**31, 10**30, np.float64(3)])
def test_bad_vertex_counts_are_refused(n):
    with pytest.raises(hm.InvalidMeshError):
        hm.Mesh([[0, 1, 2]], n_vertices=n)


def test_without_a_vertex_count_faces_and_wire_say_it():
    assert hm.Mesh([[0, 1, 2]]).n_vertices == 3
    assert hm.Mesh([[0, 1, 2]], edges=[[2, 5]]).n_vertices == 6
    assert hm.Mesh([], edges=[[0, 3]]).n_vertices == 4
    assert hm.Mesh(np.array([[0, 1, 2]], dtype=np.uint64), edges=np.array([[1, 3]], dtype=np.int8)).n_vertices == 4


def test_a_vertex_count_that_contradicts_the_points_is_refused():
    with pytest.raises(hm.InvalidMeshError):
        hm.Mesh([[0, 1, 2]], np.zeros((3, 3)), n_vertices=4)


@pytest.mark.parametrize(
    "wire",
    [
        [[0.0, 1.0]],
        [[True, False]],
        [[True, 2]],
        [[0, 1, 2]],
        [0, 1],
        [[0], [1, 2]],
        "ab",
        np.ma.masked_array([[0, 1]], mask=True),
    ],
)
@pytest.mark.parametrize("argument", ["edges", "twins"])
def test_bad_wire_and_bad_twins_are_refused(argument, wire):
    with pytest.raises(hm.InvalidMeshError):
        hm.Mesh([[0, 1, 2]], n_vertices=4, **{argument: wire})


@given(
    arrays.arrays(
        st.one_of(
            arrays.integer_dtypes(), arrays.unsigned_integer_dtypes(), arrays.floating_dtypes(), arrays.boolean_dtypes()
        ),
        arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4),
    )
)
def test_no_array_at_all_gives_anything_but_a_mesh_or_the_exception(faces):
    try:
        mesh = hm.Mesh(faces, n_vertices=9)
    except hm.InvalidMeshError:
        return
    hm.testing.assert_valid(mesh)
    assert np.array_equal(mesh.face_vertices()[0], faces.ravel())


@pytest.mark.large
def test_every_layout_is_compiled_for_only_once():
    """Another layout must not make anybody wait for the compiler again."""

    def signatures():
        compiled = [k for k in all_kernels if "compiled" in k.__dict__ and k.__module__ in BUILDERS]
        return {k.__qualname__: len(k.compiled.signatures) for k in compiled}

    with compiling_always():
        hm.Mesh(FACES)
        hm.Mesh(LAYOUTS["ragged"])
        once = signatures()
        for dtype, layout in itertools.product(("i4", "i8", ">i4"), LAYOUTS.values()):
            if layout is not None:
                hm.Mesh(layout.astype(dtype) if isinstance(layout, np.ndarray) else layout)
        hm.Mesh(readonly())
    assert once
    assert signatures() == once
