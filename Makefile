# Every target makes .venv on first use; only Python >= 3.11 and make are needed.

VENV    := .venv
BIN     := $(VENV)/bin
READY   := $(VENV)/.ready
RESULTS := results
FIGURES := fig2 fig3 fig4 fig6 fig7 fig8 fig9 fig10 fig11 fig12
TABLES  := table1 table2 table3 table4

# One BLAS thread: the sparse solver gains nothing from more, and the timings stay comparable.
export OMP_NUM_THREADS ?= 1
export OPENBLAS_NUM_THREADS ?= 1

.PHONY: help run test test-all lint format bench bench-update bench-scaling figures claims sensitivity report robustness convergence braking slip blocks memory slab clean distclean $(FIGURES) $(TABLES)

help:
	@echo "make run        the introductory example into $(RESULTS)/run"
	@echo "make test       tests, without the slow ones     (make test-all: these too)"
	@echo "make lint       ruff, mypy, import contracts     (make format: rewrite)"
	@echo "make bench      benchmarks, compared with the committed baseline (make bench-update: rewrite it)"
	@echo "make bench-scaling  growth of time and memory with mesh and distance; takes long"
	@echo "make figN       one figure of the paper: $(FIGURES)"
	@echo "make tableN     one table of the paper: $(TABLES)"
	@echo "make figures    every figure and table there is; a second call makes what is out of date"
	@echo "make claims     the paper's statements against the simulation, one by one"
	@echo "make sensitivity  what the paper leaves open, one parameter at a time"
	@echo "make report     all of that in one HTML page, $(RESULTS)/report.html"
	@echo "make robustness  108 cases from easy to extreme, elastic and viscoelastic, and 48 blocks; rewrites their tables and docs/verification.md"
	@echo "make convergence  to the limit of damping and steps; rewrites its tables and docs/verification.md"
	@echo "make braking    ten contacts of an ABS event with its pictures, into $(RESULTS)/abs_braking"
	@echo "make slip       braking at 5, 10, 20 % slip and with a locked wheel; renews validation/slip.csv and docs/slip.png"
	@echo "make blocks     plain, chamfered and siped blocks and two in a row side by side, into $(RESULTS)/blocks"
	@echo "make memory     slides and an ABS event with rubber that remembers; rewrites validation/memory_*.csv"
	@echo "make slab       slabs of several depths against plane strain, needs CalculiX; rewrites validation/slab.csv and docs/verification.md"
	@echo "make clean      remove results and caches (make distclean: .venv too)"

$(READY): setup.cfg pyproject.toml constraints.txt
	@python=$$(for p in $(PYTHON) python3 python3.14 python3.13 python3.12 python3.11; do \
	  if $$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then echo $$p; break; fi; done); \
	if [ -z "$$python" ]; then echo "make: no Python >= 3.11 found; install one or say make PYTHON=/path/to/python3" >&2; exit 2; fi; \
	test -x $(BIN)/python || $$python -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	@touch $@

run: $(READY)
	@rm -f $(RESULTS)/run.done
	@$(MAKE) --no-print-directory $(RESULTS)/run.done

test: $(READY)
	$(BIN)/python -m pytest --benchmark-skip -m "not slow" -n auto --dist worksteal

test-all: $(READY)
	$(BIN)/python -m pytest --benchmark-skip

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo

format: $(READY)
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

bench: $(READY)
	$(BIN)/python -m pytest tests/benchmarks --benchmark-only -m "not slow"

bench-update: $(READY)
	$(BIN)/python -m tests.benchmarks.baseline

bench-scaling: $(READY)
	$(BIN)/python -m pytest tests/benchmarks/test_scaling.py --benchmark-only -s

# Figure 8 shows the introductory example, which is run first unless it has been run to its end.
$(RESULTS)/run.done: examples/introductory.toml $(wildcard materials/*.py contact/*.py fem/*.py fem/*/*.py) | $(READY)
	$(BIN)/treadfem run $< -o $(RESULTS)/run
	@touch $@

fig8: $(RESULTS)/run.done

$(FIGURES): fig%: $(READY)
	$(BIN)/treadfem figure $* -o $(RESULTS)/figures

$(TABLES): table%: $(READY)
	$(BIN)/treadfem table $* -o $(RESULTS)/figures

figures: $(READY) $(RESULTS)/run.done
	$(BIN)/treadfem figure all -o $(RESULTS)/figures
	$(BIN)/treadfem table all -o $(RESULTS)/figures

claims: $(READY) $(RESULTS)/run.done
	$(BIN)/treadfem claims -o $(RESULTS)/figures

sensitivity: $(READY)
	$(BIN)/treadfem sensitivity -o $(RESULTS)/figures

report: figures claims sensitivity
	$(BIN)/treadfem report --figures $(RESULTS)/figures -o $(RESULTS)/report.html

# A case that does not converge (exit code 3) is a row of the tables too.
robustness: $(READY)
	$(BIN)/treadfem sweep validation/studies/robustness.toml -o $(RESULTS)/robustness --resume || test $$? = 3
	$(BIN)/python -m validation.convergence.robustness $(RESULTS)/robustness/summary.csv
	$(BIN)/treadfem sweep validation/studies/robustness.toml --base validation/studies/viscoelastic_block.toml \
	  -o $(RESULTS)/robustness_viscoelastic --resume --accept-unusual || test $$? = 3
	$(BIN)/python -m validation.convergence.robustness $(RESULTS)/robustness_viscoelastic/summary.csv viscoelastic
	$(BIN)/treadfem sweep validation/studies/block_robustness.toml -o $(RESULTS)/block_robustness --resume || test $$? = 3
	$(BIN)/python -m validation.convergence.robustness $(RESULTS)/block_robustness/summary.csv blocks
	$(BIN)/python -m validation.convergence.write

convergence: $(READY)
	for study in convergence onset snaps; do \
	  $(BIN)/treadfem sweep validation/studies/$$study.toml -o $(RESULTS)/$$study --resume || test $$? = 3 || exit; done
	$(BIN)/python -m validation.convergence.write $(RESULTS)

braking: $(READY)
	$(BIN)/treadfem run examples/abs_braking.toml -o $(RESULTS)/abs_braking --resume

slip: $(READY)
	$(BIN)/treadfem sweep validation/studies/braking.toml -o $(RESULTS)/slip --resume
	$(BIN)/python -m validation.braking $(RESULTS)/slip
	cp $(RESULTS)/slip/slip.csv validation/slip.csv
	cp $(RESULTS)/slip/slip.png docs/slip.png

blocks: $(READY)
	$(BIN)/treadfem sweep validation/studies/blocks.toml -o $(RESULTS)/blocks --resume
	$(BIN)/python -m validation.tread_blocks $(RESULTS)/blocks

memory: $(READY)
	for study in memory_slides memory_event; do \
	  $(BIN)/treadfem sweep validation/studies/$$study.toml -o $(RESULTS)/$$study --resume --accept-unusual || exit; done
	$(BIN)/python -m validation.bulk_memory $(RESULTS)/memory_slides $(RESULTS)/memory_event -o $(RESULTS)

slab: $(READY)
	$(BIN)/python -m validation.slab $(RESULTS)/slab

clean:
	rm -rf $(RESULTS) build dist *.egg-info .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .benchmarks
	find . -name __pycache__ -not -path './$(VENV)/*' -prune -exec rm -rf {} +

distclean: clean
	rm -rf $(VENV)
