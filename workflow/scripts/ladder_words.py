"""The ladder of a study's revisions as a table of text."""

COLUMNS = ("revision", "fitted", "held back", "solver", "ln Z", "new runs")


def ladder_words(ladder: dict) -> str:
    """Root mean square of the whitened misfit in standard errors; solver: its own, fitted."""
    rows = [COLUMNS]
    for rung in ladder["revisions"]:
        misfit, evidence = rung["misfit"], rung["log_evidence"]
        values = [misfit["calibrate"], misfit["validate"], rung["confirmed"]["calibrate"]]
        rows.append(
            (
                rung["id"],
                *(_number(value["whitened_rms"] if value["n"] else None) for value in values),
                _number(evidence),
                str(rung["new_runs"]),
            )
        )
    widths = [max(len(row[column]) for row in rows) for column in range(len(COLUMNS))]
    lines = [
        "  ".join([row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])]) for row in rows
    ]
    return "\n".join(["misfit in standard errors:", *lines])


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f}"
