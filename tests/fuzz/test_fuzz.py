"""A part of the fuzzing for every change; all of it: python tests/fuzz/readers.py --count 5000."""

from __future__ import annotations

from readers import FAULTS, run


def test_mutated_files_are_refused_or_accounted_for() -> None:
    done = run(seed=20261125, count=200)
    assert len(done) == 200
    assert [item for item in done if item["outcome"] in FAULTS] == []
