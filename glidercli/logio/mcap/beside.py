"""What is told of several Logs together in Foxglove's messages? Each flight, in one scene; and the errors between them.

The first has the usual topics, and is what the file is read back as. What belongs to the others stands under /beside/1,
/beside/2 and so on, in frames and messages of their own (``beside_1/base_link_fsd``, ``beside_1.Navigation``); errors
under /difference/1/CHANNEL, in messages ``difference.CHANNEL``.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.logio.apart import apart, in_km
from glidercli.logio.labels import labels
from glidercli.logio.mcap.contents import Contents, Line, log_topic
from glidercli.logio.mcap.file import Topic
from glidercli.logio.mcap.messages import Table, own_class
from glidercli.logio.mcap.primitives import Colour
from glidercli.logio.mcap.side import Side
from glidercli.logio.mcap.topics import template_of
from glidercli.logio.rerun import colours as look
from glidercli.residuals import Residuals

__all__ = ["BESIDE", "Beside"]

BESIDE = "beside "
"""Of the name of the metadata record of a flight beside the first; its number follows."""
_DOUBLE = 1
"""Number of the type double in a description of messages."""


class Beside:
    """The topics of a log, which comes whole, of others beside it, and of their errors.

    log, others : with a sample each. names : what to call each; default: its kind. errors : of each of the others
    against the log, by channel, in the table's unit.
    """

    def __init__(
        self, log: Log, others: Sequence[Log], names: Sequence[str], errors: Sequence[Mapping[str, Residuals]]
    ) -> None:
        if len(errors) != len(others) or (names and len(names) != len(others) + 1):
            raise InputError("beside", f"{len(errors)} errors, {len(names)} names for {len(others)} logs beside one")
        if not all(any(map(len, other.channels.values())) for other in others):
            raise InputError("beside", "a log holds no sample")
        self._others, self._errors, self._names = others, errors, names
        self._labels = [labels(number, [log, *others], names) for number in range(len(others) + 1)]
        self._apart = [apart(log, other) for other in others]
        self._contents = [Contents(log, Side("", self._labels[0][1], _colour(0)))]
        for number, (other, far) in enumerate(zip(others, self._apart, strict=True), 1):
            about = log.place if far is None else None
            side = Side(f"/beside/{number}", self._labels[number][1], _colour(number), about)
            self._contents.append(Contents(other, side))

    def told(self) -> dict[str, dict[str, str]]:
        """Metadata records of what stands beside the log: what each is called, its own metadata and origins."""
        found = {}
        for number, other in enumerate(self._others, 1):
            label, short = self._labels[number]
            found[f"{BESIDE}{number}"] = {
                "name": label, "short_name": short, "log": other.kind, "colour": look.NAMES[_chosen(number)],
                "topics": f"/beside/{number}", "errors": f"/difference/{number}",
            }  # fmt: skip
            found[f"run of beside {number}"] = dict(other.metadata)
            origins = {name: channel.origin for name, channel in other.channels.items()}
            found[f"origin of beside {number}"] = {"log": other.origin, "channels": " ".join(origins), **origins}
        return found

    def samples(self, log: Log) -> Iterator[list[Topic]]:
        """The messages of all logs, some topics at a time. log : the first, as a whole."""
        each = [one.samples(part) for one, part in zip(self._contents, (log, *self._others), strict=True)]
        for topics in itertools.zip_longest(*each, fillvalue=[]):
            yield list(itertools.chain(*topics))
        for number, errors in enumerate(self._errors, 1):
            yield [self._error(number, one) for one in errors.values() if len(one.error)]

    def whole(self, log: Log) -> list[Topic]:
        """What can be told at the end. log : the first, as a whole, with its final metadata."""
        for other in self._contents[1:]:
            self._contents[0].scene.make_room(other.scene.bounds)
        lines: list[Line] = []
        topics: list[Topic] = []
        for number, (one, part) in enumerate(zip(self._contents, (log, *self._others), strict=True)):
            ((at, statement, by), *said), drawn = one.parts(part)
            lines.append((at, f"{self._names[number]}: {statement}" if self._names else statement, by))
            lines += [(at, f"{self._labels[number][1]}: {text}", by) for at, text, by in said]
            topics += drawn
        lines += self._remarks()
        return [log_topic(sorted(lines, key=lambda line: line[0])), *topics]

    def _remarks(self) -> Iterator[Line]:
        """What a viewer of them all must know."""
        for number, other in enumerate(self._others, 1):
            short, at = self._labels[number][1], other.start_ns
            for key in ("clock_note", "comparison_note"):
                if key in other.metadata:
                    yield at, f"{short}: {other.metadata[key]}", "compare"
            if (far := self._apart[number - 1]) is not None:
                told = f"{short} began {in_km(far.distance)} from {self._labels[0][1]}: drawn FROM ONE START"
                yield at, f"{told}; the map has both where they were", "scene"

    def _error(self, number: int, errors: Residuals) -> Table:
        """One channel's errors at the times of the first log's samples; NaN where there is nothing to compare with."""
        spec = CHANNELS[errors.name]
        kind = own_class(errors.name.capitalize(), [(spec.column, 2, _DOUBLE)], "difference")
        template, _ = template_of(kind)
        times, values = errors.with_gaps()
        notes = {
            spec.column: f"{self._labels[number][0]} less {self._labels[0][0]}, {errors.unit}; {spec.meaning}",
            "compared": f"{len(errors.error)}",
            "not compared (NaN)": f"{errors.outside} outside, {errors.gap} in gaps of the simulated samples",
            "root of the mean square": f"{float(np.sqrt(np.mean(errors.error**2)))!r} {errors.unit}",
        }
        return Table(f"/difference/{number}/{errors.name}", times, template, [values], notes)


def _chosen(number: int) -> look.Colour:
    return look.OVERLAID[number % len(look.OVERLAID)]


def _colour(number: int) -> Colour:
    red, green, blue = (part / 255.0 for part in _chosen(number))
    return red, green, blue, 1.0
