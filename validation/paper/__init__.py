"""The paper's figures and tables."""

from validation.paper.figures import FIGURES, MEASURABLE, TABLES, make_figure, make_table
from validation.paper.introductory import introductory_case, introductory_run
from validation.paper.up_to_date import kept
