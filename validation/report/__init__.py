"""One HTML page of everything that was computed, to be mailed."""

from validation.report.page import write_report
