"""The mesh of the block and the node sets of its boundary."""

from typing import TYPE_CHECKING

from fem.files import face

if TYPE_CHECKING:
    from fem.mesh.block import BlockMesh, block_mesh
    from fem.mesh.file import MeshFileError, read_mesh
    from fem.mesh.grading import NAMED_GRADINGS, Grading
    from fem.mesh.tread import Slot, TreadShape, quality, shape_of_blocks, tread_mesh
else:
    __getattr__ = face(__name__, __file__)
