"""Reads an input deck back, independently of what wrote it."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Card:
    """A keyword with its parameters and data lines."""

    name: str
    parameters: dict[str, str]
    rows: list[list[str]]

    @property
    def numbers(self) -> list[list[float]]:
        return [[float(word) for word in row] for row in self.rows]


def read_deck(text: str) -> list[Card]:
    cards: list[Card] = []
    for line in text.splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            name, *words = (word.strip() for word in line[1:].split(","))
            pairs = dict((*word.split("="), "")[:2] for word in words)
            cards.append(Card(name=name, parameters=pairs, rows=[]))
        elif cards[-1].name != "HEADING":
            cards[-1].rows.append([word for word in re.split(r"[,\s]+", line) if word])
    return cards


def named(cards: list[Card], name: str, **parameters: str) -> Card:
    """The only card of a name with the given parameters."""
    wanted = parameters.items()
    found = [card for card in cards if card.name == name and wanted <= card.parameters.items()]
    assert len(found) == 1, f"{len(found)} cards *{name} with {parameters}"
    return found[0]


def nodes(cards: list[Card]) -> dict[int, np.ndarray]:
    rows = [row for card in cards if card.name == "NODE" for row in card.numbers]
    return {int(row[0]): np.array(row[1:]) for row in rows}


def node_set(cards: list[Card], name: str) -> list[int]:
    return [int(word) for row in named(cards, "NSET", NSET=name).rows for word in row]


#: Corners of the faces S1..S6 of an eight-node brick, as the manuals list them.
FACES = {
    "S1": (1, 2, 3, 4), "S2": (5, 8, 7, 6), "S3": (1, 5, 6, 2),
    "S4": (2, 6, 7, 3), "S5": (3, 7, 8, 4), "S6": (4, 8, 5, 1),
}  # fmt: skip
