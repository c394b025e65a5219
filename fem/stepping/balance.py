"""Error of a balance, for energy and for heat."""


def balance_error(put_in: float, *found: float, created: float = 0.0) -> float:
    """What a balance misses, and what was made of nothing, over what was turned over [-].

    Parameters
    ----------
    put_in : float
        What was put in, of either sign.
    found : float
        Parts in which it was found again.
    created : float, optional
        What must be counted as missing even though the balance has it.

    Returns
    -------
    float
        0 where nothing was put in and nothing found; 1 where one of them is without the other.
    """
    turnover = max(abs(put_in), sum(map(abs, found)))
    return (abs(put_in - sum(found)) + created) / turnover if turnover > 0.0 else 0.0


def share(part: float, whole: float) -> float:
    """Part over the size of the whole [-], which may be negative; 1 for something of nothing."""
    if whole == 0.0:
        return 1.0 if part != 0.0 else 0.0
    return part / abs(whole)
