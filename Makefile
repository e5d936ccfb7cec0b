# Two commands on a fresh machine with Python 3.11+ (with venv), git and make:
#   make demo   fly the trial, replay a real log, compare; says which files to open
#   make test   everything that must hold before a change is taken in

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
DEMO := demo

NODE := tests/node/node_modules/.installed

.PHONY: demo test lint bench docs clean

$(VENV)/.installed: pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "glider needs Python 3.11 or newer; name one: make PYTHON=python3.12 $(MAKECMDGOALS)" >&2; exit 1; }
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade 'pip>=24'
	$(BIN)/python -m pip install --quiet --editable '.[adcp,test]'
	touch $@

$(NODE): tests/node/package-lock.json
	@if command -v npm >/dev/null && (cd tests/node && npm ci --silent); then touch $@; \
	  else echo "npm or its packages cannot be had: the tests with the TypeScript reader of MCAP are skipped"; fi

demo: $(VENV)/.installed
	mkdir -p $(DEMO)
	$(BIN)/glider trim --net-buoyancy 0.3 --mass-position 0.4216 --mass-rotation 45
	$(BIN)/glider simulate south-china-sea-2011 --force -o $(DEMO)/trial.mcap -o $(DEMO)/trial.rrd -o $(DEMO)/trial.csv
	$(BIN)/glider replay logs/seaexplorer-sea035 --force -o $(DEMO)/sea035.mcap -o $(DEMO)/sea035.rrd
	$(BIN)/glider compare south-china-sea-2011 $(DEMO)/trial.mcap --force -o $(DEMO)/trial.png -o $(DEMO)/verdicts.csv -o $(DEMO)/trial.html
	@echo
	@echo "Open these:"
	@echo "  $(DEMO)/trial.png     the reconstructed trial against what the paper prints"
	@echo "  $(DEMO)/trial.html    the same as a page, with every verdict"
	@echo "  $(DEMO)/trial.rrd     the same flight in 3-D:    $(BIN)/rerun $(DEMO)/trial.rrd"
	@echo "  $(DEMO)/sea035.rrd    a real SeaExplorer's dives: $(BIN)/rerun $(DEMO)/sea035.rrd"
	@echo "  $(DEMO)/trial.mcap, $(DEMO)/sea035.mcap   in Foxglove or Lichtblick: open local file"
	@echo "  $(DEMO)/trial.csv, $(DEMO)/verdicts.csv   tables"

lint: $(VENV)/.installed
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

test: lint $(NODE)
	$(BIN)/python -m pytest -n 2

bench: $(VENV)/.installed
	$(BIN)/python benchmarks/startup.py
	$(BIN)/python benchmarks/trims.py
	$(BIN)/python benchmarks/simulate.py
	$(BIN)/python benchmarks/peers.py
	$(BIN)/python benchmarks/agreement.py
	$(BIN)/python benchmarks/slocum.py
	$(BIN)/python benchmarks/viewers.py

clean:
	rm -rf $(VENV) $(DEMO) tests/node/node_modules
