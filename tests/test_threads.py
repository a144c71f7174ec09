"""Threads, forks and processes: two threads may use two meshes at once, and no result depends on timing."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from textwrap import dedent

import numpy as np
import pytest

import halfmesh as hm
from halfmesh import outgoing
from halfmesh.core.topology import COLUMNS


def grid(n, seed=None):
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    faces = np.concatenate([np.c_[a, a + 1, a + n + 2], np.c_[a, a + n + 2, a + n + 1]])
    if seed is not None:
        rng = np.random.default_rng(seed)
        faces = rng.permutation((n + 1) ** 2)[faces[rng.permutation(len(faces))]]
    return faces


def fingerprint(mesh):
    return tuple(getattr(mesh.topology, name).tobytes() for name in COLUMNS[:-1])


@hm.kernel
def degrees(t, out):
    for v in range(len(out)):
        for _ in outgoing(t, v):
            out[v] += 1


def work(seed):
    mesh = hm.Mesh(grid(40 + seed, seed))
    mesh.check()
    out = np.zeros(mesh.n_vertices, dtype=np.int64)
    degrees(mesh, out)
    assert out.tolist() == mesh.vertex_degrees().tolist()
    return fingerprint(mesh)


def in_a_process(text, **variables):
    made = subprocess.run(
        [sys.executable, "-c", dedent(text)],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, **variables},
        check=False,
    )
    assert made.returncode == 0, made.stderr
    return made.stdout.split()


def test_two_threads_build_and_use_two_meshes_at_once():
    alone = [work(seed) for seed in range(6)]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(work, range(6))) == alone


FIRST_USE = """
import threading, time
import numpy as np
import halfmesh as hm
from halfmesh._jit.carriers import CarrierType
define = CarrierType.define
CarrierType.define = lambda carrier: (time.sleep(0.2), define(carrier))  # long enough for the others to come in between
@hm.kernel
def halfedges(t):
    return hm.halfedge_slots(t)
small = [hm.Mesh([[0, 1, 2]]) for _ in range(4)]
faces = np.array([[i, i + 1, 9000] for i in range(8000)])
gate, failures = threading.Barrier(4), []
def use():
    try:
        place = gate.wait()
        small[place].__compiled__()
        assert halfedges(small[place]) == 6
        mesh = hm.Mesh(faces)
        mesh.check()
        mesh.vertex_neighbors()
        assert mesh.n_boundary_loops == 1
    except BaseException as error:
        failures.append(error)
threads = [threading.Thread(target=use) for _ in range(4)]
[t.start() for t in threads]
[t.join() for t in threads]
print(len(failures), *map(repr, failures))
"""


@pytest.mark.large
def test_first_use_of_a_process_may_come_from_several_threads():
    """Numba, the carriers and each kernel are set up once, whoever comes first."""
    assert in_a_process(FIRST_USE) == ["0"]


@pytest.mark.large
@pytest.mark.parametrize("order", [None, 1], ids=["coherent", "shuffled"])
def test_result_does_not_depend_on_the_number_of_threads(order, monkeypatch):
    faces = grid(200, order)
    one_thread = []
    for n in ("1", "2", "7"):
        monkeypatch.setenv("HALFMESH_NUM_THREADS", n)
        one_thread.append(fingerprint(hm.Mesh(faces)))
    assert len(set(one_thread)) == 1


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
@pytest.mark.large
def test_a_forked_child_builds_meshes():
    """The parent has used its pool of threads before; the child must not wait for threads that it doesn't have."""
    text = """
        import os, warnings
        import numpy as np, halfmesh as hm
        warnings.simplefilter("ignore")  # Python 3.12 warns of forks beside threads
        faces = np.array([[i, i + 1, 90000] for i in range(80000)])
        hm.Mesh(faces).check()
        child = os.fork()
        if child == 0:
            mesh = hm.Mesh(faces)
            mesh.check()
            os._exit(7 if mesh.n_faces == 80000 else 1)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
    """
    assert in_a_process(text, HALFMESH_NUM_THREADS="2") == ["7"]


@pytest.mark.large
def test_kernels_release_the_lock_of_the_interpreter():
    """While one thread is inside a kernel, another one counts."""

    @hm.kernel
    def long(n):
        total = 0.0
        for i in range(n):
            total = (total + i) * 0.5
        return total

    long(10)
    counted, stop = [], threading.Event()

    def count():
        while not stop.is_set():
            counted.append(1)
            stop.wait(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = len(counted)
    long(100_000_000)
    during = len(counted) - before
    stop.set()
    thread.join()
    assert during > 3


CHANGING = """
import threading
import numpy as np
import halfmesh as hm
n = 700
a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
faces = np.concatenate([np.c_[a, a + 1, a + n + 2], np.c_[a, a + n + 2, a + n + 1]]).astype(np.int32)
rows, stop = np.arange(0, len(faces), 90), threading.Event()
def change():
    while not stop.is_set():
        faces[rows, 1] = 2**30
        faces[rows, 1] = a[rows % len(a)]
thread = threading.Thread(target=change)
thread.start()
for _ in range(20):
    try:
        hm.Mesh(faces, n_vertices=(n + 1) ** 2)
    except hm.InvalidMeshError:
        pass
stop.set()
thread.join()
print("alive")
"""


@pytest.mark.large
def test_faces_that_another_thread_changes_while_they_are_read_do_no_harm():
    """A mesh or the exception, never a crash: the checked indices are the library's own copy."""
    assert in_a_process(CHANGING) == ["alive"]


def test_one_mesh_may_be_read_by_several_threads():
    mesh = hm.Mesh(grid(20, 3))
    with ThreadPoolExecutor(4) as pool:
        answers = list(
            pool.map(lambda _: (mesh.n_boundary_loops, mesh.genus, mesh.vertex_neighbors()[0].tobytes()), range(8))
        )
    assert len(set(answers)) == 1
