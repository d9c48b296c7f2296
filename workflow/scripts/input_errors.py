"""Errors about what a user gave, worded with the place and the remedy."""

import difflib


class InputError(Exception):
    """A study or table that cannot be used; the text is shown without a traceback."""


def did_you_mean(word: str, known: list[str]) -> str:
    """A hint with the nearest known word, or the known words when none is near."""
    near = difflib.get_close_matches(str(word), known, n=1, cutoff=0.6)
    if near:
        return f"Did you mean {near[0]!r}?"
    return f"Known here: {', '.join(sorted(known))}."
