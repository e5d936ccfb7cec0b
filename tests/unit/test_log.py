"""Logs: what a channel refuses, tables without interpolation, slices."""

from __future__ import annotations

import numpy as np
import pytest

from glidercli.errors import InputError
from glidercli.log import Channel, Log


def channel(name: str, times: list[int], values: list[float]) -> Channel:
    return Channel(name, np.array(times), np.array(values))


@pytest.mark.parametrize(
    ("name", "times", "values", "words"),
    [
        ("depht", [0], [1.0], "is no channel"),
        ("depth", [0, 1], [1.0], "one each"),
        ("depth", [0, 1], [1.0, np.nan], "not finite"),
        ("depth", [1, 1], [1.0, 2.0], "do not increase"),
    ],
)
def test_a_channel_refuses(name: str, times: list[int], values: list[float], words: str) -> None:
    with pytest.raises(InputError, match=words):
        channel(name, times, values)


def test_table_is_the_union_of_times_and_interpolates_nothing() -> None:
    log = Log(
        {"depth": channel("depth", [0, 10**9], [1.0, 2.0]), "pitch": channel("pitch", [10**9, 2 * 10**9], [0.1, 0.2])},
        "measured",
    )
    table = log.table()
    assert list(table.columns) == ["time_utc", "elapsed_s", "depth_m", "pitch_deg"]
    assert table["elapsed_s"].tolist() == [0.0, 1.0, 2.0]
    assert table["depth_m"].isna().tolist() == [False, False, True]
    assert table["pitch_deg"].isna().tolist() == [True, False, False]
    np.testing.assert_allclose(table["pitch_deg"][1:], np.degrees([0.1, 0.2]), rtol=1e-15)  # a few roundings


def test_slices_are_half_open() -> None:
    log = Log({"depth": channel("depth", [0, 1, 2, 3], [0.0, 1.0, 2.0, 3.0])}, "measured")
    assert log.sliced(1, 3)["depth"].values.tolist() == [1.0, 2.0]
    assert "depth" not in log.sliced(10, 20)


def test_no_piece_holds_more_samples_of_any_channel() -> None:
    sparse = Channel("depth", np.arange(100, dtype=np.int64) * 100, np.arange(100.0))
    burst = Channel("pitch", np.arange(5000, 5090, dtype=np.int64), np.arange(90.0))
    log = Log({"depth": sparse, "pitch": burst}, "measured")
    pieces = list(log.pieces(7))
    assert max(len(channel) for piece in pieces for channel in piece.channels.values()) == 7
    assert all(set(piece.channels) == {"depth", "pitch"} for piece in pieces)
    for name, channel in log.channels.items():
        np.testing.assert_array_equal(np.concatenate([piece[name].time_ns for piece in pieces]), channel.time_ns)
        np.testing.assert_array_equal(np.concatenate([piece[name].values for piece in pieces]), channel.values)
