"""Files that are there whole, or not at all."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import stat
from collections.abc import Iterable, Iterator
from typing import IO

from halfmesh.errors import FormatError

__all__ = ["replace_file", "replace_files"]


def replace_file(path: str | os.PathLike[str], pieces: Iterable[bytes | memoryview]) -> None:
    """Write one file: see `replace_files`."""
    replace_files([(path, pieces)])


def replace_files(files: Iterable[tuple[str | os.PathLike[str], Iterable[bytes | memoryview]]]) -> None:
    """Write the pieces of each to a new file beside its path, and when all are complete, put them in their places.

    Whatever goes wrong, what was at the paths before is still there and nothing else is. (If the system stops between
    the last steps for two files, the first is the new one.) The permission bits of an existing file are kept; a
    symbolic link stays one.

    Raises
    ------
    OSError
        Whatever the system says.
    FormatError
        If a path is there but not a regular file.
    """
    with contextlib.ExitStack() as stack:
        complete = []
        for path, pieces in files:
            place = os.path.realpath(path)
            mode = _mode(place, os.fspath(path))
            file = stack.enter_context(_beside(place))
            for piece in pieces:
                file.write(piece)
            file.flush()
            if mode is not None:
                os.chmod(file.name, mode)
            file.close()
            complete.append((file.name, place))
        for written, place in complete:
            os.replace(written, place)


def _mode(place: str, path: str) -> int | None:
    """The permission bits of the file at `place`, None if there is none."""
    try:
        mode = os.stat(place).st_mode
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), path)
    if not stat.S_ISREG(mode):
        raise FormatError("this is not a regular file (a pipe or a device?); save under another name", path=path)
    if not os.access(place, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)
    return stat.S_IMODE(mode)


@contextlib.contextmanager
def _beside(place: str) -> Iterator[IO[bytes]]:
    folder, name = os.path.split(place)
    temporary = os.path.join(folder, f".{name[:64]}.{secrets.token_hex(6)}.part")
    with open(temporary, "xb") as file:
        try:
            yield file
        except BaseException:
            file.close()
            with contextlib.suppress(OSError):
                os.unlink(temporary)
            raise
