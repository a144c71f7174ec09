"""Every operator at random on the general mesh, against the twin: refusals, links, numbering, laws, Euler's numbers."""

from __future__ import annotations

import random

import pytest
from hypothesis import note, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, rule, run_state_machine_as_test

import halfmesh as hm
from rotation import BY_NAME, KERNELS, OPERATORS, Walk, arguments, faces_to_add
from rotation.starts import real_files, starts
from soups import meshes_or_not

STARTS = starts()
LARGEST = 120  # edges: beyond, nothing is done that makes the mesh larger, since the twin is slow
INTS = st.lists(st.integers(0, 255), max_size=10)
WIRE = st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7)), max_size=5)


class Machine(RuleBasedStateMachine):
    """The rules for the operators are made below: a step draws ints, which say by their remainders what is meant."""

    gear = "interpreted"

    @initialize(start=st.sampled_from(sorted(STARTS)) | meshes_or_not(), wire=WIRE)
    def begin(self, start, wire):
        """A named mesh, or any faces that can be held; and wire, loops and parallel edges too, where it finds gaps."""
        self.walk = Walk(STARTS[start]() if isinstance(start, str) else held(*start), self.gear)
        for u, v in wire:
            self.take("add_edge", [u, v])

    def take(self, name, args):
        note(f"{name}{tuple(args)}")
        self.walk.take(name, args)

    def act(self, operator, ints):
        if self.walk.mesh.n_edges <= LARGEST or not operator.grows:
            self.take(operator.name, arguments(self.walk.twin, operator, ints))

    @rule(ints=INTS)
    def add_faces(self, ints):
        self.take("add_faces", [faces_to_add(self.walk.twin, ints)])

    @rule()
    def compact(self):
        self.take("compact", [])

    @rule()
    def copy(self):
        self.take("copy", [])


def held(faces, n):
    try:
        return hm.Mesh(faces, n_vertices=n)
    except hm.InvalidMeshError:
        return hm.Mesh([], n_vertices=n)


def rule_for(operator):
    def act(self, ints):
        self.act(operator, ints)

    act.__name__ = operator.name
    return rule(ints=INTS)(act)


for _operator in OPERATORS:
    setattr(Machine, _operator.name, rule_for(_operator))


class CompiledMachine(Machine):
    gear = "compiled"


def test_no_operator_of_the_library_is_without_a_twin():
    assert {"try_" + name for name in BY_NAME} | {"try_add_faces"} == set(KERNELS)
    assert all(name in vars(Machine) for name in [*BY_NAME, "add_faces"])


def test_operators_at_random():
    run_state_machine_as_test(Machine, settings=settings(max_examples=100, stateful_step_count=30))


@pytest.mark.parametrize("name", [name for name in STARTS if name not in real_files()])
def test_a_walk_from_each_of_the_zoo(name):
    wander(STARTS[name](), name, 60)


def test_a_walk_from_small_real_files(corpus):
    files = real_files()
    assert len(files) > 20
    for name, load in files.items():
        wander(load(), name, 30)


def wander(mesh, seed, n, gear="interpreted"):
    walk, rng = Walk(mesh, gear), random.Random(seed)
    for _ in range(n):
        walk.take(*walk.draw(rng, list(BY_NAME), LARGEST))


@pytest.mark.fuzz
@pytest.mark.parametrize("machine", [Machine, CompiledMachine])
def test_operators_at_random_for_long(machine):
    run_state_machine_as_test(machine, settings=settings(stateful_step_count=60))


@pytest.mark.fuzz
@pytest.mark.parametrize("seed", range(20))
def test_long_walks(seed):
    for name, make in STARTS.items():
        wander(make(), f"{seed} {name}", 150, "compiled")
