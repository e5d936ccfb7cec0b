"""How is one number of a vehicle file checked? Its unit, its shape and its physical range, in one place.

In a file a quantity is ``{ value = 54.28, unit = "kg", source = "Table 1" }``; source, symbol and note are for people.
A number without a unit is refused in a file. In Python a plain number is taken as SI.
"""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any, NoReturn

from pydantic_core import PydanticCustomError, core_schema

from glidercli.units import DBAR, DEGREE

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler

__all__ = ["Quantity"]

_TO_SI = {"deg": DEGREE, "deg/s": DEGREE, "1/dbar": 1.0 / DBAR, "mm/s": 1e-3, "cm3/s": 1e-6, "MJ": 1e6}
"""Units of vehicle files that are not SI already, as the factor to SI (rad, rad/s, 1/Pa, m/s, m3/s, J)."""

_NOTES = ("source", "symbol", "note", "restored")


@dataclasses.dataclass(frozen=True)
class Quantity:
    """A checked quantity; used as ``Annotated[float, Quantity("kg", 0.1, 1e5)]``.

    unit : the unit that a file must state.
    minimum, maximum : physical range in that unit, both allowed.
    size : 1 for a number, 3 for a vector or the diagonal of a matrix, 0 for a list of any length.
    """

    unit: str
    minimum: float
    maximum: float
    size: int = 1

    @property
    def allowed(self) -> str:
        """The range as text."""
        numbers = "" if self.size == 1 else f"{self.size} numbers, each " if self.size else "a list of numbers, each "
        return f"{numbers}{self.minimum:g}..{self.maximum:g} {self.unit}"

    def in_file(self, value: float) -> float:
        """A number in SI as a file gives it, in its unit."""
        return value / _TO_SI.get(self.unit, 1.0)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        """Let pydantic call ``check`` and collect what it refuses."""
        return core_schema.with_info_plain_validator_function(self.check)

    def check(self, given: Any, info: Any) -> float | tuple[float, ...]:
        """The value in SI; refuses a wrong unit, key, shape or range with all that is allowed."""
        to_si = _TO_SI.get(self.unit, 1.0)
        if isinstance(given, dict):
            value: Any = given.get("value")
            unit = given.get("unit")
            unknown = [key for key in given if key not in ("value", "unit", *_NOTES)]
            if unknown:
                self._refuse(f"has unknown key {', '.join(unknown)}; known are value, unit, {', '.join(_NOTES)}")
            if unit is None:
                self._refuse(f"has no unit; {self.unit} is needed")
            if unit != self.unit:
                self._refuse(f"has unit {unit!r}, needed is {self.unit!r}")
        elif info.context is not None:
            self._refuse(f"= {given!r} has no unit; write {{ value = {given!r}, unit = {self.unit!r} }}")
        else:
            scalar = isinstance(given, (int, float))
            value = given / to_si if scalar else [item / to_si for item in given]
        numbers: list[Any] = list(value) if isinstance(value, (list, tuple)) else [value]
        right_kind = all(isinstance(n, (int, float)) and not isinstance(n, bool) and math.isfinite(n) for n in numbers)
        right_size = len(numbers) == self.size or (not self.size and len(numbers) > 0)
        if not right_size or isinstance(value, (list, tuple)) != (self.size != 1) or not right_kind:
            self._refuse(f"= {value!r}, allowed {self.allowed}")
        if not all(self.minimum <= n <= self.maximum for n in numbers):
            self._refuse(f"= {value!r} {self.unit}, allowed {self.allowed}")
        si = tuple(float(n) * to_si for n in numbers)
        return si[0] if self.size == 1 else si

    def _refuse(self, what: str) -> NoReturn:
        raise PydanticCustomError("quantity", "{what}", {"what": what})
