"""The case: everything a simulation needs to know, frozen, checked, with its units.

A case file is TOML in the paper's units, the unit in each key's name. The conversion to the
units of the calculation (N, mm, s, t, K) happens in the properties of the sections, nowhere else.
"""

from __future__ import annotations

import copy
import hashlib
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field, PrivateAttr, ValidationError, model_validator

from fem.case.base import Section, refuse, refuse_finding
from fem.case.block import Block
from fem.case.friction import Friction, enter_laws
from fem.case.heat import Heat
from fem.case.loading import Loading
from fem.case.reading import Source, absolute_files, apply_overrides, find_mesh_file, read_toml
from fem.case.rubber import Rubber
from fem.case.sections import Output, Pyrometer, Road, Solver, Wear
from fem.case.validation import case_error, refuse_unknown_keys
from fem.case.writing import section_lines
from materials.plausible import FRICTION, Finding, judge

#: Mean pressure over initial shear modulus beyond which no rubber block keeps its shape [-].
_HARDEST_PRESS = 10.0
#: Pressure at the leading corner over the mean pressure that a friction law has to bear [-].
_PEAK_PRESSURE = 100.0


_SECTIONS = ("block", "rubber", "road", "friction", "heat", "wear", "pyrometer")


class Case(Section):
    """One sliding event of one tread block.

    Attributes
    ----------
    block, rubber, road, friction, heat, wear, loading, solver, output : Section
        The tables of the case file, in its units.
    pyrometer : Section or None
        Only where the case has one.

    Examples
    --------
    >>> loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 50.0, "distance_mm": 10.0}
    >>> case = Case.from_dict({"loading": loading}).with_overrides({"friction.law": "exponential"})
    >>> case.friction.law, case.block.length_mm
    ('exponential', 20.0)
    """

    loading: Loading
    block: Block = Field(Block())
    rubber: Rubber = Field(default_factory=Rubber)
    road: Road = Field(Road())
    friction: Friction = Field(default_factory=Friction)
    heat: Heat = Field(Heat())
    wear: Wear = Field(Wear())
    pyrometer: Pyrometer | None = Field(None)
    solver: Solver = Field(Solver())
    output: Output = Field(Output())

    _source: str = PrivateAttr(default="case")

    @model_validator(mode="after")
    def _makes_sense_together(self) -> Case:
        pressure = self.loading.mean_pressure_N_per_mm2
        modulus = self.rubber.model().initial_shear_modulus
        if pressure > _HARDEST_PRESS * modulus:
            refuse(
                "loading.mean_pressure_N_per_mm2",
                str(pressure),
                f"at most {_HARDEST_PRESS * modulus:.4g} N/mm^2, ten times the shear modulus",
            )
        self._refuse_negative_friction()
        if self.pyrometer is not None and self.loading.last_velocity == 0.0:
            found = "a block that stands at the end of its last contact"
            refuse("pyrometer", found, "one that slides, and runs off the road at its speed")
        pole = self.friction.pole_C
        if self.friction.wlf and self.heat.ambient_C <= pole:
            refuse(
                "heat.ambient_C",
                str(self.heat.ambient_C),
                f"above {pole:.6g}, where the WLF shift of [friction] ends",
            )
        memory = self.rubber.viscoelastic
        if memory is not None and self.heat.ambient_C <= memory.pole_C:
            refuse(
                "heat.ambient_C",
                str(self.heat.ambient_C),
                f"above {memory.pole_C:.6g}, where the shift of [rubber] viscoelastic ends",
            )
        return self

    def _refuse_negative_friction(self) -> None:
        """Friction that pushes the block, or is infinite, at a pressure or speed of the run."""
        law, loading = self.friction.plain_law(), self.loading
        pressure, speed = loading.mean_pressure_N_per_mm2, loading.speed
        p = np.geomspace(law.p_min, max(_PEAK_PRESSURE * pressure, 2.0 * law.p_min), 60)
        v = np.geomspace(law.v_min, max(speed, 2.0 * law.v_min), 20)[:, None]
        with np.errstate(all="ignore"):
            mu = law.coefficient(p, v)
        wrong = np.argwhere(~(np.isfinite(mu) & (mu >= 0.0)))
        if wrong.size:
            i, j = wrong[0]
            found = f"{self.friction.law} with the coefficient {mu[i, j]:.3g} at "
            found += f"{p[j]:.3g} N/mm^2 and {v[i, 0]:.3g} mm/s"
            expected = "a coefficient of 0 or more at every pressure and speed of the run"
            refuse("friction.law", found, f"{expected} (to {p[-1]:.3g} N/mm^2)")
        finding = self._friction()
        if finding is not None and finding.impossible:
            found = f"{self.friction.law} with the coefficient {finding.value:.3g} at the mean"
            refuse_finding("friction.law", f"{found} pressure", finding)

    def _friction(self) -> Finding | None:
        """Judgement of the coefficient at the mean pressure and the velocity of the slide."""
        loading, law = self.loading, self.friction.plain_law()
        mu = law.coefficient(loading.mean_pressure_N_per_mm2, loading.velocity_mm_per_s)
        return judge(mu, FRICTION)

    def unusual(self) -> Iterator[tuple[str, Finding]]:
        """Keys whose numbers are possible but unusual, with what is unusual about them."""
        yield from super().unusual()
        finding = self._friction()
        if finding is not None and self.friction.law != "coulomb":
            yield "friction.law", finding

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is unusual about the case, a sentence each that begins with the key."""
        return tuple(f"{key}: {finding.sentence}" for key, finding in self.unusual())

    @property
    def source(self) -> str:
        """Name of the file (or of the caller) the case came from."""
        return self._source

    @classmethod
    def from_toml(cls, path: str | Path, overrides: Mapping[str, Any] | None = None) -> Case:
        """Read a case file.

        Parameters
        ----------
        path : str or Path
            The TOML file.
        overrides : mapping, optional
            Dotted keys to values that win over the file, e.g.
            ``{"loading.velocity_mm_per_s": 50.0}``.

        Raises
        ------
        CaseError
            With file, key, what was found and what was expected, in one line.
        """
        path = Path(path)
        source = Source(tables=read_toml(path), file=str(path), folder=path.absolute().parent)
        return cls._from_source(source, overrides)

    @classmethod
    def from_dict(
        cls,
        tables: Mapping[str, Any],
        *,
        source: str = "case",
        folder: str | Path = ".",
        overrides: Mapping[str, Any] | None = None,
    ) -> Case:
        """Build a case from nested dictionaries with the keys of the case file.

        Parameters
        ----------
        tables : mapping
            Section names to mappings of keys.
        source : str
            Name used in error messages.
        folder : str or Path
            What relative references to parameter files are relative to.
        overrides : mapping, optional
            Dotted keys to values that win over `tables`.
        """
        raw = copy.deepcopy(dict(tables))
        return cls._from_source(Source(tables=raw, file=source, folder=Path(folder)), overrides)

    @classmethod
    def _from_source(cls, source: Source, overrides: Mapping[str, Any] | None) -> Case:
        enter_laws(Case)
        apply_overrides(source, dict(overrides or {}))
        absolute_files(source)
        find_mesh_file(source)
        refuse_unknown_keys(source, cls)
        try:
            case = cls.model_validate(source.tables)
        except ValidationError as error:
            raise case_error(error, source) from None
        case._source = source.file
        return case

    def with_overrides(self, overrides: Mapping[str, Any]) -> Case:
        """Return a case that differs in the given dotted keys."""
        return Case.from_dict(self.to_dict(), source=self.source, overrides=overrides)

    def to_dict(self) -> dict[str, Any]:
        """Return the resolved case as nested dictionaries with the keys of the case file."""
        tables = self.model_dump(exclude_none=True, by_alias=True)
        if self.block.file is not None:
            # What was not given is that of the file, which has not been looked at here.
            for key in {"length_mm", "height_mm"} - self.block.model_fields_set:
                del tables["block"][key]
        return tables

    def physics(self) -> dict[str, Any]:
        """Return the tables of the resolved case that decide the result, all but ``output``."""
        return _content({name: table for name, table in self.to_dict().items() if name != "output"})

    def to_toml(self, heading: str = "Resolved case: every key as it is used.") -> str:
        """Return the resolved case as TOML with a comment of meaning and unit at each key."""
        lines = [f"# {line}".rstrip() for line in heading.splitlines()]
        for name in (*_SECTIONS, "loading", "solver", "output"):
            if (section := getattr(self, name)) is not None:
                lines += ["", *section_lines(name, section)]
        return "\n".join(lines) + "\n"

    def __eq__(self, other: object) -> bool:
        """Compare what is simulated; where it was read from does not matter."""
        return isinstance(other, Case) and self.to_dict() == other.to_dict()

    def __hash__(self) -> int:
        return hash(self.hash())

    def hash(self) -> str:
        """Return the SHA-256 of what decides the result: of all resolved keys but `[output]`."""
        canonical = json.dumps(self.physics(), sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(canonical.encode()).hexdigest()


def _content(tables: dict[str, Any]) -> dict[str, Any]:
    """Tables in which a mesh file counts by its content, not by where it lies."""
    if "file" not in tables["block"]:
        return tables
    left_out = ("file", "length_mm", "height_mm")
    block = {key: value for key, value in tables["block"].items() if key not in left_out}
    return {**tables, "block": block}
