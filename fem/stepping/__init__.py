"""From the programme to accepted steps and their records, for soft and for rigid blocks."""

from typing import TYPE_CHECKING

from fem.files.faces import face

if TYPE_CHECKING:
    from fem.stepping.audit import EnergyAudit, audited
    from fem.stepping.cost import duration, estimated_cost, refuse_unaffordable
    from fem.stepping.coupled_step import (
        AcceptedStep,
        ContactLaws,
        CoupledModel,
        CoupledState,
        RejectedStep,
        SelfContact,
    )
    from fem.stepping.model_parts import Progress, mesh_described, mesh_of, sized
    from fem.stepping.point import Records, RunPoint, RunRecord, columns
    from fem.stepping.progress import RunProgress
    from fem.stepping.relaxation import RELAXED_ONSET, relaxed
    from fem.stepping.run import Run
    from fem.stepping.step_control import StepController, StepPlan, landed
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
