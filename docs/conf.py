"""How Sphinx builds these pages: Markdown, NumPy docstrings, one API page for each room of the package."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from importlib.metadata import version as version_of

from sphinx.ext.napoleon import NumpyDocstring

import halfmesh
from halfmesh._jit import Circulator, Kernel

project = "halfmesh"
author = "The halfmesh authors"
project_copyright = "2026, The halfmesh authors"
version = release = version_of("halfmesh")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.mathjax", "sphinx.ext.viewcode"]
exclude_patterns = ["_build", "decisions/README.md"]
source_suffix = {".md": "markdown"}

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings name shapes and dtypes, which annotations cannot
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True  # an Attributes section describes; the attributes themselves may be documented as well
suppress_warnings = ["ref.python"]  # words in types, such as "(indices, offsets)", are no references

html_theme = "furo"
html_title = f"halfmesh {version}"


def _show_kernels_as_functions() -> None:
    """Autodoc knows functions, not kernels: hand it the function that each kernel or circulator was made from."""
    for found in pkgutil.walk_packages(halfmesh.__path__, "halfmesh."):
        if found.name.endswith("__main__"):
            continue
        module = importlib.import_module(found.name)
        for name, value in list(vars(module).items()):
            if isinstance(value, Kernel | Circulator):
                setattr(module, name, inspect.unwrap(value))


_show_kernels_as_functions()
# Napoleon takes a colon in a property's first sentence for "type: description".
NumpyDocstring._parse_attribute_docstring = lambda self: self._consume_to_end()  # type: ignore[method-assign]
