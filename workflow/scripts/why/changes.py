"""What changed since the results were made: settings and rows of the table."""

from pathlib import Path

from json_file import read_json
from new_rows.repeats import INPUTS


def settings_changes(before, after, key: str = "") -> list[str]:
    """`epochs 60 -> 61` for each value that differs; lists of named things go by the names."""
    before, after = _by_name(before), _by_name(after)
    if isinstance(before, dict) and isinstance(after, dict):
        found = []
        for name in dict.fromkeys([*before, *after]):
            inner = f"{key}.{name}" if key else str(name)
            if name not in before:
                found.append(f"{inner} is new")
            elif name not in after:
                found.append(f"{inner} is gone")
            else:
                found += settings_changes(before[name], after[name], inner)
        return found
    return [] if before == after else [f"{key} {before} -> {after}"]


def _by_name(value):
    if isinstance(value, list) and value and all(isinstance(v, dict) for v in value):
        return {entry.get("name", place): entry for place, entry in enumerate(value)}
    return value


def narrowed_ranges(before: dict, after: dict) -> dict[str, list]:
    """Ranges of the parameters' runs that would do though `after` asks for narrower ones."""
    return {
        name: [old["lower"], old["upper"]]
        for name, old in before.items()
        if name in after
        and (after[name]["lower"], after[name]["upper"]) != (old["lower"], old["upper"])
        and old["lower"] <= after[name]["lower"] < after[name]["upper"] <= old["upper"]
    }


def table_changes(rows: list[dict], comparison: Path, sizes: list[str]) -> list[str]:
    """How the shots in use differ from those last compared: new, gone, or other numbers."""
    if not comparison.exists():
        return []
    compared = {shot["id"]: shot for shot in read_json(comparison)["shots"]}
    measured_as = [size for size in sizes if not size.startswith("outline_pc_")]
    in_use = {
        row["id"]: row
        for row in rows
        if row["use"] != "ignore" and (row["outline"] or any(size in row for size in sizes))
    }
    found = [
        f"new shot {name} (line {row['line']})"
        for name, row in in_use.items()
        if name not in compared
    ]
    found += [f"shot {name} is gone or left out" for name in compared if name not in in_use]
    for name, row in in_use.items():
        differences = _differences(row, compared[name], measured_as) if name in compared else []
        if differences:
            found.append(f"shot {name} (line {row['line']}): {', '.join(differences)}")
    return found


def _differences(row: dict, shot: dict, sizes: list[str]) -> list[str]:
    before = {key: shot[key] for key in ("lot", "use", *INPUTS) if key in shot}
    for size in shot["sizes"]:
        before |= {size["size"]: size["measured"], f"{size['size']}_sd": size["sd"]}
    found = [
        f"{key} {old} -> {row.get(key, 'empty')}"
        for key, old in before.items()
        if not key.startswith("outline_pc_") and row.get(key) != old
    ]
    # An outline takes the place of the sizes that are read off it.
    found += [size for size in sizes if size in row and size not in before and not row["outline"]]
    return found
