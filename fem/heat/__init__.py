"""Heat in the block and the road, exchanged between them and radiated."""

from typing import TYPE_CHECKING

from fem.files import face

if TYPE_CHECKING:
    from fem.heat.layer_resolution import layer_error
    from fem.heat.model import HeatModel
    from fem.heat.state import HeatLoad, HeatState
else:
    __getattr__ = face(__name__, __file__)
