# Each target does all the set-up it needs. On Windows: python scripts\tasks.py demo (test, ...).
PYTHON ?= python3
ARGS ?=

.PHONY: help setup demo test test-slow lint format benchmark gpu-check release train-small clean

help:
	@$(PYTHON) scripts/tasks.py; true

setup:
	@$(PYTHON) scripts/setup.py --dev

demo test test-slow lint format benchmark gpu-check release train-small clean:
	@$(PYTHON) scripts/tasks.py $@ $(ARGS)
