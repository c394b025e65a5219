"""What a run leaves: tables, fields, checkpoints, how it ended, how far it can be trusted."""

from typing import TYPE_CHECKING

from fem.files import face

if TYPE_CHECKING:
    from fem.results.bottom_history import BOTTOM_FILE, BottomHistory
    from fem.results.boundary import BoundaryContact, boundary_table
    from fem.results.checkpoint import CHECKPOINT_FILE, Checkpoint, CheckpointError, notes
    from fem.results.columns import HISTORY, SUMMARY, SURFACE
    from fem.results.contacts import contacts_table
    from fem.results.fitted_window import (
        contact_columns,
        rubber_columns,
        window_notes,
        window_warnings,
    )
    from fem.results.outcome import INTERRUPTED, OK, Outcome, failed, stoppable
    from fem.results.output import check_output_file, chosen_output, output_folder
    from fem.results.pyrometer import PYROMETER, PYROMETER_FILE, pyrometer_table
    from fem.results.regime import sliding_regime
    from fem.results.result import (
        CASE_FILE,
        FIGURES_FOLDER,
        HISTORY_FILE,
        RUN_FILES,
        SUMMARY_CSV,
        SUMMARY_JSON,
        SURFACE_FILE,
        Result,
        joined,
        read_summary,
        read_table,
    )
    from fem.results.run_folder import FINAL, RunFolder
    from fem.results.snapshot import BlockGeometry, Snapshot
    from fem.results.surface_profile import EDGE_ZONE, excess_area, interior_peak
    from fem.results.trust import LIMITS, judged
else:
    __getattr__ = face(__name__, __file__)
