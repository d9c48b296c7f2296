"""What the calibrated model says of new shots: `calibrate compare` on a table that has them."""

import csv
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from hdf5_file import opened
from input_errors import InputError
from json_file import read_json
from shot_inputs import SHOT_INPUTS
from table_cells import read_cells

CALIBRATE = Path("build/bin/calibrate")
NEEDED = ("emulator.json", "posterior.h5", "config/calibrate.json")
KEYS = ("size", "measured", "predictive_mean", "predictive_sd")  # of a size in comparison.json


@dataclass
class SizeCheck:
    """A measured size [mm] beside the model's mean and standard error: those of the
    measurement, the velocity, the network, the parameters and the unexplained spread.
    """

    size: str
    measured: float
    predicted: float
    sd: float

    @property
    def deviation(self) -> float:
        """Measured less predicted, in standard errors."""
        return (self.measured - self.predicted) / self.sd


@dataclass
class Prediction:
    """`stand_in`: the known lot whose parameters were used, if the shot's own has none yet."""

    sizes: list[SizeCheck]
    stand_in: str = ""


def is_calibrated(home: Path) -> bool:
    return all((home / name).exists() for name in NEEDED)


def lots_of_posterior(home: Path) -> list[str]:
    """The lots that have parameters of their own, as in `rho_immobile_initial[first]`."""
    with opened(home / "posterior.h5") as file:
        names = [str(name) for name in file["draws"].attrs["names"]]
    return list(dict.fromkeys(name.partition("[")[2][:-1] for name in names if "[" in name))


def beyond_network(row: dict, home: Path) -> list[str]:
    """The inputs of a shot that the network was not trained on, with its bounds."""
    network = read_json(home / "emulator.json")
    values = {**row, "length_to_diameter": row["initial_length_mm"] / row["initial_diameter_mm"]}
    found = []
    for entry in network["inputs"]:
        lowest, highest = entry["lower"], entry["upper"]
        slack = 1e-9 * abs(highest)
        name = entry["name"]
        if name in SHOT_INPUTS and not lowest - slack <= values[name] <= highest + slack:
            found.append(f"{name} = {values[name]:g} ({lowest:g} to {highest:g})")
    shapes = (network["category"] or {}).get("values", [])
    if shapes and row["shape"] not in shapes:
        found.append(f"shape {row['shape']!r} ({', '.join(shapes)})")
    return found


def predictions(
    rows: list[dict], cells: list[dict[str, str]], fitted: Path, home: Path
) -> dict[str, Prediction]:
    """By id. `cells`: the texts of each row by column; `fitted`: the table that was sampled.

    A shot of a new lot is predicted as each lot that the posterior knows, and the nearest is
    kept, unless no parameter belongs to a lot. InputError with what `calibrate` said.
    """
    header, records = read_cells(fitted, "one row a shot")
    table = [dict(zip(header, texts, strict=True)) for _, texts in records]
    lots = lots_of_posterior(home)
    # Rows of lots that joined the table since would ask for parameters that are not there.
    table = [shot for shot in table if not lots or shot["lot"].strip() in lots]
    asked = {}  # name in the table of this comparison: the shot and the lot it is taken for
    for row, texts in zip(rows, cells, strict=True):
        for lot in [row["lot"]] if row["lot"] in lots or not lots else lots:
            name = f"new.{len(asked)}"
            asked[name] = (row, lot)
            table.append({**texts, "id": name, "lot": lot, "use": "validate"})
    found: dict[str, Prediction] = {}
    for shot in _compared(table, home)["shots"]:
        if shot["id"] not in asked:
            continue
        row, lot = asked[shot["id"]]
        sizes = [SizeCheck(*(size[key] for key in KEYS)) for size in shot["sizes"]]
        prediction = Prediction(sizes, "" if lot == row["lot"] else lot)
        if row["id"] not in found or _misfit(prediction) < _misfit(found[row["id"]]):
            found[row["id"]] = prediction
    return found


def _misfit(prediction: Prediction) -> float:
    return sum(size.deviation**2 for size in prediction.sizes)


def _compared(table: list[dict[str, str]], home: Path) -> dict:
    """comparison.json of a table that nobody keeps."""
    with tempfile.TemporaryDirectory() as folder:
        measurements, out = Path(folder) / "measurements.csv", Path(folder) / "comparison.json"
        columns = dict.fromkeys(name for row in table for name in row)
        with measurements.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(columns), restval="", lineterminator="\n")
            writer.writeheader()
            writer.writerows(table)
        command = [CALIBRATE, "compare", "--out", out, "--measurements", measurements]
        for option, name in zip(("emulator", "posterior", "config"), NEEDED, strict=True):
            command += [f"--{option}", home / name]
        try:
            run = subprocess.run(command, capture_output=True, text=True)
        except OSError as error:
            raise InputError(f"{CALIBRATE}: cannot be run ({error.strerror}).") from error
        if run.returncode:
            raise InputError(" ".join(run.stderr.split()))
        return read_json(out)
