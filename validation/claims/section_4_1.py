"""Numbers behind the claim of section 4.1: what a plane model leaves out."""

import pandas as pd

from validation.analysis import SIMILAR
from validation.claims.claim import Numbers
from validation.claims.evidence import Evidence

#: Depth over height of the slab that is judged: "a large extension" without a number.
LARGE = 5.0


#: What of a slab is compared with plane strain, and what it is there.
PLANE = {
    "force_at_2_mm": 1.0,
    "middle_platen_at_equal_load": 1.0,
    "depth_strain_share_pressed": 0.0,
    "depth_strain_share_slid": 0.0,
}


def middle_is_in_plane_strain(evidence: Evidence) -> Numbers:
    slabs = evidence.slabs.set_index("depth_over_height")
    off = (slabs[list(PLANE)] - pd.Series(PLANE)).abs()
    enough = (off <= SIMILAR).all(axis=1)
    return {f"{key}_off": float(off[key][LARGE]) for key in PLANE}, {
        "middle": slabs["middle_platen_at_equal_load"].sub(1.0).rename("{:g}".format).to_dict(),
        "platen": slabs["platen_pressed"].sub(1.0).rename("{:g}".format).to_dict(),
        "strain": slabs["depth_strain_share_slid"].rename("{:g}".format).to_dict(),
        "enough": f"from {enough.idxmax():g} on" if enough.any() else "at none of these depths",
    }
