"""Tables in text: a known number of lines with the same number of numbers in each, read on all threads.

Comments and blank lines may stand anywhere. What a table is called, and what its lines should hold, is the caller's:
it goes into the messages.
"""

from __future__ import annotations

import functools
import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel, parallel
from halfmesh.errors import FormatError
from halfmesh.io import off_kernels as k
from halfmesh.io.numbers import powers_of_ten
from halfmesh.io.source import Source, count_lines, count_plain_lines, interpreted_size, skip_gaps

__all__ = ["Span", "Table", "TableReader", "lines_in", "state_at", "to_the_end"]

_MOST_OPEN = 2048
_FEW = 3000  # as `kernel.at` has it

Floats = NDArray[np.float64]


class Span(NamedTuple):
    """Lines begin..end hold the rows first..last."""

    begin: int
    end: int
    first: int
    last: int


def lines_in(source: Source, begin: int) -> list[Span]:
    """The text from `begin` on, cut for the threads, with the lines that hold more than blanks and comments."""
    size = interpreted_size(source.end - begin)

    def count(low: int, high: int) -> int:
        n = count_plain_lines.at(size)(source.data[low:high]) if size > _FEW else -1
        return n if n >= 0 else count_lines.at(size)(source.data, low, high)

    cuts = source.parts(begin)
    spans, line = [], 0
    for (low, high), n in zip(cuts, parallel(count, cuts), strict=True):
        spans.append(Span(low, high, line, line + n))
        line += n
    return spans


def state_at(position: int, row: int) -> NDArray[np.int64]:
    """What a kernel of `off_kernels` carries from one call to the next, at its beginning."""
    state = np.zeros(k.N_STATE, dtype=np.int64)
    state[k.POSITION], state[k.ROW] = position, row
    return state


def to_the_end(
    source: Source,
    step: Callable[[], None],
    state: NDArray[np.int64],
    undecided: NDArray[np.int64],
    values: Floats,
    refuse: Callable[[int, int, int], NoReturn],
) -> None:
    """Run a kernel until it is done; Python decides in between what the kernel can't.

    ``refuse(code, at, row)`` raises for what is wrong.
    """
    while True:
        step()
        for at, place in undecided[: 2 * state[k.N_OPEN]].reshape(-1, 2).tolist():
            values[place] = source.number(at)
        if state[k.CODE] == k.DONE:
            return
        if state[k.CODE] != k.AGAIN:
            refuse(int(state[k.CODE]), int(state[k.WHERE]), int(state[k.ROW]))


@dataclass
class Table:
    """Rows of numbers, and where they were.

    Attributes
    ----------
    values : ndarray of float64, shape (n, width)
    dotted : int
        Bit c is set if a number in column c was not written as a plain integer.
    source : Source
    begin, end : int
        The bytes from the first row to behind the last.
    reader : TableReader
    """

    values: Floats
    dotted: int
    source: Source
    begin: int
    end: int
    reader: TableReader

    def error(self, row: int, message: str) -> FormatError:
        """The exception for what is wrong in a row."""
        find: Any = nth_line.at(interpreted_size(self.end - self.begin))
        return self.source.error(message, find(self.source.data, self.begin, self.end, row))

    def integers(self, column: slice, what: str, low: int, high: int) -> NDArray[np.int32]:
        """Columns as int32 from low..high.

        Raises
        ------
        FormatError
            With the first row that holds something else.
        """
        values = self.values[:, column]
        written = range(self.values.shape[1])[column]
        plain = not any(self.dotted >> min(c, k.LAST_BIT) & 1 for c in written)
        if plain and low <= values.min(initial=low) and values.max(initial=high) <= high:
            return values.astype(np.int32)
        bad = ~((values >= low) & (values <= high) & (values == np.floor(values))).all(axis=1)
        if bad.any():
            row = int(np.argmax(bad))
            shown = ", ".join(f"{x:g}" for x in values[row].tolist())
            raise self.error(row, f"{self.reader.what} {row}: expected {what} from {low} to {high}, found {shown}")
        return values.astype(np.int32)


