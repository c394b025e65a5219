"""The [rubber] section: a named compound or a model with its constants, and thermal data."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from fem.case.base import (
    Constant,
    Factor,
    Positive,
    Section,
    Within,
    given,
    refuse,
    refuse_finding,
    refuse_sentence,
)
from fem.case.errors import describe, suggestion
from fem.case.memory import Mullins, Viscoelastic
from fem.case.window import RubberWindow
from materials.compounds import COMPOUNDS, compound
from materials.hyperelastic import (
    ArrudaBoyce,
    Hyperelastic,
    MooneyRivlin,
    NeoHooke,
    VanDerWaals,
    Yeoh,
)
from materials.material import Material
from materials.ogden import Ogden
from materials.plausible import (
    CONDUCTIVITY,
    RUBBER_DENSITY,
    SHEAR_MODULUS,
    SPECIFIC_HEAT,
    Finding,
    judge,
)
from materials.rubber import Rubber as RememberingRubber
from materials.thermal import ThermalProperties

DEFAULT_COMPOUND = "yeoh-bars-series-1-load"

#: Constants each model needs, and those it may have.
CONSTANTS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "neo-hooke": (("G_N_per_mm2",), ()),
    "mooney-rivlin": (("C10_N_per_mm2", "C01_N_per_mm2"), ()),
    "yeoh": (("C10_N_per_mm2", "C20_N_per_mm2", "C30_N_per_mm2"), ()),
    "van-der-waals": (("G_N_per_mm2", "lambda_m", "a"), ("beta",)),
    "arruda-boyce": (("C1_N_per_mm2", "lambda_m"), ()),
    "ogden": (("mu_N_per_mm2", "alpha"), ()),
}
ALL_CONSTANTS = tuple(dict.fromkeys(k for pair in CONSTANTS.values() for k in pair[0] + pair[1]))
_MODELS = {
    "neo-hooke": NeoHooke,
    "mooney-rivlin": MooneyRivlin,
    "yeoh": Yeoh,
    "van-der-waals": VanDerWaals,
    "arruda-boyce": ArrudaBoyce,
    "ogden": Ogden,
}


class Rubber(Section):
    """Hyperelastic model and thermal data of the tread compound."""

    compound: str | None = Field(None, description="named parameter set of the paper's Table 1")
    model_name: (
        Literal["neo-hooke", "mooney-rivlin", "yeoh", "van-der-waals", "arruda-boyce", "ogden"]
        | None
    ) = Field(None, alias="model", description="hyperelastic model, instead of a compound")
    C10_N_per_mm2: Constant | None = Field(None, description="first invariant, linear [N/mm^2]")
    C01_N_per_mm2: Constant | None = Field(None, description="second invariant, linear [N/mm^2]")
    C20_N_per_mm2: Constant | None = Field(None, description="first invariant, squared [N/mm^2]")
    C30_N_per_mm2: Constant | None = Field(None, description="first invariant, cubed [N/mm^2]")
    G_N_per_mm2: Factor | None = Field(None, description="initial shear modulus [N/mm^2]")
    C1_N_per_mm2: Constant | None = Field(None, description="Arruda-Boyce, factor [N/mm^2]")
    lambda_m: Annotated[float, Field(gt=1.0, le=1e6, allow_inf_nan=False)] | None = Field(
        None, description="locking stretch [-]"
    )
    a: Constant | None = Field(None, description="global interaction parameter [-]")
    beta: Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)] | None = Field(
        None, description="share of the second invariant [-]"
    )
    mu_N_per_mm2: list[Constant] | None = Field(
        None, description="Ogden, moduli whose sum is the shear modulus [N/mm^2]"
    )
    alpha: list[Constant] | None = Field(None, description="Ogden, exponents of the stretches [-]")
    viscoelastic: Viscoelastic | None = Field(
        None, description="Maxwell branches: a table with g and tau_s"
    )
    mullins: Mullins | None = Field(
        None, description="softening by the largest load so far: a table with r and m_N_per_mm2"
    )
    window: RubberWindow | None = Field(
        None, description="range the law was fitted to; a run says what leaves it"
    )
    bulk_ratio: Annotated[float, Field(gt=2.0 / 3.0, le=1e6, allow_inf_nan=False)] = Field(
        100.0, description="bulk modulus over initial shear modulus [-]"
    )
    conductivity_W_per_mK: Annotated[Positive, Within(CONDUCTIVITY)] = Field(
        0.284, description="thermal conductivity [W/(m K)]"
    )
    density_kg_per_m3: Annotated[Positive, Within(RUBBER_DENSITY)] = Field(
        1207.0, description="density [kg/m^3]"
    )
    specific_heat_kJ_per_kgK: Annotated[Positive, Within(SPECIFIC_HEAT)] = Field(
        1.45, description="specific heat [kJ/(kg K)]"
    )

    @model_validator(mode="before")
    @classmethod
    def _compound_or_model(cls, data: Any) -> Any:
        if not isinstance(data, dict):
            return data
        name, model = given(data, "compound"), given(data, "model")
        stray = [key for key in ALL_CONSTANTS if data.get(key) is not None]
        if model is None and stray:
            refuse(stray[0], describe(data[stray[0]]), "a model that this constant belongs to")
        if name is None and model is None:
            return {**data, "compound": DEFAULT_COMPOUND}
        if name is not None and model is not None:
            found = f"compound {describe(name)} and model {describe(model)}"
            refuse("compound", found, "either a compound or a model with its constants")
        if isinstance(name, str) and name not in COMPOUNDS:
            refuse("compound", describe(name), suggestion(name, COMPOUNDS))
        if isinstance(model, str) and model in CONSTANTS:
            _check_constants(model, data)
        return data

    @model_validator(mode="after")
    def _model_exists(self) -> Rubber:
        try:
            self.model()
        except ValueError as error:
            refuse_sentence("model", str(self.model_name or self.compound), error)
        finding = self._stiffness()
        if finding is not None and finding.impossible:
            found = f"constants with the shear modulus {finding.value:g} N/mm^2"
            refuse_finding(self._stiff_key, found, finding)
        return self

    def unusual(self) -> Iterator[tuple[str, Finding]]:
        """Keys whose numbers are unusual; the constants are judged by the shear modulus."""
        yield from super().unusual()
        finding = self._stiffness()
        if finding is not None:
            yield self._stiff_key, finding

    def _stiffness(self) -> Finding | None:
        return judge(self.model().initial_shear_modulus, SHEAR_MODULUS)

    @property
    def _stiff_key(self) -> str:
        return "compound" if self.model_name is None else CONSTANTS[self.model_name][0][0]

    def model(self) -> Hyperelastic:
        """Build the hyperelastic model [N/mm^2]."""
        if self.compound is not None:
            return compound(self.compound)
        assert self.model_name is not None
        required, optional = CONSTANTS[self.model_name]
        constants = {key: getattr(self, key) for key in required + optional}
        return _MODELS[self.model_name](
            **{
                key.removesuffix("_N_per_mm2"): tuple(value) if isinstance(value, list) else value
                for key, value in constants.items()
                if value is not None
            }
        )

    def material(self) -> Material:
        """Build the material of the elements: the law, with its memory where it has one."""
        if self.viscoelastic is None and self.mullins is None:
            return self.model()
        return RememberingRubber(
            elastic=self.model(),
            viscous=None if self.viscoelastic is None else self.viscoelastic.prony(),
            damage=None if self.mullins is None else self.mullins.softening(),
        )

    @property
    def bulk_modulus(self) -> float:
        """Bulk modulus K = bulk_ratio G0 [N/mm^2]."""
        return self.bulk_ratio * self.model().initial_shear_modulus

    @property
    def thermal(self) -> ThermalProperties:
        """Thermal properties in N, mm, s, t, K."""
        return ThermalProperties.from_paper_units(
            self.conductivity_W_per_mK, self.density_kg_per_m3, self.specific_heat_kJ_per_kgK
        )


def _check_constants(model: str, data: dict[str, Any]) -> None:
    required, optional = CONSTANTS[model]
    for key in required:
        if data.get(key) is None:
            refuse(key, "nothing", f'a number: model = "{model}" needs {", ".join(required)}')
    locking = data.get("lambda_m")
    if model == "van-der-waals" and isinstance(locking, (int, float)) and not locking**2 > 3.0:
        refuse("lambda_m", describe(locking), "a locking stretch above sqrt(3) = 1.7321")
    for key in ALL_CONSTANTS:
        if data.get(key) is not None and key not in required + optional:
            refuse(
                key,
                describe(data[key]),
                f'only constants of model = "{model}": {", ".join(required + optional)}',
            )
