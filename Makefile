.DEFAULT_GOAL := help
.PHONY: help run report docs test test-all test-platforms fuzz fmu fmu-all ssp web dist release bench stops sanitize lint format lock clean

PYTHON ?= python3
BIN := .venv/bin
READY := .venv/ready
DOCS_READY := .venv/docs-ready
UNITS := CarTrailer Car Trailer Hitch Bench
FMUS := $(foreach unit,$(UNITS),build/fmi2/$(unit).fmu build/fmi3/$(unit).fmu)
READY_MADE := python/overrun_hitch/fmus
SAMPLER := python/overrun_hitch/fmu/sampler.c
DIST := $(foreach unit,$(UNITS),$(READY_MADE)/fmi2/$(unit).fmu $(READY_MADE)/fmi3/$(unit).fmu) $(READY_MADE)/sampler
BUILD := $(BIN)/python -m fmu_build modelica/OverrunHitch OverrunHitch.Systems
SOURCES := $(READY) $(shell find modelica fmu_build -name '*.mo' -o -name '*.order' -o -name '*.py' -o -name '*.[ch]')
WEB := web/node_modules/.package-lock.json
NPM := $(shell command -v npm)
C_FILES := $(shell find fmu_build/runtime -name "*.[ch]") tests/platforms/*.[ch] benchmarks/*.c $(SAMPLER)

help:  ## list the targets
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | awk -F ':.*## ' '{printf "  make %-15s %s\n", $$1, $$2}'

run: $(READY)  ## build what is missing, brake, compare with theory, draw (build/run)
	$(BIN)/hitch run

report: $(READY)  ## recompute all figures and claims of the paper into one page (build/report/index.html)
	$(BIN)/hitch report

docs: $(DOCS_READY)  ## make the documentation site, its examples run (build/site/index.html)
	$(if $(NPM),-$(MAKE) --no-print-directory web)
	@test -f build/live/index.html || echo "without the live page: make web makes it, where npm is and gets its packages"
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --strict --quiet

test: $(READY)  ## run the tests, on all cores: every kind of check, long grids sampled
	$(BIN)/python -m pytest -n auto --dist worksteal -m "not full and not platforms"

test-all: test  ## run the rest of the tests as well, those of the live page where npm is and gets its packages
	$(if $(NPM),-$(MAKE) --no-print-directory $(WEB))
	$(BIN)/python -m pytest -n auto --dist worksteal -m full

test-platforms: $(READY)  ## build for all systems and run what can be run here (minutes, the first time)
	$(BIN)/python -m pytest -m platforms -rs

fmu: $(FMUS)  ## build the FMUs for this machine, FMI 2 and 3

build/fmi2/%.fmu: $(SOURCES)
	$(BUILD).$* -o $@ --fmi 2

build/fmi3/%.fmu: $(SOURCES)
	$(BUILD).$* -o $@ --fmi 3

fmu-all: $(READY)  ## build them for Linux, Windows and macOS (minutes, the first time)
	for unit in $(UNITS); do for fmi in 2 3; do \
	    $(BUILD).$$unit -o build/fmi$$fmi/$$unit.fmu --fmi $$fmi --platforms all || exit; done; done

ssp: build/CarTrailer.ssp  ## wire Car and Trailer, with the nine cases' parameters (SSP 1.0)

build/CarTrailer.ssp: build/fmi2/Car.fmu build/fmi2/Trailer.fmu $(wildcard python/overrun_hitch/coupling/ssp*.py) python/overrun_hitch/parameters.py
	$(BIN)/python -m overrun_hitch.coupling.ssp build/fmi2/Car.fmu build/fmi2/Trailer.fmu -o $@

web: build/live/index.html  ## make the live page, with the unit in WebAssembly in it (build/live/index.html; needs Node)

build/live/index.html: build/wasm/CarTrailer.fmu $(WEB) $(wildcard web/*.* web/src/*) python/overrun_hitch/parameters.py
	$(BIN)/python web/unit.py build/wasm/CarTrailer.fmu build/wasm
	$(BIN)/python web/presets.py build/wasm
	cd web && npx tsc --noEmit && node bundle.mjs ../build/wasm ../build/live/index.html

build/wasm/CarTrailer.fmu: $(SOURCES)
	$(BUILD).CarTrailer -o $@ --fmi 3 --platforms wasm

$(WEB): web/package-lock.json
	cd web && npm ci --no-fund --no-audit
	touch $@

dist: $(READY) $(DIST)  ## make wheel and sources, with the FMUs for all systems and the live page in them (dist; minutes, the first time)
	rm -rf dist $(READY_MADE)/live
	$(if $(NPM),-$(MAKE) --no-print-directory $(READY_MADE)/live/index.html)
	@test -d $(READY_MADE)/live || echo "without the live page: make web makes it, where npm is and gets its packages"
	$(BIN)/hatchling build

release: dist docs  ## make wheel, sources, FMUs and site, check them, and put them into one folder (build/release)
	$(BIN)/python -m pytest -m "full or platforms" tests/test_release.py tests/platforms/test_wheel.py
	rm -rf build/release
	mkdir -p build/release
	cp dist/* build/release
	cp -r $(READY_MADE) build/release/fmus
	cp -r build/site build/release/site
	@echo "build/release is ready: CONTRIBUTING.md says what is left to do"

$(READY_MADE)/fmi2/%.fmu: $(SOURCES)
	$(BUILD).$* -o $@ --fmi 2 --platforms all

$(READY_MADE)/fmi3/%.fmu: $(SOURCES)
	$(BUILD).$* -o $@ --fmi 3 --platforms all

$(READY_MADE)/sampler: $(READY) $(SAMPLER) fmu_build/fmu/compile.py
	$(BIN)/python -m fmu_build.fmu.shared $(SAMPLER) $@ all
	touch $@

$(READY_MADE)/live/index.html: build/live/index.html
	mkdir -p $(@D)
	cp $< $@

bench: $(READY) build/fmi2/CarTrailer.fmu build/fmi2/Trailer.fmu  ## measure a run of figure 8 against its arithmetic and other ways (benchmarks/results.md; three minutes)
	$(BIN)/python -m benchmarks build/fmi2/CarTrailer.fmu build/fmi2/Trailer.fmu

stops: $(READY)  ## 248 stops from 30 m/s: steps, events, rest, way and energy of each (three minutes)
	$(BIN)/python tests/fmu_build/runtime/stops.py

sanitize: $(READY)  ## run the C drivers under AddressSanitizer and UndefinedBehaviorSanitizer
	$(BIN)/python -m pytest tests/platforms/test_sanitized.py

fuzz: $(READY)  ## a million random calls, legal and illegal, under the sanitizers (a minute)
	$(BIN)/python tests/fmu_build/runtime/fuzz.py --calls 1000000

lint: $(READY)  ## ruff, mypy, layers of imports, format of the C sources
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/clang-format --dry-run --Werror $(C_FILES)

format: $(READY)  ## format Python and C
	$(BIN)/ruff check --fix
	$(BIN)/ruff format
	$(BIN)/clang-format -i $(C_FILES)

lock: $(READY)  ## renew the pinned versions in requirements.txt
	$(BIN)/uv pip compile --quiet --universal --python-version 3.10 --extra all --extra dev --upgrade \
	    --no-header --no-annotate pyproject.toml -o requirements.txt
	$(BIN)/uv pip compile --quiet --universal --python-version 3.10 --group docs --upgrade --constraint requirements.txt \
	    --no-header --no-annotate -o requirements-docs.txt

clean:  ## remove what was built; keep .venv
	rm -rf build dist web/node_modules $(READY_MADE) .pytest_cache .mypy_cache .ruff_cache .hypothesis

$(READY): requirements.txt pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10) and "Python 3.10 or newer is needed; name one with make PYTHON=...")'
	@echo "Making .venv, and installing in it what requirements.txt names (some minutes)"
	@test -x $(BIN)/python || $(PYTHON) -m venv .venv
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check $$(grep '^uv==' requirements.txt) && \
	    $(BIN)/uv pip install --quiet --compile-bytecode --python $(BIN)/python -r requirements.txt || \
	    $(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements.txt
	@echo "Installing this project itself"
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	@touch $@

$(DOCS_READY): $(READY) requirements-docs.txt
	@echo "Installing what the documentation site needs (requirements-docs.txt)"
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements-docs.txt
	@touch $@
