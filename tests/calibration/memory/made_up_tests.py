"""Made-up tests of rubbers whose parameters are known, with noise."""

import numpy as np
import pandas as pd

from materials import WLF, NeoHooke, OgdenRoxburgh, Prony, Rubber, Yeoh

YEOH = {"C10": 0.35, "C20": -0.03, "C30": 0.006}


def spectrum(**values):
    count = len(values) // 2
    return Prony(
        g=[values[f"g{i}"] for i in range(1, count + 1)],
        tau_s=[values[f"tau{i}_s"] for i in range(1, count + 1)],
    )


#: Parameters behind each kind of test.
RELAXATION = {
    "G": 0.8,
    "g1": 0.5,
    "g2": 0.3,
    "g3": 0.2,
    "tau1_s": 0.05,
    "tau2_s": 2.0,
    "tau3_s": 80.0,
}
STEPWISE = {**YEOH, "g1": 0.5, "g2": 0.3, "tau1_s": 2.0, "tau2_s": 80.0}
CYCLES = {**YEOH, "g1": 0.6, "g2": 0.4, "g3": 0.3, "tau1_s": 0.3, "tau2_s": 5.0, "tau3_s": 90.0}
SWEEPS = {
    "slow_modulus_N_per_mm2": 2.0, "g1": 2.0, "g2": 1.0, "g3": 0.6, "g4": 0.4, "tau1_s": 1e-5,
    "tau2_s": 1e-3, "tau3_s": 0.1, "tau4_s": 8.0, "C1": 7.0, "C2_K": 130.0,
}  # fmt: skip
SOFTENING = {**YEOH, "r": 1.8, "m": 0.15, "beta": 0.2}


def split(values, *names):
    """The parameters with these names, and the others."""
    own = {name: values[name] for name in names}
    return own, {name: value for name, value in values.items() if name not in names}


def noisy(rubber, seed, noise, time, stretch, **columns):
    rng = np.random.default_rng(seed)
    stress = rubber.nominal_stress(time, stretch) + noise * rng.normal(size=len(time))
    return pd.DataFrame(
        {**columns, "time_s": time, "stretch": stretch, "nominal_stress_N_per_mm2": stress}
    )


def relaxation(seed, noise=0.003):
    """A step of stretch that is held."""
    law, branches = split(RELAXATION, "G")
    rubber = Rubber(elastic=NeoHooke(**law), viscous=spectrum(**branches))
    time = np.concatenate([[0.0, 0.0], np.geomspace(0.01, 1000.0, 150)])
    return noisy(rubber, seed, noise, time, np.append(1.0, np.full(151, 1.5)))


def stepwise_relaxation(seed, noise=0.003):
    """Steps up and down with holds."""
    law, branches = split(STEPWISE, *YEOH)
    time, stretch = [0.0], [1.0]
    for level in (1.2, 1.4, 1.6, 1.8, 1.5, 1.2):
        start, before = time[-1], stretch[-1]
        time += [*(start + np.linspace(0.1, 1.0, 10)), *(start + 1 + np.geomspace(0.2, 300.0, 40))]
        stretch += [*np.linspace(before, level, 11)[1:], *(40 * [level])]
    rubber = Rubber(elastic=Yeoh(**law), viscous=spectrum(**branches))
    return noisy(rubber, seed, noise, np.array(time), np.array(stretch))


def cycles(seed, noise=0.005):
    """Two cycles at each of three rates."""
    law, branches = split(CYCLES, *YEOH)
    rubber = Rubber(elastic=Yeoh(**law), viscous=spectrum(**branches))
    parts = []
    for i, rate in enumerate((0.5, 0.05, 0.005)):
        time = np.linspace(0.0, 3.2 / rate, 201)
        stretch = 1.0 + 0.8 * (1.0 - np.abs(1.0 - (time * rate / 0.8) % 2.0))
        parts.append(noisy(rubber, [seed, i], noise, time, stretch, test=f"{rate:g} per s"))
    return pd.concat(parts, ignore_index=True)


def sweeps(seed, noise=0.01, temperatures=(-10, 0, 10, 20, 35, 50, 70)):
    """Storage and loss moduli that carry the vertical shift."""
    law, values = split(SWEEPS, "slow_modulus_N_per_mm2", "C1", "C2_K")
    branches, shift = spectrum(**values), WLF(d1=law["C1"], d2_K=law["C2_K"])
    rng, parts = np.random.default_rng(seed), []
    for T in temperatures:
        f = np.geomspace(0.1, 50.0, 15)
        omega = 2 * np.pi * f * 10.0 ** shift.log10_shift_factor(T, 20.0)
        moduli = np.array(branches.harmonic_moduli(omega)) * law["slow_modulus_N_per_mm2"]
        moduli *= (T + 273.15) / 293.15 * np.exp(noise * rng.normal(size=moduli.shape))
        columns = {"modulus_N_per_mm2": moduli[0], "loss_modulus_N_per_mm2": moduli[1]}
        parts.append(pd.DataFrame({"T_C": T, "frequency_Hz": f, **columns}))
    return pd.concat(parts, ignore_index=True)


def softening_cycles(seed, noise=0.005):
    """Two cycles to each of two levels, and a path beyond."""
    law, values = split(SOFTENING, *YEOH)
    rubber = Rubber(elastic=Yeoh(**law), damage=OgdenRoxburgh(**values))
    levels = [1.0, 1.4, 1.0, 1.4, 1.0, 1.9, 1.0, 1.9, 1.0, 2.3]
    stretch = np.interp(np.linspace(0.0, 9.0, 181), np.arange(10), levels)
    table = noisy(rubber, seed, noise, np.arange(181.0), stretch)
    return table.drop(columns="time_s").assign(mode="uniaxial")
