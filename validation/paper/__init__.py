"""The paper's figures and tables."""

from validation.paper.figures import FIGURES, MEASURABLE, make_figure
from validation.paper.introductory import introductory_case, introductory_run
from validation.paper.tables import TABLES, make_table
from validation.paper.up_to_date import kept
