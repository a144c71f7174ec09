"""Rules bound anew: what a kernel asks is answered by the carrier that it was given."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

import halfmesh as hm
from halfmesh import _jit
from halfmesh.compact import TriangleTopology
from halfmesh.core.navigation import next_of, twin_of


@hm.kernel
def agree(t, s):
    """Halfedges of `t` whose next leaves the same vertex in `s`, the halfedges of which stand otherwise."""
    n = 0
    for f in range(hm.face_slots(t)):
        h, g = hm.halfedge_of_face(t, f), hm.halfedge_of_face(s, f)
        n += int(hm.origin_of(t, hm.next_of(t, h)) == hm.origin_of(s, hm.next_of(s, g)))
        n += int(hm.origin_of(t, hm.twin_of(t, h)) == hm.origin_of(s, hm.twin_of(s, g)))
    return n


@pytest.mark.parametrize("run", [agree, agree.interpreted])
def test_one_kernel_may_take_two_kinds_of_mesh(run):
    mesh = hm.shapes.icosphere(1)
    small = hm.TriangleMesh(mesh)
    assert run(mesh, small) == run(small, mesh) == run(small, small) == 2 * mesh.n_faces


def test_rules_mean_themselves_on_a_mesh():
    assert twin_of(hm.shapes.cube(), 5) == 4
    assert twin_of.meant_by(hm.shapes.cube().__views__()) is twin_of


def test_questions_over_arrays_are_bools():
    small = hm.TriangleMesh(hm.Mesh([[0, 1, 2]]))
    assert hm.is_exterior(small, np.arange(6)).tolist() == [False] * 3 + [True] * 3
    assert hm.is_exterior(small, np.arange(6)).dtype == bool


@pytest.mark.large
def test_what_rules_are_bound_to_is_part_of_the_type():
    """Or else a kernel that was compiled for other rules would be read from the disk."""

    def kind(rules):
        carrier = _jit.declare_carrier("Bound", ("next",))
        carrier.bind(rules)
        return carrier.make(np.zeros(1, np.int32))._numba_type_

    @_jit.rule
    def another(t, h):
        return t.next[h] + 1

    @_jit.rule
    def yet_another(t, h):
        return t.next[h] + 2

    one, two, none = kind({next_of: another}), kind({next_of: yet_another}), kind({})
    assert len({one.key, two.key, none.key}) == 3


SCRIPT = """
import halfmesh as hm, mine
mesh = {mesh}
assert mine.agree(mesh, mesh) == 240
print(sum(mine.agree.compiled.stats.cache_misses.values()))
"""

MINE = """
import halfmesh as hm
@hm.kernel
def agree(t, s):
    n = 0
    for h in range(hm.halfedge_slots(t)):
        n += int(hm.next_of(t, h) == hm.next_of(s, h))
    return n
"""


@pytest.mark.large
def test_kernels_are_kept_on_disk_for_each_kind_of_mesh(tmp_path):
    """Also where the other kind, for which the same kernel was kept, was never declared."""
    (tmp_path / "mine.py").write_text(MINE)
    paths = os.pathsep.join([str(tmp_path), *sys.path])
    environment = os.environ | {"HALFMESH_CACHE_DIR": str(tmp_path / "cache"), "PYTHONPATH": paths}
    plain, bound = "hm.shapes.icosphere(1)", "hm.TriangleMesh(hm.shapes.icosphere(1))"
    misses = []
    for mesh in (plain, bound, plain, bound):
        command = [sys.executable, "-c", SCRIPT.format(mesh=mesh)]
        run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        misses.append(run.stdout.strip())
    assert misses == ["1", "1", "0", "0"]


def test_the_layout_is_a_carrier_of_its_own():
    assert TriangleTopology.views.rules[next_of] is not next_of
