"""All tasks, in the order of the tables."""

from __future__ import annotations

from benchmarks.build import BUILD, POLYGONS, WORST
from benchmarks.compact import COMPACT
from benchmarks.edits import EDITS
from benchmarks.first_use import FIRST_USE
from benchmarks.growing import BULK, GROWING
from benchmarks.handles import HANDLES
from benchmarks.memory import MEMORY
from benchmarks.normals import NORMALS
from benchmarks.operators import OPERATORS
from benchmarks.polylla import POLYLLA
from benchmarks.queries import QUERIES
from benchmarks.reading import READING
from benchmarks.rings import RINGS
from benchmarks.throughput import THROUGHPUT
from benchmarks.writing import WRITING

TASKS = {
    task.name: task
    for task in (
        BUILD,
        WORST,
        POLYGONS,
        READING,
        WRITING,
        RINGS,
        HANDLES,
        OPERATORS,
        EDITS,
        GROWING,
        BULK,
        QUERIES,
        NORMALS,
        MEMORY,
        POLYLLA,
        COMPACT,
        THROUGHPUT,
        FIRST_USE,
    )
}

CHANGING = ("operators", "edits", "growing", "bulk", "queries")
MESHING = ("polylla", "compact", "throughput")
PARTS = {
    "asking": [name for name in TASKS if name not in CHANGING + MESHING],
    "changing": list(CHANGING),
    "meshing": list(MESHING),
}
"""Each part has tables of its own on the pages, and keeps them as they are while none of its tasks is measured."""
