"""Identification of the heat partition by resimulating sliding blocks."""

from calibration.partition.fit import MOST_SIMULATIONS, PartitionFit, fit_partition
from calibration.partition.simulation_store import (
    SIMULATIONS_FOLDER,
    SimulationStoppedError,
    SimulationStore,
)
