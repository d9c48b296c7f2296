# Commands that people and the continuous integration use; `make help` lists them.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help setup configure build demo diagnose test kills bench paper paper-calibration \
        accuracy discovery eos twins clean lint lint-format lint-tidy lint-workflow lint-python

# Debian's own interpreters: another python3 first on PATH would lack the packages.
PYTHON := /usr/bin/python3
SNAKEMAKE := /usr/bin/snakemake
PROFILE := workflow/profiles/local
BUILD := build
JOBS ?= $(shell nproc)
STUDY ?= copper_measured
DRAWS ?= 1e10
PYTHON_FILES := $(shell git ls-files '*.py') workflow/taylorcal
LAUNCHER := $(if $(shell command -v ccache),-D CMAKE_CXX_COMPILER_LAUNCHER=ccache)


help: ## list these commands
	@grep -E '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

setup: ## install the Debian packages that are missing
	@.ci/setup

configure: setup
	@cmake -S . -B $(BUILD) -G Ninja -D CMAKE_BUILD_TYPE=Release $(LAUNCHER)

build: configure ## compile the programs into build/
	cmake --build $(BUILD) --parallel $(JOBS)

demo: build ## calibrate STUDY (copper_measured) from nothing and print the result
	$(SNAKEMAKE) --profile $(PROFILE) --cores $(JOBS) --config study=$(STUDY)
	@$(PYTHON) workflow/scripts/print_summary.py results/$(STUDY)

diagnose: build ## where STUDY's model fails, and which physical effect it lacks
	workflow/taylorcal diagnose $(STUDY) --cores $(JOBS)

test: build ## unit, verification and workflow tests
	ctest --test-dir $(BUILD) --output-on-failure --parallel $(JOBS)
	$(PYTHON) -m pytest

kills: build ## the heavy test: 300 runs whose workflow is killed 20 times; minutes
	TAYLORCAL_KILLS=1 $(PYTHON) -m pytest -s tests/workflow/test_many_kills.py

lint: lint-format lint-python lint-workflow lint-tidy ## style and static checks; warnings are errors

lint-format: setup
	@echo clang-format
	@clang-format --dry-run -Werror $(shell git ls-files '*.cpp' '*.hpp')

# Eight files at a time, joined by CMake, since the libraries' headers take most of the time:
# file-level names must differ within a folder. The tests are left to the compiler.
lint-tidy: setup
	@cmake -S . -B $(BUILD)/lint -D CMAKE_UNITY_BUILD=ON -D TAYLORCAL_TESTS=OFF >/dev/null
	@cmake --build $(BUILD)/lint --target taylorcal_revision >/dev/null
	@run-clang-tidy -p $(BUILD)/lint -j $(JOBS) -quiet

lint-workflow: setup
	$(PYTHON) .ci/lint_workflow.py

lint-python: setup
	@black --check $(PYTHON_FILES)
	@flake8 $(PYTHON_FILES)

paper: build ## the source paper's statements beside ours, with figures
	$(SNAKEMAKE) --snakefile tests/verification/Snakefile --cores $(JOBS) paper
	@cat results/verification/paper.txt

accuracy: build ## convergence, scatter, dissipation, bars and a random sample of runs; two hours
	$(SNAKEMAKE) --snakefile tests/verification/Snakefile --cores $(JOBS) accuracy

# Starts from the committed runs where there are none: to compute them anew delete
# experiments/paper_design/*.h5.
paper-calibration: build ## the source paper's calibration, DRAWS=1e7 in minutes, 1e10 a quarter of an hour more
	@.ci/use_committed_runs paper_design
	$(SNAKEMAKE) --profile $(PROFILE) --cores $(JOBS) --config study=paper_design
	$(SNAKEMAKE) --snakefile tests/verification/Snakefile --cores $(JOBS) \
	    results/verification/paper_calibration_$(DRAWS).txt results/verification/two_solvers.png \
	    results/verification/modes.txt results/verification/network_errors.txt \
	    results/verification/second_round.txt results/verification/three_dimensions.png
	@cat results/verification/paper_calibration_$(DRAWS).txt results/verification/second_round.txt \
	    results/verification/modes.txt results/verification/network_errors.txt

twins: build ## are the intervals honest? forty synthetic tables of known parameters; half an hour
	@.ci/use_committed_runs paper_design
	$(SNAKEMAKE) --profile $(PROFILE) --cores $(JOBS) --config study=paper_design \
	    -- results/paper_design/config/train.json results/paper_design/config/calibrate.json
	$(SNAKEMAKE) --snakefile tests/verification/Snakefile --cores $(JOBS) \
	    results/verification/twins.txt
	@cat results/verification/twins.txt

discovery: build ## blind tables with hidden effects: how often are they found?
	$(SNAKEMAKE) --snakefile tests/discovery/Snakefile --cores $(JOBS) --rerun-incomplete --keep-going
	@cat tests/discovery/results/scores.md

eos: build ## equation of state: molecular dynamics, network and its checks; half an hour
	@.ci/setup --with eos
	$(SNAKEMAKE) --snakefile experiments/equation_of_state/Snakefile --cores $(JOBS)
	@$(PYTHON) workflow/scripts/compare_states.py results/equation_of_state \
	    experiments/equation_of_state
	@cat results/equation_of_state/checks.md results/equation_of_state/sizes.md

bench: build ## speed of the solver, the network and the sampler
	@.ci/bench $(BUILD)

clean: ## remove what was built; results/ stays
	rm -rf $(BUILD)
