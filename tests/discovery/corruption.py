"""One wrong number in a table, as a typist makes it: swapped digits, or a tenth off."""

import numpy as np

from hidden_signal import NOISE

NOTICEABLE = (0.04, 0.2)  # relative change by swapped digits: more would be refused as absurd


def swapped_digits(text: str) -> str | None:
    """The number with two neighbouring digits swapped, where that changes it noticeably."""
    digits = [place for place, character in enumerate(text) if character.isdigit()]
    for first, second in zip(digits, digits[1:]):
        characters = list(text)
        characters[first], characters[second] = text[second], text[first]
        other = "".join(characters)
        change = abs(float(other) / float(text) - 1)
        if NOTICEABLE[0] <= change <= NOTICEABLE[1]:
            return other
    return None


def corrupted(rows: list[dict], random: np.random.Generator) -> tuple[list[dict], dict]:
    """The rows with one size of one fitted shot wrong, and which."""
    fitted = [index for index, row in enumerate(rows) if row["use"] == "calibrate"]
    index = int(random.choice(fitted))
    size = str(random.choice(list(NOISE)))
    right = rows[index][size]
    # Lengths shrink and diameters grow: the other way many would be refused as impossible.
    factor = 0.9 if "length" in size else 1.1
    wrong, how = f"{factor * float(right):.4f}", "a tenth off"
    swapped = swapped_digits(right) if random.random() < 0.5 else None
    if swapped and (float(swapped) < float(right)) == (factor < 1):
        wrong, how = swapped, "swapped digits"
    changed = [dict(row) for row in rows]
    changed[index][size] = wrong
    told = {"id": rows[index]["id"], "size": size, "right": right, "wrong": wrong, "how": how}
    return changed, told
