"""The gears behind kernels: the disk cache that no edit escapes, the strict views, small inputs without a compiler."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from textwrap import dedent

import numpy as np
import pytest

import halfmesh as hm
from halfmesh._jit import Kernel, all_kernels, kernel

compiled_only = pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT", "0") not in {"", "0"}, reason="nothing is compiled"
)


@pytest.fixture
def run(tmp_path):
    """Run a script in a process of its own, with a kernel cache of its own; gives what it printed."""

    def run_script(text, **variables):
        script = tmp_path / "script.py"
        script.write_text(dedent(text))
        environment = {
            **os.environ,
            "HALFMESH_CACHE_DIR": str(tmp_path / "cache"),
            "PYTHONDONTWRITEBYTECODE": "1",
            **variables,
        }
        made = subprocess.run(
            [sys.executable, script],
            capture_output=True,
            text=True,
            cwd=tmp_path,
            env=environment,
            timeout=120,
            check=False,
        )
        assert made.returncode == 0, made.stderr
        return made.stdout.split()

    return run_script


HELPER = """
from halfmesh import kernel
SCALE = 10
@kernel
def helper(x):
    return SCALE * x
"""

USER = """
import helpers
from halfmesh import kernel
from helpers import helper
@kernel
def user(x):
    return helper(x) + 1
