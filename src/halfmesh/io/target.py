"""Files that are there whole, or not at all: see `halfmesh._files`."""

from halfmesh._files import replace_file

__all__ = ["replace_file"]
