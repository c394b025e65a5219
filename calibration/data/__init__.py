"""Measured tables: from bytes to checked rows, with an account of what became of each."""

from calibration.data.errors import DataError
from calibration.data.row_account import LeftOut, left_out
from calibration.data.tables import Table, read_table
