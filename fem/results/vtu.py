"""An export of the fields for ParaView: VTU by meshio, collected over time in a `.pvd`.

Nothing in this program reads it back.
Cell order of VTK's symmetric tensors is XX, YY, ZZ, XY, YZ, XZ.
"""

from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np

from fem.results.snapshot import BlockGeometry, Snapshot
from materials.arrays import AnyArray, FloatArray

DISPLACEMENT = "displacement_mm"
TEMPERATURE = "temperature_C"
STRESS = "cauchy_stress_N_per_mm2"
STRESS_COMPONENTS = (
    "sigma_x_N_per_mm2",
    "sigma_y_N_per_mm2",
    "sigma_z_N_per_mm2",
    "sigma_xy_N_per_mm2",
)
STRETCH = "largest_principal_stretch"
PRESSURE = "volumetric_stress_N_per_mm2"
SOFTENING = "softening"
VISCOUS_DISSIPATION = "viscous_dissipation_mJ_per_mm3"
TIME = "time_s"
DISTANCE = "sliding_distance_mm"

#: Position of xx, yy, zz, xy in VTK's order.
_VTK_POSITION = (0, 1, 2, 3)


def write_vtu(
    directory: str | Path, geometry: BlockGeometry, snapshots: Sequence[Snapshot]
) -> None:
    """Write `block_*.vtu`, `road_*.vtu`, `block.pvd` and `road.pvd` into an existing folder.

    Block points are the reference coordinates (warp by `displacement_mm` to see the deformed
    block); road points are in the platen's frame, so that both fit together.
    """
    directory = Path(directory)
    times = [snapshot.time_s for snapshot in snapshots]
    for number, snapshot in enumerate(snapshots):
        snapshot.check(geometry)
        _write(directory / _name("block", number), _block_mesh(geometry, snapshot))
        _write(directory / _name("road", number), _road_mesh(snapshot))
    for part in ("block", "road"):
        _write_collection(directory / f"{part}.pvd", part, times)


def _name(part: str, number: int) -> str:
    return f"{part}_{number:04d}.vtu"


def _three_dimensional(plane: FloatArray) -> FloatArray:
    return np.column_stack([plane, np.zeros(len(plane))])


def _block_mesh(geometry: BlockGeometry, snapshot: Snapshot) -> meshio.Mesh:
    stress = snapshot.cauchy_stress
    tensor = np.zeros((len(stress), 6))
    tensor[:, _VTK_POSITION] = stress
    components = {name: stress[:, i] for i, name in enumerate(STRESS_COMPONENTS)}
    memory = {SOFTENING: snapshot.softening, VISCOUS_DISSIPATION: snapshot.viscous_dissipation}
    remembered = {name: values for name, values in memory.items() if values is not None}
    return _mesh(
        geometry.points,
        geometry.cells,
        {
            DISPLACEMENT: _three_dimensional(snapshot.displacement),
            TEMPERATURE: snapshot.temperature,
        },
        {STRESS: tensor, **components, STRETCH: snapshot.stretch, PRESSURE: snapshot.pressure}
        | remembered,
        {TIME: snapshot.time_s, DISTANCE: snapshot.sliding_distance_mm},
    )


def _road_mesh(snapshot: Snapshot) -> meshio.Mesh:
    return _mesh(
        snapshot.road_points,
        snapshot.road_cells,
        {TEMPERATURE: snapshot.road_temperature},
        {},
        {TIME: snapshot.time_s, DISTANCE: snapshot.sliding_distance_mm},
    )


def _mesh(
    points: FloatArray,
    cells: AnyArray,
    point_data: dict[str, FloatArray],
    cell_data: dict[str, FloatArray],
    constants: dict[str, float],
) -> meshio.Mesh:
    """Build a meshio mesh; constants become cell data, which every VTU reader understands."""
    per_cell = {name: np.full(len(cells), value) for name, value in constants.items()}
    return meshio.Mesh(
        _three_dimensional(points),
        [("quad", np.asarray(cells, dtype=np.int64))],
        point_data=point_data,
        cell_data={name: [values] for name, values in {**cell_data, **per_cell}.items()},
    )


def _write(path: Path, mesh: meshio.Mesh) -> None:
    mesh.write(path, file_format="vtu")


def _write_collection(path: Path, part: str, times: Sequence[float]) -> None:
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for number, time in enumerate(times):
        ElementTree.SubElement(
            collection,
            "DataSet",
            timestep=repr(float(time)),
            group="",
            part="0",
            file=_name(part, number),
        )
    ElementTree.indent(root)
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
