"""What looks at every accepted step, each thing in its own file, in the order of `RunObservers`."""

from fem.stepping.observers.bottom import BottomRecorder
from fem.stepping.observers.fields import SnapshotTaker
from fem.stepping.observers.history import HistoryRecorder
from fem.stepping.observers.pyrometer import PyrometerReader
from fem.stepping.observers.wear import WearRecorder
