"""Where and how much the network of paper_design errs: its held-out runs by output, shape, region
and scale, and how well the spread between members and the nearest runs tell the size of an error.
"""

import json
from pathlib import Path

import numpy as np
import pandas as pd

from draw_network_errors import draw_correlation, draw_errors
from error_scales import by_region, error_table, percent_errors, without_worst
from error_spreads import BOTH, MEMBERS, NEAREST, coverage_table, local_spread, member_spread
from held_out_runs import held_out_runs
from network_error_words import words

LEFT_OUT = [0, 0.01, 0.03, 0.05]  # worst shares of the runs
LOG_DENSITY = "log10_rho_immobile_initial"
REGIONS = [
    {
        "hardening_coefficient": [0, 0.3, 1, 3, 10],
        "immobilization_velocity": [0, 0.05, 0.2, 1, 5],
    },
    {"velocity_m_s": [18, 40, 62, 84, 106, 128], LOG_DENSITY: [10, 11, 12, 13, 14, 15]},
]


def study(model, where):
    """Held-out runs, their percent errors, their spreads, and tables of all that."""
    runs = held_out_runs(model, where)
    errors = percent_errors(runs.solver, runs.network, runs.shapes)
    absolute = runs.network - runs.solver
    spreads = {
        MEMBERS: member_spread(runs.members),
        NEAREST: local_spread(absolute, runs.shapes, runs.places),
    }
    spreads[BOTH] = np.sqrt(spreads[MEMBERS] * spreads[NEAREST])
    density = np.log10(runs.inputs["rho_immobile_initial"])
    inputs = runs.inputs.assign(**{LOG_DENSITY: density})
    tables = {
        "errors": error_table(errors, runs.names, runs.shapes),
        "left_out": without_worst(errors, LEFT_OUT),
        "regions": [by_region(errors, inputs, edges) for edges in REGIONS],
        "coverage": coverage_table(absolute, runs.names, spreads),
    }
    return runs, errors, spreads, tables


if __name__ == "__main__":
    source, outputs = snakemake.input.emulator, snakemake.output  # noqa: F821
    model = json.loads(Path(source).read_text())
    runs, errors, spreads, tables = study(model, source)
    Path(outputs.text).write_text(words(model, runs, errors, tables) + "\n")
    tables["errors"].round(4).to_csv(outputs.table, index=False)
    pd.concat(tables["regions"]).round(4).to_csv(outputs.regions, index=False)
    tables["coverage"].round(4).to_csv(outputs.coverage, index=False)
    draw_correlation(runs, tables["errors"], outputs.correlation)
    draw_errors(runs, spreads, tables, outputs.figure)
