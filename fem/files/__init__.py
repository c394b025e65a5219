"""Files, streams and signals: what a run has to do with the machine, and nothing of physics."""

from typing import TYPE_CHECKING

from fem.files.faces import face

if TYPE_CHECKING:
    from fem.files.atomic import (
        remove_remains,
        replacing,
        staged_directory,
        write_table,
        write_text,
    )
    from fem.files.faces import face
    from fem.files.interruption import at_step_ends, gently, listening, requested
    from fem.files.machine_faults import OUT_OF_MEMORY, cause, one_line
    from fem.files.messages import BAD_INPUT, DONE, INTERRUPTED, NOT_CONVERGED, WARNED, say_of, warn
    from fem.files.packing import PackingError, pack, unpack
    from fem.files.terminal import lenient_streams, open_standard_descriptors
    from fem.files.version import ROOT, fingerprint, program_version, version_of
else:
    __getattr__ = face(__name__, __file__)
