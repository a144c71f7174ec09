"""Sentences that several commands say."""

from __future__ import annotations

import os
from pathlib import Path

import click

from halfmesh import _jit

__all__ = ["complain", "complaint_about", "reason_of", "size_text", "where_kept"]


def complain(message: str) -> None:
    """One line on stderr, whatever the message holds."""
    click.echo(f"halfmesh: {' '.join(message.split())}", err=True)


def reason_of(error: Exception) -> str:
    """What an exception has to say; of the system's errors the file and the words, not the number."""
    if isinstance(error, OSError) and error.strerror and error.filename is not None:
        return f"{click.format_filename(error.filename)}: {error.strerror}"
    return str(error) or type(error).__name__


def complaint_about(path: Path, error: Exception) -> str:
    """The reason, with the name of the file in front."""
    name, reason = click.format_filename(path), reason_of(error)
    return reason if reason.startswith(name) else f"{name}: {reason}"


def size_text(n_bytes: int) -> str:
    """``205 kB``."""
    size = float(n_bytes)
    for unit in ("B", "kB", "MB"):
        if size < 1000:
            return f"{size:.3g} {unit}"
        size /= 1000
    return f"{size:.3g} GB"


def where_kept() -> str:
    """The folder of the compiled kernels, if there is one."""
    folder = _jit.cache_folder()
    if not (folder.is_dir() and os.access(folder, os.W_OK)):
        return f"not kept for the next run: {folder} can't be written (HALFMESH_CACHE_DIR names another)"
    return f"kept in {folder}"
