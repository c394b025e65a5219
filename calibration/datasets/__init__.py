"""Published stress-stretch tests of real rubbers, with their papers named in the files."""

from pathlib import Path

#: Name, and what the data are.
DATASETS: dict[str, str] = {
    "treloar1944": "natural rubber, unfilled (Treloar 1944)",
    "kawabata1981": "isoprene rubber, unfilled (Kawabata et al. 1981)",
    "meunier2008": "silicone rubber, unfilled (Meunier et al. 2008)",
}


def dataset_path(name: str) -> Path:
    """Path of the CSV file of a named data set."""
    if name not in DATASETS:
        raise ValueError(f"data set is {name!r}; expected one of {', '.join(DATASETS)}")
    return Path(__file__).parent / f"{name}.csv"
