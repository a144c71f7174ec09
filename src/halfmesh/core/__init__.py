"""The arrays and the rules: connectivity alone, as ints. Nothing here knows positions, or :class:`halfmesh.Mesh`."""
