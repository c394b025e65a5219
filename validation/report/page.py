"""Everything the page shows, and the page as HTML."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from fem.files import write_text
from validation.report import captions
from validation.report.cells import is_number
from validation.report.introductory_part import IntroductoryRun, find_introductory
from validation.report.made_with import MadeWith, made_with, programs_of_runs
from validation.report.parts import Part, find_part
from validation.sensitivity import PARAMETERS, Parameter, first_key
from validation.studies import STUDIES

TEMPLATE = "report.html"
#: The robustness study's table, which is kept with the sources.
ROBUSTNESS = STUDIES.parent / "robustness.csv"


@dataclass(frozen=True, kw_only=True)
class Page:
    """What stands on the page, top to bottom."""

    run: IntroductoryRun | None
    claims: Part
    figures: list[Part]
    tables: list[Part]
    sensitivity: Part
    robustness: Part
    made_with: MadeWith
    programs: list[tuple[str, int]]
    not_computed: str = captions.NOT_COMPUTED

    @property
    def missing(self) -> list[tuple[str, str]]:
        """Titles and commands of the parts that are not there."""
        parts = [self.claims, *self.figures, *self.tables, self.sensitivity, self.robustness]
        absent = [(part.title, part.command) for part in parts if part.missing]
        return ([] if self.run else [("Introductory example", "make run")]) + absent

    @property
    def verdicts(self) -> list[tuple[str, int]]:
        """How many of the paper's claims got which verdict, the most frequent first."""
        return Counter(v for t in self.claims.tables for v in t.column("verdict")).most_common()

    @property
    def outcomes(self) -> list[tuple[str, int]]:
        """How many cases of the robustness study ended how, the most frequent first."""
        return Counter(s for t in self.robustness.tables for s in t.column("status")).most_common()

    @property
    def reasons(self) -> list[Parameter]:
        """What the sensitivity study varies, in the order of its table."""
        keys = [key for table in self.sensitivity.tables for key in table.column("parameter")]
        first = dict.fromkeys(first_key(key) for key in keys)
        return [PARAMETERS[key] for key in first if key in PARAMETERS]


def find_page(directory: Path, made_with: MadeWith) -> Page:
    """Collect what lies in a folder of figures."""
    return Page(
        run=find_introductory(directory, made_with.program),
        claims=find_part(directory, "claims", "The paper's claims"),
        figures=[
            find_part(directory, f"fig{number}", f"Figure {number}", caption)
            for number, caption in captions.FIGURES.items()
        ],
        tables=[
            find_part(directory, f"table{number}", f"Table {number}", caption)
            for number, caption in captions.TABLES.items()
        ],
        sensitivity=find_part(directory, "sensitivity", "Sensitivity", captions.SENSITIVITY),
        robustness=find_part(ROBUSTNESS.parent, "robustness", "Robustness", captions.ROBUSTNESS),
        made_with=made_with,
        programs=programs_of_runs(directory),
    )


def render(page: Page) -> str:
    """Turn the page into one HTML text that needs no other file, script or network."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.tests["number"] = is_number
    environment.filters["tone"] = tone
    return environment.get_template(TEMPLATE).render(page=page)


#: Words of a verdict or status to the colour it is shown in.
TONES = dict.fromkeys(("ok", "holds"), "good")
TONES |= dict.fromkeys(("differs", "not converged", "failed"), "bad")


def tone(word: str) -> str:
    """Colour of a verdict or a status: "good", "bad", or "open" for what is neither."""
    return TONES.get(word.strip().lower(), "open")


def write_report(directory: Path, path: Path) -> Path:
    """Write everything that lies in a folder of figures into one HTML file.

    Parameters
    ----------
    directory : Path
        Folder of figures, tables, claims and sensitivity; the introductory run is looked for
        inside it and beside it. What is missing is named on the page with what makes it.
    path : Path
        The file; it is replaced only when the new one is complete.

    Returns
    -------
    Path
        The file.
    """
    write_text(path, render(find_page(Path(directory), made_with())))
    return Path(path)
