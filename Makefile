# The commands of the README. They need Git, GNU make and Python 3.11 or newer.

PYTHON ?= python3
ready := .venv/.ready
bin := .venv/bin

.PHONY: help demo test test-long fuzz lint loops docs notebook pictures samples templates tuned schemas lock benchmarks clean

help: ## Show this help
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "  make %-12s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

$(ready): pyproject.toml .ci/requirements.lock .ci/setup tests/third_party/regkit-superquadric/pyproject.toml
	@.ci/setup $(PYTHON)
	@touch $@

demo: $(ready) ## Track a person in a depth recording with SoG, G-SoG and the default method
	@$(bin)/regkit run docs/examples/demo.yaml

test: $(ready) ## Run every check
	@$(MAKE) --no-print-directory --jobs 2 lint loops
	@$(bin)/pytest -q --numprocesses auto --dist worksteal

test-long: $(ready) ## Run what a release needs besides: fuzzing, soaks, long walks
	@$(bin)/pytest -q --numprocesses auto --dist worksteal -m "long or hypothesis" --hypothesis-profile long
	@$(MAKE) --no-print-directory fuzz

fuzz: $(ready) loops ## Try 10,000 damaged YAML files and 10,000 other damaged inputs on every reader
	@$(bin)/python -m tests.fuzz --yaml 10000 --inputs 10000 --jobs 2

# Compiles the loops once, so that the test processes do not each compile them.
loops: $(ready)
	@$(bin)/regkit doctor --warm

lint: $(ready)
	@$(bin)/ruff check .
	@$(bin)/ruff format --check .
	@$(bin)/mypy
	@$(bin)/lint-imports --no-cache
	@$(bin)/regkit schema --check --built-in
	@$(bin)/regkit validate docs/examples/*.yaml plugins/regkit_plugins/templates/*.yaml

docs: $(ready) ## Build the documentation in docs/_build
	@$(bin)/sphinx-build -q -W --keep-going -n docs docs/_build
	@echo docs/_build/index.html

pictures: $(ready) ## Regenerate the images of the documentation
	@$(bin)/python docs/pictures.py

notebook: $(ready) loops ## Make the tutorial's notebook again from its page, and run it
	@$(bin)/python docs/notebook.py

samples: $(ready) ## Regenerate the sample recordings
	@$(bin)/python -m regkit_synthesis docs/examples/data
	@$(bin)/python -m regkit_synthesis.samples.mannequin docs/examples/data/mannequin
	@$(bin)/python -m regkit_synthesis.samples.arm docs/examples/robots/arm.urdf docs/examples/data/arm
	@$(bin)/python -m regkit_synthesis.samples.keypoints docs/examples/data/human_walk_keypoints.csv

templates: $(ready) ## Fit the shipped templates to their meshes again
	@$(bin)/python -m regkit_synthesis.templates plugins/regkit_plugins/templates

tuned: $(ready) loops ## Tune the shipped templates' primitives to methods again (an hour)
	@$(bin)/python -m regkit_synthesis.templates.tuned plugins/regkit_plugins/templates/tuned

schemas: $(ready) ## Regenerate the JSON Schemas
	@$(bin)/regkit schema --built-in

lock: $(ready) ## Update the locked versions of the dependencies
	@$(bin)/uv pip compile pyproject.toml --extra dev --universal --python-version 3.11 \
		--generate-hashes --no-emit-index-url --no-header --quiet --upgrade --fork-strategy fewest \
		--output-file .ci/requirements.lock

benchmarks: $(ready) ## Measure the run times
	@for file in benchmarks/[a-z]*.py; do $(bin)/python $$file; done

clean: ## Remove the virtual environment and caches
	@rm -rf .venv .mypy_cache .ruff_cache .pytest_cache .hypothesis dist
