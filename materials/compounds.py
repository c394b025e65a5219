"""Named parameter sets of one exemplary tread rubber (Table 1 of the paper).

All constants with the dimension of stress are in N/mm^2. The names tell the model and the test
data behind the set: dumbbells (strains from -18 % to 40 %), bars of series 1 (to 150 %) and of
series 2 (to 300 %); "load" means that only loading paths were used.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", Table 1.
"""

from collections.abc import Mapping
from difflib import get_close_matches
from types import MappingProxyType

from materials.hyperelastic import Hyperelastic, MooneyRivlin, VanDerWaals, Yeoh

COMPOUNDS: Mapping[str, Hyperelastic] = MappingProxyType(
    {
        "mooney-rivlin-dumbbells": MooneyRivlin(C10=0.2580, C01=0.4587),
        "yeoh-bars-series-1": Yeoh(C10=0.3494, C20=-0.05272, C30=0.01295),
        "yeoh-bars-series-2": Yeoh(C10=0.3200, C20=-0.02000, C30=0.00190),
        "yeoh-bars-series-1-load": Yeoh(C10=0.3794, C20=0.02320, C30=-0.00030),
        "van-der-waals-bars-series-1": VanDerWaals(G=0.7500, lambda_m=3.5000, a=1.0000),
        "van-der-waals-bars-series-2": VanDerWaals(G=0.6000, lambda_m=4.9500, a=0.6800),
    }
)


def compound(name: str) -> Hyperelastic:
    """Hyperelastic model of a named compound of Table 1 [1]_.

    Examples
    --------
    >>> compound("yeoh-bars-series-2").initial_shear_modulus
    0.64
    """
    if name in COMPOUNDS:
        return COMPOUNDS[name]
    near = get_close_matches(str(name), COMPOUNDS, n=1)
    hint = f"; nearest is {near[0]!r}" if near else ""
    raise ValueError(f"compound is {name!r}; expected one of {', '.join(COMPOUNDS)}{hint}")
