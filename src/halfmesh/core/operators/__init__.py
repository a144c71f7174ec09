"""The operators: each with the question whether it may (``..._status``), the act, and both in one (``try_...``).

All are purely topological and take and give indices; in a user's kernel they are called by name. The act does not
ask: on an element that the status function refuses it may break the mesh.
"""
