# `make` says what there is to make.
SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
RELEASE := bookworm
BIN := .venv/bin
PYTEST := $(BIN)/pytest -n auto --dist worksteal

.PHONY: help setup demo test lint bench bench-against bench-frames pictures fresh clean

help:  ## say what there is to make
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-13s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

setup:  ## install everything needed, for the tests too
	@scripts/setup tests

demo:  ## make, render and check a hexagonal kit in out/hexagonal
	@scripts/setup
	$(BIN)/scadgen kit hexagonal -o out/hexagonal
	$(BIN)/scadgen render out/hexagonal
	$(BIN)/scadgen check out/hexagonal

test: lint  ## check everything: style, types, layers, behaviour
	$(PYTEST)

lint: setup  ## check style, types and layers
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/deptry scadgen

bench:  ## measure how long things take
	@scripts/setup tests
	$(BIN)/python benchmarks/bench.py

bench-against:  ## the same joints with this tree and with AGAINST=revision, side by side
	@scripts/setup tests
	$(BIN)/python benchmarks/against.py $(or $(AGAINST),HEAD) --instructions

bench-frames:  ## measure 10,000 different joints, all named frames, 200 random ones: hours
	@scripts/setup tests
	$(BIN)/python benchmarks/scaling.py 100 1000 10000
	$(BIN)/python benchmarks/named_frames.py
	$(BIN)/python benchmarks/random_frames.py 200

pictures:  ## draw the pictures of the documentation
	@scripts/setup
	$(BIN)/python scripts/pictures.py

fresh:  ## run demo and test in a fresh root of a Debian release: make fresh RELEASE=trixie
	@scripts/fresh $(RELEASE)

clean:  ## remove everything that can be made again
	rm -rf .venv .cache out dist build tests/openscad_wasm/node_modules
	rm -rf .coverage .hypothesis .mypy_cache .pytest_cache .ruff_cache .import_linter_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