@dataclass
class TableReader:
    """What is to be read.

    Attributes
    ----------
    source : Source
    n_rows, width : int
    what : str
        What a row is, in messages.
    form : str
        What its line should hold.
    """

    source: Source
    n_rows: int
    width: int
    what: str
    form: str

    def read(self, begin: int, *, alone: bool = True) -> Table:
        """Read the rows from byte `begin` on; ``alone``: nothing may follow them.

        Raises
        ------
        FormatError
            There are fewer rows, a row is too short or too long, or holds what is no number; something follows.
        """
        values = np.empty((self._n_readable(begin), self.width))
        spans = [Span(begin, self.source.end, 0, self.n_rows)]
        if alone and len(self.source.parts(begin)) > 1:
            spans = lines_in(self.source, begin)
        found = parallel(self._read_span, [(span, values) for span in spans])
        ends = [end for end, _ in found]
        if alone:
            self._check_end(spans, ends)
        dotted = functools.reduce(operator.or_, (mask for _, mask in found))
        return Table(values, dotted, self.source, begin, ends[-1], self)

    def _n_readable(self, begin: int) -> int:
        """For how many rows there is text, whatever is announced, and one more: there what is missing is found.

        A number and what separates it from the next take two bytes.
        """
        room = self.source.end - begin + 1
        if self.n_rows and 2 * self.width > room:
            raise self.source.error(
                f"{self.n_rows} of {self.what} are announced with {self.form} each, for which the file is too short",
                begin,
            )
        return min(self.n_rows, room // (2 * self.width) + 1)

    def _read_span(self, span: Span, values: Floats) -> tuple[int, int]:
        """Read the rows of a span; the byte behind them, and which columns are not all plain integers."""
        first, last = min(span.first, len(values)), min(span.last, len(values))
        if span.end == self.source.end:  # if there are too few lines, it is here that they are missed
            last = len(values)
        if first == last:
            return span.begin, 0
        state = state_at(span.begin, first)
        run = k.read_vertices.at(interpreted_size(span.end - span.begin))
        undecided = np.empty(2 * max(_MOST_OPEN, self.width), dtype=np.int64)
        data, flat, powers = self.source.padded, values.reshape(-1), powers_of_ten()

        def step() -> None:
            run(data, span.end, last, self.width, True, powers, flat, undecided, state)

        to_the_end(self.source, step, state, undecided, flat, self._refuse)
        return int(state[k.POSITION]), int(state[k.SEEN])

    def _check_end(self, spans: list[Span], ends: list[int]) -> None:
        for span, end in zip(spans, ends, strict=True):
            rest = skip_gaps.at(0 if end == span.end else interpreted_size(span.end - end))(
                self.source.data, end, span.end
            )
            if rest < span.end:
                raise self.source.error(
                    f"{self.n_rows} of {self.what} are announced, and end before this line, "
                    f"but {self.source.shown(rest)} follows; correct the count, or remove the rest",
                    rest,
                )

    def _refuse(self, code: int, at: int, row: int) -> NoReturn:
        said = {
            k.FILE_ENDS: f"the file ends inside {self.what} {row} of {self.n_rows}; expected {self.form}",
            k.LINE_ENDS: f"the line of {self.what} {row} ends too early; expected {self.form}",
            k.LINE_GOES_ON: f"the line of {self.what} {row} goes on behind {self.form}",
        }
        raise self.source.error(said[code], at)


@kernel
def nth_line(b: Any, i: int, end: int, n: int) -> int:
    """Where the line begins that is number `n`, from 0, of those that hold more than blanks and a comment."""
    while True:
        i = skip_gaps(b, i, end)
        if n == 0 or i >= end:
            return i
        n -= 1
        while i < end and b[i] != 10 and b[i] != 13:
            i += 1
