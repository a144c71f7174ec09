"""Halfmesh beside the other mesh libraries that pip can install: `python -m benchmarks`."""
