"""Where and how much the network of paper_design errs over the whole of its ranges: its held-out
runs, but for those of the second round, by output, shape, region and scale, and how well the spread
between members and the nearest runs tell the size of an error.
"""

import json
from pathlib import Path

import numpy as np
import pandas as pd

from draw_network_errors import draw_correlation, draw_errors
from error_scales import by_region, error_table, percent_errors, without_worst
from error_spreads import BOTH, MEMBERS, NEAREST, coverage_table, local_spread, member_spread
from held_out_runs import among, held_out_runs, part_of
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


def study(runs):
    """Percent errors of held-out runs, their spreads, and tables of all that."""
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
    return errors, spreads, tables


if __name__ == "__main__":
    source, outputs = snakemake.input.emulator, snakemake.output  # noqa: F821
    model = json.loads(Path(source).read_text())
    runs = held_out_runs(model, source)
    runs = part_of(runs, ~among(runs, snakemake.input.near))  # noqa: F821
    errors, spreads, tables = study(runs)
    Path(outputs.text).write_text(words(model, runs, errors, tables) + "\n")
    tables["errors"].round(4).to_csv(outputs.table, index=False)
    pd.concat(tables["regions"]).round(4).to_csv(outputs.regions, index=False)
    tables["coverage"].round(4).to_csv(outputs.coverage, index=False)
    draw_correlation(runs, tables["errors"], outputs.correlation)
    draw_errors(runs, spreads, tables, outputs.figure)
