"""How does a test make a Slocum file? A tiny writer of data files and caches, by the published format."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping, Sequence
from typing import NamedTuple

SAME = "same"
"""Stands for a sensor updated with the value that it had."""
CODES = {1: "b", 2: "h", 4: "f", 8: "d"}
START = 1_565_364_000.0
NAVIGATION = (
    ("m_present_time", "timestamp", 8), ("m_depth", "m", 4), ("m_pitch", "rad", 4), ("m_gps_status", "enum", 1),
    ("m_gps_lat", "lat", 8), ("m_gps_lon", "lon", 8),
)  # fmt: skip
SCIENCE = (
    ("sci_m_present_time", "timestamp", 8), ("sci_water_temp", "degC", 4), ("sci_water_cond", "S/m", 4),
    ("sci_water_pressure", "bar", 4),
)  # fmt: skip
Sensors = Sequence[tuple[str, str, int]]
Cycle = Mapping[str, float | str]


class Made(NamedTuple):
    """A data file, its cache, and where each cycle begins; the last entry is where the end mark stands."""

    data: bytes
    cache: bytes
    crc: str
    cycles: list[int]


def sensor_lines(sensors: Sensors, unused: Sequence[str] = ()) -> bytes:
    lines = [f"s: T {i:4d} {i:4d} {size} {name} {unit}\n" for i, (name, unit, size) in enumerate(sensors)]
    lines += [f"s: F {len(sensors) + i:4d}   -1 4 {name} nodim\n" for i, name in enumerate(unused)]
    return "".join(lines).encode()


def crc_of(text: bytes) -> str:
    return f"{zlib.crc32(text) ^ 0xFFFFFFFF:08x}"


def made(
    sensors: Sensors, cycles: Sequence[Cycle], *, order: str = ">", extension: str = "dbd", name: str = "unit-2019-220-0-1",
    factored: bool = False, unused: Sequence[str] = (), mark: bytes = b"X", **tags: object,
) -> Made:  # fmt: skip
    """A file of these sensors and cycles. tags : those that shall differ; None leaves one out."""
    text = sensor_lines(sensors, unused)
    told: dict[str, object] = {
        "dbd_label": "DBD(dinkum_binary_data)file", "encoding_ver": 5, "num_ascii_tags": 14, "all_sensors": "T",
        "the8x3_filename": "00010001", "full_filename": name, "filename_extension": extension,
        "mission_name": "TEST.MI", "fileopen_time": "Fri_Aug__9_15:24:50_2019",
        "total_num_sensors": len(sensors) + len(unused), "sensors_per_cycle": len(sensors),
        "state_bytes_per_cycle": -(-len(sensors) // 4), "sensor_list_crc": crc_of(text),
        "sensor_list_factored": int(factored),
    }  # fmt: skip
    told |= tags
    head = "".join(f"{key}:    {value}\n" for key, value in told.items() if value is not None).encode()
    data = head + (b"" if factored else text) + b"sa" + struct.pack(f"{order}hfd", 0x1234, 123.456, 123456789.12345)
    places = []
    for cycle in cycles:
        places.append(len(data))
        states = [0] * (4 * -(-len(sensors) // 4))
        values = b""
        for i, (sensor, _, size) in enumerate(sensors):
            value = cycle.get(sensor)
            states[i] = 0 if value is None else 1 if value == SAME else 2
            if states[i] == 2:
                values += struct.pack(order + CODES[size], value)
        packed = bytes(a << 6 | b << 4 | c << 2 | d for a, b, c, d in zip(*[iter(states)] * 4, strict=True))
        data += b"d" + packed + values
    return Made(data + mark, text, crc_of(text), [*places, len(data)])


def packed(data: bytes, block: int = 32768) -> bytes:
    """Compressed as gliders do: LZ4 blocks, each after its length in two bytes."""
    import lz4.block

    blocks = [lz4.block.compress(data[at : at + block], store_size=False) for at in range(0, len(data), block)]
    return b"".join(len(piece).to_bytes(2, "big") + piece for piece in blocks)


def dive(count: int = 12) -> list[Cycle]:
    """Navigation: the first cycle tells all, then it goes down, with one fix in the third."""
    first: Cycle = {
        "m_present_time": START, "m_depth": 7.0, "m_pitch": 0.5, "m_gps_status": 1, "m_gps_lat": 69696969.0,
        "m_gps_lon": 69696969.0,
    }  # fmt: skip
    rest: list[dict[str, float | str]] = [
        {"m_present_time": START + 4.0 * i, "m_depth": 0.5 * i, "m_pitch": SAME if i % 3 == 0 else -0.4 - 0.01 * i}
        for i in range(1, count)
    ]
    rest[1] |= {"m_gps_status": 0, "m_gps_lat": 5440.5, "m_gps_lon": -646.25}
    return [first, *rest]


def cast(count: int = 8) -> list[Cycle]:
    """Science: the first cycle tells all, then samples of a CTD going down."""
    return [
        {
            "sci_m_present_time": START + 1.0 + 2.0 * i, "sci_water_temp": 18.0 - 0.1 * i,
            "sci_water_cond": 4.4 + 0.01 * i, "sci_water_pressure": 0.2 * i,
        }
        for i in range(count)
    ]  # fmt: skip
