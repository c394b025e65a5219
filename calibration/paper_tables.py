"""Tables 1 and 2 of the paper, recovered from synthetic data, and fits to real rubbers.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", Tables 1-2.
"""

from dataclasses import asdict
from pathlib import Path

import pandas as pd

from calibration.datasets import DATASETS, dataset_path
from calibration.fitting import FitResult
from calibration.friction import fit_friction
from calibration.rubber import compare_models, fit_hyperelastic
from calibration.synthetic import (
    FRICTION_NOISE,
    STRESS_NOISE_N_PER_MM2,
    TABLE_1,
    synthetic_friction,
    synthetic_stress,
)
from contact.friction import ExponentialFriction, HuemerFriction
from materials.compounds import COMPOUNDS

FRICTION_LAWS = {"exponential": ExponentialFriction(), "huemer": HuemerFriction()}
_SYNTHETIC = (
    "SYNTHETIC data: made from the paper's own parameters, with stated noise. They show that the\n"
    "calibration finds parameters that are known; they are no measurements."
)


def write_table1(directory: str | Path) -> list[Path]:
    """Write Table 1 (synthetic), the models side by side, and the fits to real rubbers."""
    parts = {
        "table1_synthetic": table1_synthetic(),
        "table1_synthetic_models_side_by_side": table1_upturn(),
        "table1_real_rubber": table1_real_rubber(),
    }
    text = [
        f"Table 1, recovered. {_SYNTHETIC}",
        f"Uniaxial, 200 points, noise {STRESS_NOISE_N_PER_MM2} N/mm^2. 'off' counts the standard",
        "errors from the paper's value; 'off_noise_free' is the relative error without noise.",
        "",
        _readable(parts["table1_synthetic"]),
        "",
        "Each model on the same synthetic bars (stabilised data of the named set): Mooney-Rivlin",
        "cannot follow the upturn, as the paper says.",
        "",
        _readable(parts["table1_synthetic_models_side_by_side"]),
        "",
        "All models on measured data of real rubbers, all modes at once, best AIC first:",
        *(f"  {name}: {what}" for name, what in DATASETS.items()),
        "",
        _readable(parts["table1_real_rubber"]),
    ]
    return _written(Path(directory), parts, "table1.txt", text)


def write_table2(directory: str | Path) -> list[Path]:
    """Write Table 2, recovered from synthetic friction tests."""
    parts = {"table2_synthetic": table2_synthetic()}
    text = [
        f"Table 2, recovered. {_SYNTHETIC}",
        "6 pressures (0.05-1 N/mm^2), 25 speeds (1-3000 mm/s), 4 repeats, noise of mu "
        f"{FRICTION_NOISE}.",
        "Huemer's law is fitted with a held at 0.9203: its scale is free.",
        "",
        _readable(parts["table2_synthetic"]),
    ]
    return _written(Path(directory), parts, "table2.txt", text)


def table1_synthetic(seed: int = 0) -> pd.DataFrame:
    """Parameters of Table 1 recovered from synthetic tests, a row per parameter."""
    stress_values = {name: asdict(model) for name, model in COMPOUNDS.items()}
    return pd.concat(
        [
            _recovered(name, stress_fit(name, seed), stress_fit(name, seed, noise=0.0), paper)
            for name, paper in stress_values.items()
        ],
        ignore_index=True,
    )


def table2_synthetic(seed: int = 0) -> pd.DataFrame:
    """Parameters of Table 2 recovered from synthetic tests, a row per parameter."""
    return pd.concat(
        [
            _recovered(name, friction_fit(name, seed), friction_fit(name, seed, noise=0.0), paper)
            for name, paper in friction_values().items()
        ],
        ignore_index=True,
    )


def table1_upturn() -> pd.DataFrame:
    """RMSE of every model on the bars, without and with the upturn in the data."""
    names = ("yeoh-bars-series-1", "yeoh-bars-series-2")
    models = ("mooney-rivlin", "neo-hooke", "yeoh", "van-der-waals")
    found = {f"synthetic {name}": compare_models(synthetic_stress(name), models) for name in names}
    return _below_each_other(found)


def table1_real_rubber() -> pd.DataFrame:
    """Every model on every published data set, simultaneously over the modes."""
    return _below_each_other({name: compare_models(dataset_path(name)) for name in DATASETS})


def _below_each_other(tables: dict[str, pd.DataFrame]) -> pd.DataFrame:
    """One table, its first column the names of the data."""
    for name, table in tables.items():
        table.insert(0, "data", name)
    return pd.concat(tables.values(), ignore_index=True)


def stress_fit(name: str, seed: int, noise: float = STRESS_NOISE_N_PER_MM2) -> FitResult:
    """Fit of a compound's own model to its synthetic test."""
    table = synthetic_stress(name, noise_N_per_mm2=noise, seed=seed)
    return fit_hyperelastic(table, TABLE_1[name].model)


def friction_fit(law: str, seed: int, noise: float = FRICTION_NOISE) -> FitResult:
    """Fit of a friction law to its synthetic tests."""
    table = synthetic_friction(FRICTION_LAWS[law], noise=noise, seed=seed)
    return fit_friction(table, law)


def friction_values() -> dict[str, dict[str, float]]:
    """Parameters of Table 2 by law."""
    floors = ("p_min", "v_min")
    return {
        name: {key: value for key, value in asdict(law).items() if key not in floors}
        for name, law in FRICTION_LAWS.items()
    }


def _recovered(
    name: str, noisy: FitResult, clean: FitResult, paper: dict[str, float]
) -> pd.DataFrame:
    intervals = noisy.interval()
    return pd.DataFrame(
        [
            {
                "set": name,
                "parameter": parameter,
                "paper": paper[parameter],
                "fitted": noisy.values[parameter],
                "stderr": noisy.stderr[parameter],
                "off": (noisy.values[parameter] - paper[parameter]) / noisy.stderr[parameter],
                "low_95": intervals[parameter][0],
                "high_95": intervals[parameter][1],
                "off_noise_free": clean.values[parameter] / paper[parameter] - 1.0,
                "rmse": noisy.rmse,
                "r2": noisy.r2,
            }
            for parameter in noisy.names
        ]
    )


def _readable(table: pd.DataFrame) -> str:
    return table.to_string(index=False, float_format=lambda value: f"{value:.6g}")


def _written(
    directory: Path, parts: dict[str, pd.DataFrame], name: str, text: list[str]
) -> list[Path]:
    directory.mkdir(parents=True, exist_ok=True)
    paths = []
    for part, table in parts.items():
        paths.append(directory / f"{part}.csv")
        table.to_csv(paths[-1], index=False)
    paths.append(directory / name)
    paths[-1].write_text("\n".join(text) + "\n", encoding="utf-8")
    return paths
