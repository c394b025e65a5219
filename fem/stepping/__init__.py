"""From the programme to accepted steps and their records, for soft and for rigid blocks."""

from typing import TYPE_CHECKING

from fem.files import face

if TYPE_CHECKING:
    from fem.stepping.cost import duration, estimated_cost, refuse_unaffordable
    from fem.stepping.coupled_state import CoupledState
    from fem.stepping.coupled_step import ContactLaws, CoupledModel
    from fem.stepping.model_parts import Progress, mesh_described, mesh_of, sized
    from fem.stepping.per_block import block_summaries
    from fem.stepping.point import RunRecord
    from fem.stepping.progress import RunProgress
    from fem.stepping.run import Run
    from fem.stepping.self_contact import SelfContact
    from fem.stepping.summary import (
        closing_lines,
        heat_error,
        lag_share,
        largest,
        last_values,
        layer_errors,
        sliding_means,
        steady_shares,
    )
else:
    __getattr__ = face(__name__, __file__)
