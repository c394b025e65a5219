"""What a mechanics tells of a step beside its state: energies, invariants and fields."""

from dataclasses import dataclass

from materials.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class StepEnergies:
    """Energies of a step, per depth [mJ/mm].

    Attributes
    ----------
    strain_energy, kinetic : float
        Stored at its end.
    viscous, rubber, damage : float
        What the damping and the rubber's viscosity dissipated in it, and what its damage consumed.
    """

    strain_energy: float = 0.0
    kinetic: float = 0.0
    viscous: float = 0.0
    rubber: float = 0.0
    damage: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Strains:
    """Deformation at the Gauss points: invariants I1 and J [-], and areas [mm^2]."""

    I1: FloatArray
    J: FloatArray
    weights: FloatArray


@dataclass(frozen=True, kw_only=True)
class CellFields:
    """Fields of the cells.

    Attributes
    ----------
    cauchy : (ne, 4) float array
        Cauchy stress xx, yy, zz, xy [N/mm^2].
    stretch : (ne,) float array
        Largest stretch in the plane [-].
    softening : (ne,) float array or None
        Factor of the elastic stress of rubber with damage [-].
    """

    cauchy: FloatArray
    stretch: FloatArray
    softening: FloatArray | None = None
