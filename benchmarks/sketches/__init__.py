"""Measurements behind the decision records: run one with ``python -m benchmarks.sketches.NAME``."""
