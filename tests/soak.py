"""Random operators on mesh and twin for as long as you like: ``python -m tests.soak --minutes 60 --seed 1``.

Prints how often each operator was done and refused. At a failure it prints a short sequence that fails, and ends.
"""

from __future__ import annotations

import argparse
import random
import signal
import sys
import time
import traceback
from collections import Counter
from contextlib import contextmanager
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from rotation import OPERATORS, Walk
from rotation.starts import starts

LARGE = 240  # edges: beyond, what grows is not drawn, or steps become slow
PATIENCE = 20  # seconds: a step that takes as long hangs


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--minutes", type=float, default=60.0)
    options.add_argument("--seed", type=int, default=0)
    options.add_argument("--steps", type=int, default=150, help="operators on each mesh before the next is taken")
    options.add_argument("--gear", choices=["compiled", "interpreted", "both"], default="both")
    options.add_argument("--only", nargs="*", help="names of operators")
    chosen = options.parse_args()
    names = chosen.only or [operator.name for operator in OPERATORS]
    end, n, walks, total = time.monotonic() + 60 * chosen.minutes, 0, 0, Tally()
    meshes = starts()
    while time.monotonic() < end:
        rng = random.Random(f"{chosen.seed} {walks}")
        start = rng.choice(sorted(meshes))
        gear = rng.choice(["compiled", "interpreted"]) if chosen.gear == "both" else chosen.gear
        steps, error = run(meshes[start](), gear, rng, chosen.steps, names, end, total)
        n, walks = n + len(steps), walks + 1
        if error:
            report(meshes[start], start, gear, steps, error)
            total.show(n, walks)
            return 1
    total.show(n, walks)
    return 0


class Tally:
    """Over all walks: done and refused per operator, and reasons."""

    def __init__(self):
        self.done, self.refused, self.reasons = Counter(), Counter(), Counter()

    def add(self, walk):
        self.done += walk.done
        self.refused += walk.refused
        self.reasons += walk.reasons

    def show(self, n, walks):
        print(f"{n} steps on {walks} meshes\n\n{'operator':34}{'done':>10}{'refused':>10}")
        for operator in OPERATORS:
            print(f"{operator.name:34}{self.done[operator.name]:10}{self.refused[operator.name]:10}")
        print("\n" + "\n".join(f"{reason:34}{k:10}" for reason, k in self.reasons.most_common()))


def run(mesh, gear, rng, n, names, end, total):
    """The steps done, and the error that the last one ended with."""
    walk, steps = Walk(mesh, gear), []
    try:
        for _ in range(n):
            if time.monotonic() > end:
                break
            steps.append(walk.draw(rng, names, LARGE))
            with at_most(PATIENCE):
                walk.take(*steps[-1])
    except Exception as error:
        return steps, error
    finally:
        total.add(walk)
    return steps, None


@contextmanager
def at_most(seconds):
    """Raise where compiled code does not come back, or plain Python: the first as soon as it does."""

    def give_up(*_):
        raise TimeoutError(f"a step took more than {seconds} s")

    signal.signal(signal.SIGALRM, give_up)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)


# -- a shorter way to the same failure ------------------------------------------------------------------------------


def fails(make, gear, steps):
    """The error that these steps end with, if they do."""
    walk = Walk(make(), gear)
    for name, args in steps:
        try:
            with at_most(PATIENCE):
                walk.take(name, args)
        except Exception as error:
            return error
    return None


def shrunk(make, gear, steps, error, patience=60.0):
    """Leave out what is not needed: halves first, then single steps."""
    end, size = time.monotonic() + patience, len(steps) // 2
    while size:
        k = 0
        while k < len(steps) and time.monotonic() < end:
            shorter = steps[:k] + steps[k + size :]
            if shorter and type(fails(make, gear, shorter)) is type(error):
                steps = shorter
            else:
                k += size
        size //= 2
    return steps


def report(make, start, gear, steps, error):
    traceback.print_exception(error)
    steps = shrunk(make, gear, steps, error)
    print(f"\nfrom {start!r} ({gear}), {len(steps)} steps:\n    {steps}\n    {fails(make, gear, steps)!r}\n")


if __name__ == "__main__":
    sys.exit(main())
