"""Finds shots that a table has already: typed twice, or fired twice."""

from schema_check import load_schema

INPUTS = ("shape", "initial_temperature_K", "velocity_m_s")
INPUTS += ("initial_diameter_mm", "initial_length_mm")


def repeats(row: dict, others: list[tuple[dict, str]]) -> tuple[list[str], list[str]]:
    """What is wrong with `row` beside the others, and what is worth a remark.

    `others`: a shot and the place where it stands, such as "line 3 of measurements.csv".
    """
    wrong, remarks = [], []
    sizes = size_names()
    for other, place in others:
        known = f"{other['id']} ({place})"
        if row["id"] == other["id"]:
            wrong.append(f"id {row['id']!r} is already in {place}. Give the shot another name.")
        elif not _equal(row, other, INPUTS):
            continue
        elif _equal(row, other, sizes):
            wrong.append(f"is the same shot as {known}: all inputs and sizes are equal. Drop it.")
        else:
            remarks.append(f"has the same inputs as {known}, and other sizes: a repeated shot")
    return wrong, remarks


def repeats_within(rows: list[dict]) -> list[str]:
    """The shots in use that a table has twice, under two names: each would count twice."""
    found, seen = [], {}
    sizes = size_names()
    for row in rows:
        if row["use"] == "ignore" or not any(row.get(name) for name in sizes):
            continue
        key = tuple(row.get(name) for name in (*INPUTS, *sizes))
        if key in seen:
            found.append(
                f"line {row['line']}: {row['id']} is the same shot as {seen[key]}: all inputs and "
                "sizes are equal. Drop it, or set `use` to ignore."
            )
        seen.setdefault(key, f"{row['id']} (line {row['line']})")
    return found


def size_names() -> list[str]:
    """The columns of measured sizes, and that of the outline."""
    paired = load_schema("measurements")["dependentRequired"]
    return [name for name in paired if not name.endswith("_sd")] + ["outline"]


def _equal(row: dict, other: dict, names) -> bool:
    return all(row.get(name) == other.get(name) for name in names)