user(3)
hits = sum(user.compiled.stats.cache_hits.values())
print(user(3), "cached" if hits else "compiled")
"""


@compiled_only
def test_second_process_loads_what_the_first_compiled(run, tmp_path):
    (tmp_path / "helpers.py").write_text(HELPER)
    assert [run(USER), run(USER)] == [["31", "compiled"], ["31", "cached"]]


@compiled_only
@pytest.mark.parametrize(
    ("old", "new", "result"),
    [("SCALE * x", "SCALE * x + 5", "36"), ("SCALE = 10", "SCALE = 20", "61"), ("SCALE = 10", "SCALE = 10.0", "31.0")],
    ids=["the code of a called kernel", "a constant", "the type of a constant"],
)
def test_edit_in_another_file_compiles_anew(run, tmp_path, old, new, result):
    (tmp_path / "helpers.py").write_text(HELPER)
    assert run(USER) == ["31", "compiled"]
    (tmp_path / "helpers.py").write_text(HELPER.replace(old, new))
    assert run(USER) == [result, "compiled"]


@compiled_only
def test_edit_of_a_constant_two_packages_away_compiles_anew(run, tmp_path):
    (tmp_path / "outer" / "inner").mkdir(parents=True)
    (tmp_path / "outer" / "__init__.py").write_text("from . import inner")
    constants = tmp_path / "outer" / "inner" / "__init__.py"
    text = """
        import outer
        from halfmesh import kernel
        @kernel
        def user(x):
            return outer.inner.SCALE * x
        print(user(3))
    """
    for scale in (2, 5):
        constants.write_text(f"SCALE = {scale}")
        assert run(text) == [str(3 * scale)]


@compiled_only
def test_kernels_of_the_same_name_in_one_file_do_not_mix(run):
    text = """
        from halfmesh import kernel
        def made(n):
            @kernel
            def user(x):
                return x + n
            return user
        print(made(1)(10), made(2)(10), made(1.5)(10))
    """
    assert [run(text), run(text)] == [["11", "12", "11.5"]] * 2


@compiled_only
def test_loops_over_circulators_come_from_the_cache_too(run):
    text = """
        import numpy as np, halfmesh as hm
        from halfmesh import outgoing
        def made(circulator):
            @hm.kernel
            def user(t, out):
                for v in range(len(out)):
                    for h in outgoing(t, v):
                        out[v] += h
                    for e in hm.edges_around(t, v):
                        out[v] += e
                    for x in circulator(t, v):
                        out[v] += x
            return user
        mesh, out = hm.Mesh([[0, 1, 2], [2, 1, 3]]), np.zeros(4, dtype=int)
        user = made(hm.neighbors)
        user(mesh, out)
        print(out.tolist(), sum(user.compiled.stats.cache_hits.values()))
    """
    first, second = run(text), run(text)
    assert first[:-1] == second[:-1]
    assert (first[-1], second[-1]) == ("0", "1")


@compiled_only
def test_kernel_typed_at_a_prompt_runs_again_in_the_next_process(run):
    text = """
        import numpy as np, halfmesh as hm
        scope = {"hm": hm, "__name__": "__main__"}
        head = "@hm.kernel\\ndef typed(t, out):\\n for v in range(len(out)):\\n"
        exec(head + "  for h in hm.outgoing(t, v):\\n   out[v] += h", scope)
        typed = scope["typed"]
        mesh, out = hm.Mesh([[0, 1, 2], [2, 1, 3]]), np.zeros(4, dtype=int)
        typed(mesh, out)
        print(out.tolist())
    """
    assert run(text) == run(text)


@compiled_only
def test_bounds_checking_has_its_own_cache(run):
    text = """
        import numpy as np
        from halfmesh import kernel
        @kernel
        def reach(a, i):
            return a[i]
        try:
            print("read", reach(np.zeros(3), 2), reach(np.zeros(3), 1000) * 0 == 0)
        except IndexError:
            print("IndexError")
    """
    assert run(text, NUMBA_BOUNDSCHECK="0")[0] == "read"
    assert run(text, NUMBA_BOUNDSCHECK="1") == ["IndexError"]
    assert run(text, NUMBA_BOUNDSCHECK="0")[0] == "read"


@compiled_only
def test_rules_check_bounds_when_asked_to(run):
    text = """
        import halfmesh as hm
        @hm.kernel
        def reach(t, h):
            return hm.next_of(t, h)
        mesh = hm.Mesh([[0, 1, 2]])
        try:
            print(reach(mesh, 4000))
        except IndexError:
            print("IndexError")
    """
    assert run(text, NUMBA_BOUNDSCHECK="1") == ["IndexError"]


@compiled_only
@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write anywhere")
def test_read_only_cache_folder_costs_the_cache_alone(run, tmp_path):
    (tmp_path / "helpers.py").write_text(HELPER)
    (tmp_path / "cache").mkdir(mode=0o500)
    assert run(USER) == ["31", "compiled"]


@compiled_only
def test_cache_folder_that_can_not_be_made_costs_the_cache_alone(run, tmp_path):
    (tmp_path / "helpers.py").write_text(HELPER)
    (tmp_path / "file").write_text("in the way")
    assert run(USER, HALFMESH_CACHE_DIR=str(tmp_path / "file" / "cache")) == ["31", "compiled"]


@compiled_only
@pytest.mark.parametrize("suffix", ["*.nbi", "*.nbc"])
def test_damaged_cache_files_cost_the_cache_alone(run, tmp_path, suffix):
    (tmp_path / "helpers.py").write_text(HELPER)
    run(USER)
    damaged = list((tmp_path / "cache").rglob(suffix))
    assert damaged
    for file in damaged:
        file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    assert run(USER) == ["31", "compiled"]


def test_the_interpreted_gear_runs_without_numba(run):
    text = """
        import sys
        import numpy as np, halfmesh as hm
        mesh = hm.Mesh([[0, 1, 2], [2, 1, 3]])
        mesh.check(), mesh.summary(), list(mesh.vertices[0].neighbors()), mesh.vertex_faces(), mesh.components()
        @hm.kernel
        def user(t, out):
            for h in hm.outgoing(t, 0):
                out[0] += h
        user.interpreted(mesh, np.zeros(1))
        print("numba" in sys.modules)
    """
    assert run(text) == ["False"]


def test_importing_halfmesh_imports_neither_numba_nor_what_is_not_used(run):
    text = """
        import sys, halfmesh
        unwanted = ("numba", "scipy", "matplotlib", "click", "rich", "halfmesh.io")
        print(*(name for name in unwanted if name in sys.modules))
    """
    assert run(text) == []


def test_strict_views_refuse_negative_indices(run):
    """-1 means "none"; the interpreted gear can be told to refuse to read through it."""
    text = """
        import numpy as np, halfmesh as hm
        @hm.kernel
        def through_none(t, out):
            out[0] = t.next[t.face[1]]
        mesh, out = hm.Mesh([[0, 1, 2]]), np.zeros(1)
        try:
            through_none.interpreted(mesh, out)
            print("read")
        except IndexError:
            print("refused")
    """
    assert run(text, HALFMESH_STRICT="1") == ["refused"]
    assert run(text, HALFMESH_STRICT="0") == ["read"]


# ---------------------------------------------------------------------------------------------------------- in process


@kernel
def scaled(t, weight, out):
    """Twice as much."""
    for v in range(hm.vertex_slots(t)):
        out[v] = weight * v


def test_kernel_takes_keywords_and_keeps_name_and_documentation():
    mesh, out = hm.Mesh([[0, 1, 2]]), np.zeros(3)
    scaled(mesh, out=out, weight=2.0)
    assert out.tolist() == [0, 2, 4]
    assert (scaled.__name__, scaled.__doc__) == ("scaled", "Twice as much.")


def test_kernel_takes_attribute_columns_by_their_values():
    @kernel
    def fill(t, column):
        for v in range(hm.vertex_slots(t)):
            column.values[v] = 10 * v

    mesh = hm.Mesh([[0, 1, 2]])
    mesh.vertex_data.add("x", float)
    fill(mesh, mesh.vertex_data.column("x"))
    assert mesh.vertex_data["x"].tolist() == [0, 10, 20]
    mesh.vertex_data["x"] = np.zeros(3)
    fill.interpreted(mesh, mesh.vertex_data.column("x"))
    assert mesh.vertex_data["x"].tolist() == [0, 10, 20]


@compiled_only
def test_attributes_follow_again_after_a_kernel_that_failed():
    @kernel
    def wrong(t, points):
        points[0, 0] = "x"

    mesh = hm.shapes.cube()
    with pytest.raises(Exception, match="wrong"):
        wrong(mesh, mesh.vertex_data.column("points"))
    assert mesh.split_face(0).point.tolist() == [0.5, 0.5, 0.0]


@compiled_only
def test_kernel_can_not_return_what_it_borrows():
    @kernel
    def itself(t):
        return t

    @kernel
    def within(t, column):
        return 1, column

    mesh = hm.shapes.cube()
    with pytest.raises(TypeError, match="can't return a Topology"):
        itself(mesh)
    with pytest.raises(TypeError, match="can't return a Column"):
        within(mesh, mesh.vertex_data.column("points"))


def test_kernel_calls_itself():
    @kernel
    def factorial(n):
        return 1 if n < 2 else n * factorial(n - 1)

    assert factorial(10) == factorial.interpreted(10) == 3628800


@compiled_only
def test_small_inputs_never_wait_for_the_compiler(run):
    text = """
        import sys, halfmesh as hm
        hm.testing.assert_valid(hm.Mesh([[i, i + 1, 500] for i in range(400)]))
        print("numba" in sys.modules)
    """
    assert run(text) == ["False"]


def test_every_kernel_of_the_library_is_a_kernel():
    """And none does without a source text, which would cost its loops their speed."""
    ours = [k for k in all_kernels if str(k.__module__).startswith("halfmesh.")]
    assert len(ours) > 30
    assert all(isinstance(k, Kernel) and Path(k.py_func.__code__.co_filename).is_file() for k in ours)


@compiled_only
def test_every_loop_over_a_circulator_in_the_library_is_written_out():
    from halfmesh._jit import Circulator
    from halfmesh._jit.loops import unrolled

    for k in all_kernels:
        if str(k.__module__).startswith("halfmesh."):
            names = {n for n in k.py_func.__code__.co_names if isinstance(k.py_func.__globals__.get(n), Circulator)}
            left = names & {*unrolled(k.py_func).__code__.co_names}
            assert not left, k


def test_files_of_long_ago_are_dropped_from_the_cache(tmp_path):
    from halfmesh._jit import compiler

    for name, days in (("old.nbi", 70), ("old.1.nbc", 70), ("young.nbi", 5), ("note.txt", 70)):
        (tmp_path / name).touch()
        long_ago = (tmp_path / name).stat().st_mtime - days * 86400
        os.utime(tmp_path / name, (long_ago, long_ago))
    compiler._prune(str(tmp_path))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["note.txt", "young.nbi"]
