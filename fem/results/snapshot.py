"""The fields of one accepted state, as they are written to files and drawn."""

from dataclasses import dataclass, fields

import numpy as np

from materials.arrays import FloatArray, IntArray


@dataclass(frozen=True, kw_only=True)
class BlockGeometry:
    """Reference mesh of the block.

    Attributes
    ----------
    points : (n, 2) float array
        Reference coordinates [mm].
    cells : (ne, 4) int array
        Counter-clockwise corner nodes.
    """

    points: FloatArray
    cells: IntArray


@dataclass(frozen=True, kw_only=True)
class Snapshot:
    """Block and road at one accepted step.

    Attributes
    ----------
    time_s, sliding_distance_mm : float
        Time since the start and displacement of the platen while sliding.
    displacement : (n, 2) float array
        Displacement of the block's nodes in the platen's frame [mm].
    temperature : (n,) float array
        Block temperature [deg C].
    cauchy_stress : (ne, 4) float array
        sigma_xx, sigma_yy, sigma_zz, sigma_xy, mean of each element [N/mm^2].
    stretch : (ne,) float array
        Largest principal stretch in the plane, mean of each element [-].
    pressure : (ne,) float array
        Volumetric stress dU/dJ of each element, positive in tension [N/mm^2].
    softening : (ne,) float array or None
        Factor of the elastic stress of softening rubber, mean of each element [-].
    viscous_dissipation : (ne,) float array or None
        Energy that the branches of viscoelastic rubber dissipated since the start, mean of each
        element per reference volume [mJ/mm^3].
    road_points : (nr, 2) float array
        Road nodes in the platen's frame [mm].
    road_cells : (ner, 4) int array
        Corner nodes of the road's cells.
    road_temperature : (nr,) float array
        Road temperature [deg C].
    """

    time_s: float
    sliding_distance_mm: float
    displacement: FloatArray
    temperature: FloatArray
    cauchy_stress: FloatArray
    stretch: FloatArray
    pressure: FloatArray
    road_points: FloatArray
    road_cells: IntArray
    road_temperature: FloatArray
    softening: FloatArray | None = None
    viscous_dissipation: FloatArray | None = None

    def check(self, geometry: BlockGeometry) -> None:
        """Raise ValueError unless every field has the length of the mesh it belongs to."""
        nodes, elements = len(geometry.points), len(geometry.cells)
        expected = {
            "displacement": (nodes, 2),
            "temperature": (nodes,),
            "cauchy_stress": (elements, 4),
            "stretch": (elements,),
            "pressure": (elements,),
            "road_temperature": (len(self.road_points),),
            "softening": (elements,),
            "viscous_dissipation": (elements,),
        }
        for name, shape in expected.items():
            found = getattr(getattr(self, name), "shape", None)
            if found not in (shape, None):
                raise ValueError(f"snapshot field {name} has shape {found}, expected {shape}")

    def __eq__(self, other: object) -> bool:
        """Compare all fields value by value."""
        return isinstance(other, Snapshot) and all(
            np.array_equal(getattr(self, f.name), getattr(other, f.name)) for f in fields(self)
        )

    __hash__ = None  # type: ignore[assignment]
