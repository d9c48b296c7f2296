"""Writes report.html, which needs no network and no other file, and the plots as PNG."""

from pathlib import Path

from report import findings, model_charts, outline_charts, posterior_charts, quality_charts
from report import residual_charts
from report.chart import Chart
from report.page import write_page
from report.provenance import provenance_tables
from report.results import Results, load_results
from report.stages import STAGES
from stage_log import logged_to


def charts_of(results: Results) -> dict[str, list[Chart]]:
    """The charts of each section of the page, without the empty ones."""
    sections = {
        "table": [model_charts.table_chart(results)],
        "velocity": model_charts.velocity_charts(results),
        "parity": [model_charts.parity_chart(results)],
        "heat_maps": [residual_charts.heat_map(results.comparison)],
        "deviations": [
            residual_charts.scatter_chart(results),
            residual_charts.normal_chart(results),
        ],
        "outlines": outline_charts.outline_charts(results),
        "posterior": [
            posterior_charts.marginal_chart(results),
            posterior_charts.map_chart(results),
        ],
        "network": [quality_charts.network_chart(results)],
        "costs": [quality_charts.cost_chart(results)],
    }
    if len(results.lots) > 1:
        sections["heat_maps"].append(residual_charts.lot_heat_map(results))
    return {name: [c for c in charts if c.panels] for name, charts in sections.items()}


def write_report(inputs: dict[str, Path], benchmarks: Path, page: Path, plots: Path) -> None:
    results = load_results(inputs, benchmarks)
    write_page(
        inputs["page"],
        inputs["style"],
        charts_of(results),
        page,
        plots,
        results=results,
        settings=results.settings,
        findings=findings,
        stages=STAGES,
        provenance=provenance_tables(results, inputs),
    )


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        write_report(
            {name: Path(path) for name, path in snakemake.input.items()},  # noqa: F821
            Path(snakemake.params.benchmarks),  # noqa: F821
            Path(snakemake.output.page),  # noqa: F821
            Path(snakemake.output.plots),  # noqa: F821
        )
