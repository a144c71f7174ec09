"""The ``halfmesh`` command: what the library does, said in a terminal.

Nothing is computed here. `app` has the commands, `report` says what is known of a file, `pages` prints it, `polylla`
has the command of that name and `tour` the demo; the work is done by the rooms below. Click and Rich are known to this
room only.
"""

from __future__ import annotations

import io
import sys

__all__ = ["main"]


def main() -> None:
    """Run the ``halfmesh`` command with the arguments of the process.

    Exit codes: 0 all is well, 1 a file or the system refused (one line on stderr says why), 2 the command was not
    understood, 130 interrupted.
    """
    if isinstance(sys.stdout, io.TextIOWrapper):  # a name that the terminal can't show is shown escaped
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        from halfmesh.cli.app import app

        app(prog_name="halfmesh")
    except KeyboardInterrupt:  # while modules are still being imported
        sys.exit(130)
