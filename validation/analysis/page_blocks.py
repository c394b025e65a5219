"""Parts of the pages in `docs` that a command writes: a block between two markers, tables."""

import re
from collections.abc import Iterable

#: Of the block of a name.
_BEGIN, _END = "<!-- {}:begin -->", "<!-- {}:end -->"


def with_block(page: str, name: str, text: str) -> str:
    """The page with another text between the markers of a block.

    Parameters
    ----------
    page : str
        Text of the page.
    name : str
        Of the block.
    text : str
        Lines, the last one ended.

    Raises
    ------
    ValueError
        If the markers are not there once.

    Examples
    --------
    >>> page = "<!-- a:begin -->\\nold\\n<!-- a:end -->\\n"
    >>> with_block(page, "a", "new\\n") == page.replace("old", "new")
    True
    """
    begin, end = _BEGIN.format(name), _END.format(name)
    parts = re.split(f"({begin}\n|{end})", page)
    if len(parts) != 5:
        raise ValueError(f"the page has to have {begin} and {end} once each")
    return "".join([*parts[:2], text, *parts[3:]])


def markdown_table(columns: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Table of Markdown."""
    names = list(columns)
    lines = [names, ["---" for _ in names], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
