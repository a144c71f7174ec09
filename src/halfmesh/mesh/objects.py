"""Python's objects in compiled code: handles, numbers and points among the arguments of a native, and what it answers.

Whatever is not exactly of the class that is expected is left to the method in plain Python: these kernels say by a
negative number that they don't understand, and never raise. What they are given they only borrow; what a native gives
back, it owns.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import c_function, kernel, real_at, set_real, set_word, word_at
from halfmesh.core.topology import LIMIT, NEWS
from halfmesh.mesh.desk import (
    ARRAY,
    ARRAY_DATA,
    ARRAY_DTYPE,
    ARRAY_N_DIMENSIONS,
    ARRAY_SHAPE,
    ARRAY_STRIDES,
    BY_PYTHON,
    CATCH_UP,
    COLUMN_PLACE,
    DTYPE,
    EDGE,
    FLOAT,
    FLOAT64,
    HALFEDGE,
    HAS_POINTS,
    HELD_POINTS,
    HELD_POLICY,
    HELD_TOPOLOGY,
    INDEX_PLACE,
    INT,
    LIST,
    LOWERED_PLACE,
    NAME_AT,
    NAME_POINT,
    NONE,
    OF_POINTS,
    OF_TOPOLOGY,
    POLICY_PLACE,
    T_PLACE,
    TOPOLOGY,
    TUPLE,
    TYPE_PLACE,
    VIEWS,
    VIEWS_PLACE,
    WEIGHT,
    X,
)

__all__ = [
    "NO_PLACE",
    "boolean",
    "caught_up",
    "halfedge_in",
    "handle",
    "index_in",
    "is_open",
    "item",
    "method",
    "none",
    "options_in",
    "size_of",
]

NO_PLACE = -1.0  # in place of a weight: ``at`` is no argument
_NOT_UNDERSTOOD = -1

# Python's own functions that are used: none of them runs code of the user's, but the two that call.
_as_int = c_function("PyLong_AsLongLong", "i")
_as_float = c_function("PyFloat_AsDouble", "i", "d")
_new_int = c_function("PyLong_FromLongLong", "i")
_new_bool = c_function("PyBool_FromLong", "i")
_new_object = c_function("PyType_GenericAlloc", "ii")
_increase = c_function("Py_IncRef", "i")
_decrease = c_function("Py_DecRef", "i")
_forget_error = c_function("PyErr_Clear", "")
_call = c_function("PyObject_CallNoArgs", "i")
_call_with = c_function("PyObject_Vectorcall", "iiii")
_tuple_size = c_function("PyTuple_Size", "i")
_tuple_item = c_function("PyTuple_GetItem", "ii")
_list_size = c_function("PyList_Size", "i")
_list_item = c_function("PyList_GetItem", "ii")


# ---- what a native looks at --------------------------------------------------------------------------------------


@kernel
def is_open(desk: int) -> bool:
    """Whether the mesh holds what it held when the desk was opened."""
    if word_at(desk, TOPOLOGY) == 0:
        return False
    topology, column = word_at(desk, OF_TOPOLOGY), word_at(desk, OF_POINTS)
    return (  # type: ignore[no-any-return]
        word_at(topology, word_at(desk, LOWERED_PLACE)) == word_at(desk, HELD_TOPOLOGY)
        and word_at(topology, word_at(desk, VIEWS_PLACE)) == word_at(desk, VIEWS)
        and word_at(column, word_at(desk, COLUMN_PLACE)) == word_at(desk, HELD_POINTS)
        and word_at(column, word_at(desk, POLICY_PLACE)) == word_at(desk, HELD_POLICY)
    )


@kernel
def index_in(desk: int, argument: int, kind: int) -> int:
    """The index that a handle of this kind stands for, or an int."""
    what = word_at(argument, word_at(desk, TYPE_PLACE))
    if what == word_at(desk, kind):
        if word_at(argument, word_at(desk, T_PLACE)) != word_at(desk, VIEWS):  # of another mesh, or of another time
            return _NOT_UNDERSTOOD
        argument = word_at(argument, word_at(desk, INDEX_PLACE))
        if argument == 0 or word_at(argument, word_at(desk, TYPE_PLACE)) != word_at(desk, INT):
            return _NOT_UNDERSTOOD
    elif what != word_at(desk, INT):
        return _NOT_UNDERSTOOD
    index = _as_int(argument)
    if index < 0:
        _forget_error()  # it may be too large
        return _NOT_UNDERSTOOD
    return index if index <= LIMIT else _NOT_UNDERSTOOD


@kernel
def halfedge_in(desk: int, argument: int) -> int:
    """The halfedge that a handle of it stands for, or an edge: its first."""
    if word_at(argument, word_at(desk, TYPE_PLACE)) == word_at(desk, HALFEDGE):
        return index_in(desk, argument, HALFEDGE)
    e = index_in(desk, argument, EDGE)
    return e if e < 0 else 2 * e


@kernel
def size_of(desk: int, sequence: int) -> int:
    """How many items a list or a tuple has."""
    what = word_at(sequence, word_at(desk, TYPE_PLACE))
    if what == word_at(desk, LIST):
        return _list_size(sequence)  # type: ignore[no-any-return]
    if what == word_at(desk, TUPLE):
        return _tuple_size(sequence)  # type: ignore[no-any-return]
    return _NOT_UNDERSTOOD


@kernel
def item(desk: int, sequence: int, i: int) -> int:
    """An item of what `size_of` has understood."""
    if word_at(sequence, word_at(desk, TYPE_PLACE)) == word_at(desk, LIST):
        return _list_item(sequence, i)  # type: ignore[no-any-return]
    return _tuple_item(sequence, i)  # type: ignore[no-any-return]


@kernel
def options_in(desk: int, arguments: int, first: int, n: int, names: int, weight: float) -> int:
    """Read ``point`` and ``at``, given by place or by name: 1 if there is a point, 0 if not, or not understood.

    The numbers are put on the desk, at `X` and at `WEIGHT`; `weight` is what ``at`` is if it is not given.
    """
    set_real(desk, WEIGHT, weight)
    is_told = 0
    if n > first:
        if n > first + 1:
            return _NOT_UNDERSTOOD
        is_told = _point_in(desk, word_at(arguments, first))
    if names != 0:
        for i in range(_tuple_size(names)):
            name, argument = _tuple_item(names, i), word_at(arguments, n + i)
            if name == word_at(desk, NAME_AT) and weight != NO_PLACE:
                at = _number_in(desk, argument)
                if not 0.0 <= at <= 1.0:  # as no number is
                    return _NOT_UNDERSTOOD
                set_real(desk, WEIGHT, at)
            elif name == word_at(desk, NAME_POINT) and n <= first:
                is_told = _point_in(desk, argument)
            else:
                return _NOT_UNDERSTOOD
    return is_told


@kernel
def _number_in(desk: int, argument: int) -> float:
    """The value of a float or an int; NaN for anything else."""
    what = word_at(argument, word_at(desk, TYPE_PLACE))
    if what == word_at(desk, FLOAT) or what == word_at(desk, FLOAT64):
        return _as_float(argument)  # type: ignore[no-any-return]
    if what == word_at(desk, INT):
        i = _as_int(argument)
        if -(2**53) <= i <= 2**53 and i != -1:
            return float(i)
        _forget_error()  # of what is too large; -1 stands for an error
    return float("nan")


@kernel
def _point_in(desk: int, argument: int) -> int:
    """Put the three finite numbers of a point on the desk: 1, or 0 for None, or not understood."""
    if argument == word_at(desk, NONE):
        return 0
    if word_at(desk, HAS_POINTS) == 0:
        return _NOT_UNDERSTOOD
    what = word_at(argument, word_at(desk, TYPE_PLACE))
    if what == word_at(desk, ARRAY):
        if not _is_row_of_three(desk, argument):
            return _NOT_UNDERSTOOD
        data, step = word_at(argument, ARRAY_DATA), word_at(word_at(argument, ARRAY_STRIDES), 0)
        for i in range(3):
            set_real(desk, X + i, real_at(data + i * step, 0))
    else:
        if size_of(desk, argument) != 3:
            return _NOT_UNDERSTOOD
        for i in range(3):
            set_real(desk, X + i, _number_in(desk, item(desk, argument, i)))
    total = real_at(desk, X) + real_at(desk, X + 1) + real_at(desk, X + 2)
    return 1 if total - total == 0.0 else _NOT_UNDERSTOOD  # which infinity and NaN are not


@kernel
def _is_row_of_three(desk: int, array: int) -> bool:
    if (word_at(array, ARRAY_N_DIMENSIONS) & 0xFFFFFFFF) != 1 or word_at(array, ARRAY_DTYPE) != word_at(desk, DTYPE):
        return False
    return word_at(word_at(array, ARRAY_SHAPE), 0) == 3 and word_at(array, ARRAY_DATA) % 8 == 0  # type: ignore[no-any-return]


# ---- what a native answers -----------------------------------------------------------------------------------------


@kernel
def method(record: int, arguments: int, n: int, names: int) -> int:
    """The answer of the method in plain Python, which understands everything, and raises."""
    return _call_with(word_at(record, BY_PYTHON), arguments, n, names)  # type: ignore[no-any-return]


@kernel
def caught_up(t: Any, desk: int) -> bool:
    """Let Python look at what there is news of; False where that raised."""
    if t.counts[NEWS] == 0:
        return True
    answer = _call(word_at(desk, CATCH_UP))
    if answer == 0:
        return False
    _decrease(answer)
    return True


@kernel
def handle(desk: int, kind: int, index: int) -> int:
    """A new handle."""
    made = _new_object(word_at(desk, kind), 0)
    if made != 0:
        views = word_at(desk, VIEWS)
        _increase(views)
        set_word(made, word_at(desk, T_PLACE), views)
        set_word(made, word_at(desk, INDEX_PLACE), _new_int(index))
    return made  # type: ignore[no-any-return]


@kernel
def boolean(value: bool) -> int:
    """True or False."""
    return _new_bool(1 if value else 0)  # type: ignore[no-any-return]


@kernel
def none(desk: int) -> int:
    """None."""
    _increase(word_at(desk, NONE))
    return word_at(desk, NONE)  # type: ignore[no-any-return]
