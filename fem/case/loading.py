"""The [loading] section: one slide, or a list of phases that may be repeated."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import (
    Discriminator,
    Field,
    SerializerFunctionWrapHandler,
    Tag,
    field_validator,
    model_serializer,
    model_validator,
)

from fem.case.base import Finite, Positive, Section, Within, refuse, refuse_sentence
from fem.case.errors import describe
from fem.case.signals import Signal, digest, read_signal
from materials.plausible import PRESSURE, SLIDING_DISTANCE, SPEED

#: Duration of pressing [s] and distance of acceleration [mm], unless a phase says otherwise.
PRESSING_TIME = 0.05
ACCELERATION_DISTANCE = 0.5
#: Keys of the single slide.
_SLIDE = ("mean_pressure_N_per_mm2", "velocity_mm_per_s", "distance_mm")
#: Phases that an event may have, repeats included.
_MOST_PHASES = 20_000

_Pressure = Annotated[Positive, Within(PRESSURE)]
_Velocity = Annotated[Finite, Within(SPEED)]
_Distance = Annotated[Positive, Within(SLIDING_DISTANCE)]
_Time = Annotated[Positive, Field(ge=1e-6, le=1e6)]
_Film = Annotated[float, Field(ge=0.0, le=1e4, allow_inf_nan=False)]


class Press(Section):
    """Press the block on the road at rest; from the air it touches down first."""

    kind: Literal["press"] = "press"
    mean_pressure_N_per_mm2: _Pressure = Field(description="pressure on the top [N/mm^2]")
    time_s: _Time = Field(PRESSING_TIME, description="duration [s]")

    @property
    def duration(self) -> float:
        """Duration [s]."""
        return self.time_s


class Slide(Section):
    """Slide the block; at velocity 0 hold it."""

    kind: Literal["slide"] = "slide"
    velocity_mm_per_s: Annotated[Finite, Within(replace(SPEED, zero=True))] = Field(
        description="sliding velocity [mm/s]; negative slides to the left, 0 holds"
    )
    distance_mm: _Distance | None = Field(None, description="sliding distance [mm]")
    time_s: _Time | None = Field(None, description="duration [s], instead of a distance")
    acceleration_distance_mm: Annotated[float, Field(ge=0.0, le=1e4, allow_inf_nan=False)] = Field(
        ACCELERATION_DISTANCE, description="over which the velocity is reached; 0: at once [mm]"
    )

    @property
    def distance(self) -> float:
        """Distance slid, accelerations left out [mm]."""
        if self.distance_mm is not None:
            return self.distance_mm
        return abs(self.velocity_mm_per_s) * (self.time_s or 0.0)

    @property
    def duration(self) -> float:
        """Duration, accelerations left out [s]."""
        return self.time_s or self.distance / abs(self.velocity_mm_per_s)

    @model_validator(mode="after")
    def _one_length(self) -> Slide:
        if (self.distance_mm is None) == (self.time_s is None):
            found = "both" if self.time_s is not None else "neither"
            refuse("distance_mm", f"{found} of distance_mm and time_s", "one of them")
        if self.velocity_mm_per_s == 0.0 and self.time_s is None:
            refuse("velocity_mm_per_s", "0 over a distance", "time_s for a block that is held")
        return self


class Lift(Section):
    """Raise the block until nothing touches, and let it rest in the air."""

    kind: Literal["lift"] = "lift"
    time_s: _Time = Field(description="time without contact [s]")
    convection_W_per_m2K: _Film | None = Field(
        None, description="film coefficient meanwhile; default that of [heat] [W/(m^2 K)]"
    )

    @property
    def duration(self) -> float:
        """Duration [s]."""
        return self.time_s


class Record(Section):
    """Follow velocity and pressure as a rig measured them; without pressure the block is in air."""

    kind: Literal["record"] = "record"
    file: Annotated[str, Field(min_length=1)] = Field(
        description="CSV with time_s, velocity_mm_per_s, mean_pressure_N_per_mm2"
    )
    sha256: str | None = Field(None, description="of the file, which a resolved case names")

    @model_validator(mode="after")
    def _readable(self) -> Record:
        try:
            found = digest(self.file)
            read_signal(self.file, found)
        except ValueError as error:
            refuse_sentence("file", describe(self.file), error)
        if self.sha256 is not None and self.sha256 != found:
            refuse("sha256", f"{found} of the file", f"{self.sha256} (or no sha256)")
        self.__dict__["sha256"] = found
        return self

    @property
    def signal(self) -> Signal:
        """What was measured."""
        return read_signal(self.file, self.sha256 or digest(self.file))

    @property
    def distance(self) -> float:
        """Way of the platen, in air too [mm]."""
        return float(self.signal.path[-1])

    @property
    def duration(self) -> float:
        """Duration [s]."""
        return self.signal.duration


PhaseKind = Press | Slide | Lift | Record


def _kind(value: object) -> str:
    """Tag of a phase."""
    return f"<{value.get('kind') if isinstance(value, dict) else getattr(value, 'kind', '')}>"


_Phase = Annotated[
    Annotated[Press, Tag("<press>")]
    | Annotated[Slide, Tag("<slide>")]
    | Annotated[Lift, Tag("<lift>")]
    | Annotated[Record, Tag("<record>")],
    Discriminator(_kind),
]


class Loading(Section):
    """What is done to the block. The only section that must be given.

    Either one slide (`mean_pressure_N_per_mm2`, `velocity_mm_per_s`, `distance_mm`), or phases;
    then these three are the largest pressure, the first velocity other than 0, and the distance
    of all slides.
    """

    mean_pressure_N_per_mm2: _Pressure = Field(
        math.nan,
        validate_default=False,
        description="pressure on the top of the block, averaged over its length [N/mm^2]",
    )
    velocity_mm_per_s: _Velocity = Field(
        math.nan,
        validate_default=False,
        description="sliding velocity [mm/s]; negative slides to the left",
    )
    distance_mm: _Distance = Field(
        math.nan, validate_default=False, description="sliding distance of the platen [mm]"
    )
    top: Literal["platen", "pressure"] = Field(
        "platen",
        description='"platen": rigid plate glued to the top; "pressure": free, uniformly pressed',
    )
    repeat: Annotated[int, Field(ge=1, le=_MOST_PHASES)] = Field(
        1, description="how often the phases follow one another [-]"
    )
    road: Literal["fresh", "same"] = Field(
        "fresh", description='what the block comes down on: "fresh" road, or the "same" track'
    )
    phase: Annotated[tuple[_Phase, ...], Field(strict=False, max_length=_MOST_PHASES)] = Field(
        (), description="press, slide, lift, in order"
    )

    @field_validator("velocity_mm_per_s", mode="before")
    @classmethod
    def _moves(cls, value: Any) -> Any:
        if isinstance(value, int | float) and value == 0:
            refuse("", str(value), "a velocity other than zero (negative slides to the left)")
        return value

    @model_validator(mode="after")
    def _one_slide_or_phases(self) -> Loading:
        if self.phase:
            for key in _SLIDE:
                if key in self.model_fields_set:
                    refuse(key, describe(getattr(self, key)), "none beside [[loading.phase]]")
            self._refuse_order()
            self.__dict__.update(self._summary())
            return self
        for key in ("repeat", "road"):
            if key in self.model_fields_set:
                refuse(key, describe(getattr(self, key)), "[[loading.phase]] that it is said of")
        for key in _SLIDE:
            if key not in self.model_fields_set:
                refuse(key, "nothing", "this key: it has no default")
        return self

    def _refuse_order(self) -> None:
        """Phases that cannot follow one another."""
        pressed = False
        for number, phase in enumerate(self.phase):
            key = f"phase.{number}.kind"
            if isinstance(phase, Press):
                pressed = True
            elif isinstance(phase, Record):
                stretches = phase.signal.contacts()
                pressed = stretches[-1][2]
                if self.top == "pressure" and not all(on for *_, on in stretches):
                    refuse(key, 'a lift with top = "pressure"', 'top = "platen", which can lift')
            elif not pressed:
                refuse(key, f'"{phase.kind}" of a block that is not pressed', '"press" before it')
            elif isinstance(phase, Lift):
                pressed = False
                if self.top == "pressure":
                    refuse(key, '"lift" with top = "pressure"', 'top = "platen", which can lift')
        if not any(_velocities(self.phase)):
            refuse("phase", "no phase that slides", 'one of kind "slide" with a velocity')
        if self.repeat * len(self.phase) > _MOST_PHASES:
            found = f"{self.repeat} times {len(self.phase)} phases"
            refuse("repeat", found, f"at most {_MOST_PHASES} phases in all")

    def _summary(self) -> dict[str, float]:
        """The keys of a single slide, of phases."""
        pressures = [p.mean_pressure_N_per_mm2 for p in self.phase if isinstance(p, Press)]
        pressures += [float(p.signal.p.max()) for p in self.phase if isinstance(p, Record)]
        velocity = next(v for v in _velocities(self.phase) if v)
        distance = sum(p.distance for p in self.phase if isinstance(p, Slide | Record))
        return dict(zip(_SLIDE, (max(pressures), velocity, self.repeat * distance), strict=True))

    @model_serializer(mode="wrap")
    def _as_given(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        hidden = self.hidden
        return {key: value for key, value in handler(self).items() if key not in hidden}

    @property
    def hidden(self) -> tuple[str, ...]:
        """Keys that the other way of saying it has."""
        return _SLIDE if self.phase else ("repeat", "road", "phase")

    @property
    def phases(self) -> tuple[PhaseKind, ...]:
        """The phases of one repeat; of a single slide, pressing and sliding."""
        if self.phase:
            return self.phase
        return (
            Press(mean_pressure_N_per_mm2=self.mean_pressure_N_per_mm2),
            Slide(velocity_mm_per_s=self.velocity_mm_per_s, distance_mm=self.distance_mm),
        )

    @property
    def speed(self) -> float:
        """Largest speed of a slide [mm/s]."""
        return max(map(abs, _velocities(self.phases)))

    @property
    def last_velocity(self) -> float:
        """Velocity at the end of the last contact [mm/s]."""
        last = next(phase for phase in reversed(self.phases) if not isinstance(phase, Lift))
        if isinstance(last, Record):
            ends = [end for _, end, on_road in last.signal.contacts() if on_road]
            return last.signal.at(last.signal.v, ends[-1])
        return last.velocity_mm_per_s if isinstance(last, Slide) else 0.0

    @property
    def duration_s(self) -> float:
        """Time of the event, accelerations left out [s]."""
        return self.repeat * sum(p.duration for p in self.phases)


def _velocities(phases: tuple[PhaseKind, ...]) -> list[float]:
    """Velocity of each slide, and that of each record that has the largest size [mm/s]."""
    found = [p.velocity_mm_per_s for p in phases if isinstance(p, Slide)]
    records = [p.signal.v for p in phases if isinstance(p, Record)]
    return [*found, *(float(v[np.argmax(np.abs(v))]) for v in records)]
