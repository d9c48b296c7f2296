"""Reads and checks a table of measured shots; messages name the file, line and column."""

from pathlib import Path

from input_errors import InputError
from new_rows.repeats import repeats_within
from schema_check import fill_defaults, findings, load_schema
from shape_names import shape_problem
from shot_inputs import SHOT_INPUTS
from size_kinds import OUTLINE_SCORES
from study import database_parts
from table_cells import number_in, read_cells

FAR_OFF = 5  # standard errors from which a size is a slip of the pen
SHORTEST = 0.1  # of the initial length: less is in another unit
SMALLEST_SD, LARGEST_SD = 1e-6, 0.5  # shares of what is measured


def read_measurements(path: Path) -> list[dict]:
    """The rows with numbers as floats, empty cells left out and `line` added."""
    header, records = read_cells(path, "one row a shot")
    rows = checked_rows(path, header, records)
    problems = [f"{path}, {problem}" for problem in repeats_within(rows)]
    if problems:
        raise InputError("\n".join(problems))
    return rows


def checked_rows(path: Path, header: list[str], records: list[tuple[int, list[str]]]) -> list[dict]:
    """The same of cells that were read from `path` already, as `read_cells` gives them."""
    schema = load_schema("measurements")
    if not set(header) & set(schema["properties"]):
        raise InputError(
            f"{path}, line 1: {', '.join(header[:4])} ... names no column (expected a header: "
            f"{', '.join(schema['required'])}, and sizes). Write it above the rows."
        )
    if "" in header:
        raise InputError(f"{path}, line 1: a column has no name. Name it or drop it.")
    problems = [
        f"{path}, line 1: column {key[0]} {text}"
        for key, text in findings({name: None for name in header}, _header_schema(schema))
    ]
    if problems:
        raise InputError("\n".join(dict.fromkeys(problems)))
    rows, first_line = [], {}
    for line, cells in records:
        row, wrong = _typed(dict(zip(header, cells, strict=True)), schema)
        wrong += [(key[0], text) for key, text in findings(row, schema)]
        wrong += _impossible(row) if not wrong else []
        if row.get("id") in first_line:
            wrong.append(("id", f"= {row['id']!r} is already in line {first_line[row['id']]}."))
        first_line.setdefault(row.get("id"), line)
        problems += [f"{path}, line {line}: {column} {text}" for column, text in wrong]
        rows.append({**fill_defaults(row, schema, schema), "line": line})
    if problems:
        raise InputError("\n".join(dict.fromkeys(problems)))
    if not rows:
        raise InputError(f"{path}: the table has no rows (expected one for each shot).")
    return rows


def check_against_study(rows: list[dict], study: dict, path: Path) -> None:
    """The rows that are used must lie where the database will have runs."""
    problems = []
    for row in rows:
        place = f"{path}, line {row['line']}: {row['id']}:"
        problems += [f"{place} {problem}" for problem in beyond_database(row, study)]
    fitted = [row for row in rows if row["use"] == "calibrate"]
    if not fitted:
        problems.append(f"{path}: no row has `use` = calibrate (expected at least one).")
    for size in study["calibration"]["fit_sizes"]:
        measured_as = "outline" if size in OUTLINE_SCORES else size
        if fitted and not any(row.get(measured_as, "") != "" for row in fitted):
            problems.append(
                f"{path}: no fitted row has {measured_as!r}. Drop {size} from fit_sizes."
            )
    if problems:
        raise InputError("\n".join(problems))


def beyond_database(row: dict, study: dict) -> list[str]:
    """What of a row in use lies where the database will have no runs, and the remedy."""
    if row["use"] == "ignore":
        return []
    problems = [_beyond_part(row, part) for part in database_parts(study)]
    return [] if [] in problems else problems[0]


def _beyond_part(row: dict, part: dict) -> list[str]:
    found = []
    if row["shape"] not in part["shapes"]:
        found.append(
            f"shape {row['shape']!r} is not in database.shapes. Add runs of it to database.further."
        )
    values = {**row, "length_to_diameter": row["initial_length_mm"] / row["initial_diameter_mm"]}
    for key in SHOT_INPUTS:
        lowest, highest = part[key]
        slack = 1e-9 * highest
        if not lowest - slack <= values[key] <= highest + slack:
            found.append(
                f"{key} = {values[key]:g} is outside the database ({lowest:g} to {highest:g}). Add "
                f"runs there to database.further, widen database.{key}, or set `use` to ignore."
            )
    return found


def _header_schema(schema: dict) -> dict:
    """The names alone: which columns may and which must be there."""
    names = {name: {} for name in schema["properties"]}
    keys = ("required", "dependentRequired")
    rules = {key: schema[key] for key in keys}
    return {"type": "object", "properties": names, "additionalProperties": False, **rules}


def _typed(cells: dict[str, str], schema: dict) -> tuple[dict, list[tuple[str, str]]]:
    row, wrong = {}, []
    for column, cell in cells.items():
        if not cell:
            continue
        if schema["properties"][column].get("type") != "number":
            row[column] = cell
            continue
        row[column] = number_in(cell)
        if row[column] is None:
            unit = schema["properties"][column]["unit"]
            wrong.append((column, f"= {cell!r} (expected a number in {unit}, as 12.5)."))
    return row, wrong


def _impossible(row: dict) -> list[tuple[str, str]]:
    """Sizes that no impact can give, more than any error of measurement can explain."""
    found = []
    length, diameter = row["initial_length_mm"], row["initial_diameter_mm"]
    for name in ("final_length_mm", "undeformed_length_mm", "head_length_mm", "rear_length_mm"):
        if name in row and row[name] > length + FAR_OFF * row[f"{name}_sd"]:
            found.append((name, f"= {row[name]:g} is more than initial_length_mm = {length:g}."))
    if row.get("final_length_mm", length) < SHORTEST * length:
        problem = f"is less than {SHORTEST:g} of initial_length_mm = {length:g}. Is it in mm?"
        found.append(("final_length_mm", f"= {row['final_length_mm']:g} {problem}"))
    name = "impact_diameter_mm"
    if row["shape"] == "uniform_cylinder" and name in row:
        if row[name] < diameter - FAR_OFF * row[f"{name}_sd"]:
            found.append(
                (name, f"= {row[name]:g} is less than initial_diameter_mm = {diameter:g}.")
            )
    problem = shape_problem(row["shape"])
    found += [("shape", f"= {row['shape']!r}: {problem}")] if problem else []
    return found + _impossible_errors(row)


def _impossible_errors(row: dict) -> list[tuple[str, str]]:
    """Standard errors that are in another unit, or in percent."""
    found = []
    measured_as = {name: name.replace("_sd", "") for name in row if "_sd" in name}
    for name, measured in measured_as.items():
        # The part that kept its diameter may have any length from 0.
        of = "initial_length_mm" if measured == "undeformed_length_mm" else measured
        lowest, highest = SMALLEST_SD * row.get(of, 0), LARGEST_SD * row.get(of, row[name] * 2)
        if not lowest <= row[name] <= highest:
            problem = f"(expected {lowest:.2g} to {highest:.4g}, shares of {of} = {row[of]:g})."
            found.append((name, f"= {row[name]:g} {problem} Is it in percent, or another unit?"))
    return found
