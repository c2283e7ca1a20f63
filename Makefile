.DEFAULT_GOAL := help
.PHONY: help run test fmu lint format lock clean

PYTHON ?= python3
BIN := .venv/bin
READY := .venv/ready
FMU := build/fmi2/CarTrailer.fmu

help:  ## list the targets
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | awk -F ':.*## ' '{printf "  make %-8s %s\n", $$1, $$2}'

run: $(READY)  ## build what is missing, brake, compare with theory, draw (build/run)
	$(BIN)/hitch run

test: $(READY)  ## run all tests
	$(BIN)/python -m pytest

fmu: $(FMU)  ## build the FMU for this machine

$(FMU): $(READY) $(shell find modelica fmu_build -name '*.mo' -o -name '*.order' -o -name '*.py' -o -name '*.[ch]')
	$(BIN)/python -m fmu_build modelica/OverrunHitch OverrunHitch.Systems.CarTrailer -o $@

lint: $(READY)  ## ruff, mypy, layers of imports, format of the C sources
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/clang-format --dry-run --Werror fmu_build/runtime/*.[ch]

format: $(READY)  ## format Python and C
	$(BIN)/ruff check --fix
	$(BIN)/ruff format
	$(BIN)/clang-format -i fmu_build/runtime/*.[ch]

lock: $(READY)  ## renew the pinned versions in requirements.txt
	$(BIN)/python -m pip install --quiet uv
	$(BIN)/uv pip compile --quiet --universal --python-version 3.10 --extra dev --upgrade \
	    --no-header --no-annotate pyproject.toml -o requirements.txt

clean:  ## remove what was built; keep .venv
	rm -rf build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis

$(READY): requirements.txt pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10) and "Python 3.10 or newer is needed; name one with make PYTHON=...")'
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	touch $@
