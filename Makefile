# Everything lives in .venv, which is made by whatever target needs it first. Nothing needs root.
#   make demo    the main job on real meshes: load, build, check, query, a loop of your own, a labelled picture
#   make test    the whole test suite
# Needs Python 3.11 or newer and a network for the first run. Another Python: make demo PYTHON=/path/to/python

SHELL       := /bin/sh
PYTHON      ?=
VENV        := .venv
PY          := $(VENV)/bin/python
PIP_INSTALL := $(PY) -m pip install --quiet --disable-pip-version-check
JOBS        ?= logical
PYTEST      := $(PY) -m pytest -n $(JOBS)

.PHONY: help demo test test-interpreted test-bounds fuzz bench lint lint-style lint-types lint-house docs clean
.DEFAULT_GOAL := help

help:
	@echo "make demo    load, build, check and query a mesh, run a loop of your own, draw a labelled picture"
	@echo "make test    run all tests"
	@echo "make bench   compare with other libraries and write the table of README.md and docs/benchmarks.md"
	@echo "make fuzz    long random search for defects"
	@echo "make lint    ruff, mypy --strict, import contracts"
	@echo "make docs    build the documentation (warnings are errors)"
	@echo "make clean   remove the environment and everything that was made"

demo: $(VENV)/.ready-run
	$(VENV)/bin/halfmesh demo $(DEMO)

test: $(VENV)/.ready-test
	$(PYTEST) $(TESTS)

# The same kernels as plain Python, over arrays that refuse negative indices (-1 means "none" and must never be read
# through). Slower by the hundredfold, so the `large` tests are left out.
test-interpreted: $(VENV)/.ready-test
	NUMBA_DISABLE_JIT=1 HALFMESH_STRICT=1 $(PYTEST) -m "not large" $(TESTS)

# Compiled kernels that check every array index.
test-bounds: $(VENV)/.ready-test
	NUMBA_BOUNDSCHECK=1 $(PYTEST) $(TESTS)

fuzz: $(VENV)/.ready-test
	HYPOTHESIS_PROFILE=fuzz $(PYTEST) -m fuzz $(TESTS)

bench: $(VENV)/.ready-run
	$(PY) -m benchmarks $(BENCH)

lint: lint-style lint-types lint-house

lint-style: $(VENV)/.ready-lint
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .

lint-types: $(VENV)/.ready-lint
	$(VENV)/bin/mypy --strict src

lint-house: $(VENV)/.ready-lint
	$(VENV)/bin/lint-imports --no-logo

docs: $(VENV)/.ready-docs
	$(PY) -m sphinx -W --keep-going -q -b html docs docs/_build/html
	@echo "docs/_build/html/index.html"

clean:
	rm -rf $(VENV) .bench .hypothesis .mypy_cache .pytest_cache .ruff_cache .import_linter_cache build dist demo docs/_build docs/api/generated
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# --- set-up -----------------------------------------------------------------------------------------------------------
# One stamp file for each set of requirements; a changed pyproject.toml installs again.

$(VENV)/.ready-run: pyproject.toml | $(PY)
	@echo "installing halfmesh into $(VENV) ..."
	@$(PIP_INSTALL) -e .
	@touch $@

$(VENV)/.ready-%: pyproject.toml | $(PY)
	@echo "installing halfmesh[$*] into $(VENV) ..."
	@$(PIP_INSTALL) -e ".[$*]"
	@touch $@

# The first candidate that runs and is new enough makes the environment (a name on PATH may be an empty shim).
# Where Python comes without ensurepip (Debian without python3-venv), a pip that is there already brings the new one.
$(PY):
	@for candidate in $(PYTHON) python3.13 python3.12 python3.11 python3 python; do \
	    "$$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || continue; \
	    echo "creating $(VENV) with $$("$$candidate" --version) ..."; \
	    if "$$candidate" -c 'import ensurepip' 2>/dev/null; then \
	        "$$candidate" -m venv $(VENV); \
	    else \
	        "$$candidate" -m venv --without-pip $(VENV) && "$$candidate" -m pip --python $(PY) install --quiet pip; \
	    fi && exit; \
	    rm -rf $(VENV); \
	    echo "$$candidate has neither ensurepip nor pip (on Debian and Ubuntu: apt install python3-venv)" >&2; \
	    exit 1; \
	done; \
	echo "halfmesh needs Python 3.11 or newer, and none was found; name one: make $(MAKECMDGOALS) PYTHON=/path/to/python" >&2; \
	exit 1
