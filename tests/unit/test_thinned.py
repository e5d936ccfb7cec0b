"""Are the drawn points of a line spread evenly, the first and the last among them, whatever the pieces?"""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from glidercli.logio.thinned import Thinned


@given(pieces=st.lists(st.integers(0, 60), min_size=1, max_size=12), most=st.integers(2, 40))
def test_points_are_spread_evenly(pieces: list[int], most: int) -> None:
    line, count = Thinned(most), sum(pieces)
    rows = np.arange(count, dtype=float)[:, None]
    for piece, end in zip(pieces, np.cumsum(pieces), strict=True):
        line.add(rows[end - piece : end])
    kept = line.rows()[:, 0]
    assert line.count == count
    if count <= 2 * most:
        whole = np.linspace(0, count - 1, min(count, most)).round()
        np.testing.assert_array_equal(kept, whole)
        return
    assert most // 2 < len(kept) <= most
    assert (kept[0], kept[-1]) == (0, count - 1)
    # neighbours are drawn from rows a stride apart: never more than twice the mean distance and a stride
    assert np.diff(kept).max() <= 4 * count / most
