"""What a user of kernels meets first: mistakes that are explained, handles as arguments, small inputs."""

from __future__ import annotations

import os

import numpy as np
import pytest

import halfmesh as hm
from halfmesh._jit import kernel

compiled_only = pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT", "0") not in {"", "0"}, reason="nothing is compiled"
)


@kernel
def count_into(t, out):
    for v in range(hm.vertex_slots(t)):
        out[v] += 1


@kernel
def with_a_wrong_word(t, v):
    n = 0
    for _ in hm.neighbours(t, v):
        n += 1
    return n


def test_checked_kernel_notices_an_array_that_is_too_short():
    with pytest.raises(IndexError) as caught:
        count_into.checked(hm.shapes.cube(), np.zeros(3))
    assert gives_the_kernel(caught, "count_into")


def test_checked_kernel_gives_what_the_kernel_gives():
    out = np.zeros(8)
    count_into.checked(hm.shapes.cube(), out)
    assert (out == 1).all()


@compiled_only
def test_misspelled_word_in_a_kernel_is_named_with_its_line_and_what_was_meant():
    with pytest.raises(AttributeError) as caught:
        with_a_wrong_word(hm.shapes.cube(), 0)
    assert gives_the_kernel(caught, "with_a_wrong_word")
    assert "did you mean hm.neighbors?" in caught.value.__notes__[-1]


def gives_the_kernel(caught, name):
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in {"", "0"} or f"in the kernel {name} (" in str(
        caught.value.__notes__
    )


def test_handle_enters_a_kernel_as_its_index():
    mesh = hm.shapes.cube()

    @kernel
    def target(t, h):
        return hm.target_of(t, h)

    h = mesh.halfedges[5]
    assert target(mesh, h) == target.interpreted(mesh, h) == h.target.index


def test_many_small_inputs_are_compiled_after_all(monkeypatch):
    from halfmesh._jit import gears

    @kernel
    def nothing(n):
        return n

    monkeypatch.setattr(gears, "interpret_only", False)
    runs = [nothing.at(1000) == nothing._quick for _ in range(gears.ENOUGH // 1000 + 2)]
    assert runs == [True] * (gears.ENOUGH // 1000) + [False, False]


def test_rules_take_keywords():
    mesh = hm.shapes.cube()
    assert hm.next_of(t=mesh, h=3) == hm.next_of(mesh, h=3) == hm.next_of(mesh, 3)
