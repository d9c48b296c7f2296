"""The held-out runs of an emulator file: what the solver gave, and what each member answers."""

from dataclasses import dataclass, replace

import h5py
import numpy as np
import pandas as pd

PLAIN = {"linear": lambda t: t, "log10": lambda t: 10**t, "square_root": np.square}
SEEN = {"linear": lambda t: t, "log10": np.log10, "square_root": np.sqrt}  # as the network does
MOST_PAIRS = 200  # rows that `emulator train` writes into validation.pairs, at most
SAME_INPUTS = 1e-4  # relative: single precision
LARGEST_DISAGREEMENT = 1e-3  # of the RMS error in the file: single precision, no more


@dataclass
class HeldOutRuns:
    """Sizes are divided as the network's outputs are (`divide_by`); NaN: the run has none."""

    names: list  # of the outputs
    shapes: np.ndarray  # [runs]
    places: np.ndarray  # [runs x used inputs], standardised
    inputs: pd.DataFrame  # [runs x inputs], plain
    solver: np.ndarray  # [runs x outputs]
    members: np.ndarray  # [members x runs x outputs]
    best: int
    divisors: np.ndarray  # [runs x outputs]: sizes in mm are so many times larger

    @property
    def network(self):
        """Of the member that answers, [runs x outputs]."""
        return self.members[self.best]


def part_of(runs, rows):
    """Some rows of held-out runs."""
    of_rows = ("shapes", "places", "solver", "divisors")
    parts = {name: getattr(runs, name)[rows] for name in of_rows}
    return replace(runs, **parts, inputs=runs.inputs[rows], members=runs.members[:, rows])


def among(runs, database):
    """Which held-out runs are in a database, by their inputs: a run of a second round, say."""
    with h5py.File(database) as file:
        names = [str(name) for name in file["inputs"].attrs["names"]]
        known = pd.DataFrame(file["inputs"][:], columns=names)[runs.inputs.columns].to_numpy()
    found = np.zeros(len(runs.shapes), dtype=bool)
    for row, inputs in enumerate(runs.inputs.to_numpy()):
        found[row] = np.isclose(known, inputs, rtol=SAME_INPUTS, atol=0).all(axis=1).any()
    return found


def forward(layers, signal):
    """A member's outputs [runs x outputs], standardised, of its inputs [runs x inputs]."""
    for number, layer in enumerate(layers):
        signal = signal @ np.array(layer["weights"]).T + np.array(layer["bias"])
        if number + 1 < len(layers):
            signal = signal / (1 + np.exp(-signal))
    return signal


def plain_inputs(infos, places):
    """Inputs [runs x inputs] of standardised places; one that never varied has its one value."""
    columns, used = {}, iter(places.T)
    for info in infos:
        if info["used"]:
            known = next(used) * info["scale"] + info["shift"]
            columns[info["name"]] = PLAIN[info["transform"]](known)
        else:
            columns[info["name"]] = np.full(len(places), info["lower"])
    return pd.DataFrame(columns)


def standardised(infos, inputs):
    """Places [runs x used inputs] of plain inputs (a table): what `plain_inputs` undoes."""
    used = [info for info in infos if info["used"]]
    seen = [SEEN[info["transform"]](inputs[info["name"]]) for info in used]
    return np.array([(one - info["shift"]) / info["scale"] for one, info in zip(seen, used)]).T


def answers(model, places, shapes):
    """All members' outputs [members x runs x outputs], divided as theirs are."""
    hot = shapes[:, None] == np.array(model["category"]["values"])
    # The column for runs of a cheaper solver is zero here.
    cheaper = np.zeros((len(shapes), int(model["corrects_cheaper_runs"])))
    signal = np.hstack([places, hot, cheaper])
    scale = np.array([output["scale"] for output in model["outputs"]])
    shift = np.array([output["shift"] for output in model["outputs"]])
    members = np.array([forward(one["layers"], signal) for one in model["members"]])
    return members * scale + shift


def held_out_runs(model, where="the emulator"):
    """`model`: the document of an emulator file, in the format of its `recipe`. ValueError if it
    has no held-out runs, or its members do not err on them as it says."""
    held_out = model["validation"].get("held_out")
    if not held_out or not held_out["categories"]:
        raise ValueError(f"{where} has no validation.held_out. Train it again.")
    shapes, places = np.array(held_out["categories"]), np.array(held_out["places"])
    inputs = plain_inputs(model["inputs"], places)
    members = answers(model, places, shapes)
    divisors = [inputs[output["divide_by"]].prod(axis=1) for output in model["outputs"]]
    runs = HeldOutRuns(
        names=[output["name"] for output in model["outputs"]],
        shapes=shapes,
        places=places,
        inputs=inputs,
        solver=members[model["best"]] + np.array(held_out["errors"], dtype=float),
        members=members,
        best=model["best"],
        divisors=np.array(divisors).T,
    )
    check_members(model, runs, where)
    return runs


def check_members(model, runs, where):
    """The file's pairs are every so many of its held-out runs: the sizes must be those."""
    pairs = model["validation"]["pairs"]
    for name, solver, network in zip(
        runs.names, (runs.solver * runs.divisors).T, (runs.network * runs.divisors).T
    ):
        told = [pair for pair in pairs if pair["output"] == name]
        stride = len(solver) // MOST_PAIRS + 1
        rms = np.sqrt(np.nanmean((network - solver) ** 2))
        for key, sizes in (("solver", solver), ("network", network)):
            known = sizes[::stride][np.isfinite(solver[::stride])]
            apart = np.abs(known - [pair[key] for pair in told]).max()
            if apart > LARGEST_DISAGREEMENT * rms:
                raise ValueError(
                    f"{where}: {name} by its members is {apart:.2g} mm from the {key}'s in "
                    "validation.pairs. Train it again."
                )
