"""Looks at new shots before they join a study's table: repeats, ranges, and the model."""

from dataclasses import dataclass, field
from pathlib import Path

from input_errors import InputError
from measurements import beyond_database, checked_rows, read_measurements
from new_rows.append import arranged
from new_rows.model import Prediction, beyond_network, is_calibrated, predictions
from new_rows.pasted import read_pasted
from new_rows.repeats import repeats
from outlines.table import check_outlines
from revisions import homes_of
from study import EXPERIMENTS, load_study, uses_outlines

STRANGE = 5  # standard errors from which a size gets a warning
IMPOSSIBLE = 10  # and from which it is refused


@dataclass
class NewShot:
    """A row, what stands against it, what is to be said of it, and what the model says.
    `inside`: whether it lies within the database, which a shot left out need not.
    """

    row: dict
    wrong: list[str]
    remarks: list[str]
    inside: bool
    prediction: Prediction | None = None
    outliers: list[str] = field(default_factory=list)


@dataclass
class Addition:
    """New rows of `source` for `table`: `cells` in the order of its columns. `home`: results
    that predictions come from, None if there are none; `no_model` says why.
    """

    source: Path
    table: Path
    cells: list[list[str]]
    shots: list[NewShot]
    home: Path | None
    no_model: str = ""

    def refusals(self, accept_outliers: bool) -> list[str]:
        found = []
        for shot in self.shots:
            place = f"{self.source}, line {shot.row['line']}: {shot.row['id']}:"
            problems = shot.wrong + ([] if accept_outliers else shot.outliers)
            found += [f"{place} {problem}" for problem in problems]
        return found


def examine(name: str, source: Path) -> Addition:
    """Reads and judges the rows; InputError for what no table may hold."""
    study = load_study(name)
    table = EXPERIMENTS / name / study["measurements"]
    present = read_measurements(table)
    header, records = read_pasted(source)
    rows = checked_rows(source, header, records)
    texts = [dict(zip(header, cells, strict=True)) for _, cells in records]
    others = [(row, f"line {row['line']} of {table.name}") for row in present]
    shots = []
    for row in rows:
        wrong, remarks = repeats(row, others)
        inside = not beyond_database({**row, "use": "validate"}, study)
        beyond = beyond_database(row, study)
        if beyond:
            runs = study["database"]["runs"]
            remarks.append(
                "runs in `database.further` are computed beside those that are there; a wider "
                f"database is computed anew: {runs} runs of the solver"
            )
        wrong += beyond
        if uses_outlines(study):
            wrong += _outline_problems(row, study, table)
        shots.append(NewShot(row, wrong, remarks, inside))
        others.append((row, f"line {row['line']} of {source.name}"))
    homes = [Path("results") / home for home in reversed(homes_of(name, study["effects"]))]
    home = next((home for home in homes if is_calibrated(home)), None)
    cells = [arranged(table, header, texts_of_row) for _, texts_of_row in records]
    addition = Addition(source, table, cells, shots, home)
    if home is None:
        addition.no_model = "the study has not been calibrated yet"
    else:
        _ask_model(addition, texts, study)
    return addition


def _outline_problems(row: dict, study: dict, table: Path) -> list[str]:
    try:
        check_outlines([row], study, table)
    except InputError as error:
        return [str(error).removeprefix(f"{table}, line {row['line']}: ")]
    return []


def _ask_model(addition: Addition, texts: list[dict[str, str]], study: dict) -> None:
    """Adds predictions to the shots that lie where the network was trained."""
    home, asked = addition.home, []
    for shot, cells in zip(addition.shots, texts, strict=True):
        beyond = beyond_network(shot.row, home)
        if not beyond:
            asked.append((shot, cells))
        else:
            shot.remarks.append(f"beyond the network, no prediction: {'; '.join(beyond)}")
            if shot.inside:
                shot.remarks.append(
                    "study.yaml was widened since the network was trained: `taylorcal why` tells "
                    "the runs of the solver that this costs"
                )
    fitted = home / "outlines" / "measurements.csv" if uses_outlines(study) else addition.table
    try:
        found = predictions([shot.row for shot, _ in asked], [c for _, c in asked], fitted, home)
    except InputError as error:
        addition.no_model = f"the calibration does not fit the study as it stands: {error}"
        return
    for shot, _ in asked:
        shot.prediction = found.get(shot.row["id"])
        if shot.prediction and not shot.prediction.stand_in and shot.row["use"] != "ignore":
            shot.outliers = _outliers(shot.prediction)


def _outliers(prediction: Prediction) -> list[str]:
    return [
        f"{size.size} = {size.measured:g} is {abs(size.deviation):.0f} standard errors from the "
        f"model ({size.predicted:.4g} +- {size.sd:.2g} mm). Mend the number, or say "
        "--accept-outliers if it was measured so."
        for size in prediction.sizes
        if abs(size.deviation) > IMPOSSIBLE
    ]
