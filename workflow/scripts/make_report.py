"""Writes report.html, which needs no network and no other file, and the plots as PNG."""

import base64
import gzip
import os
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from report import findings, model_charts, outline_charts, posterior_charts, quality_charts
from report import words
from report.chart import Chart
from report.plotly_chart import plotly_json
from report.png_chart import save_png
from report.provenance import provenance_tables
from report.results import Results, load_results
from stage_log import logged_to


def charts_of(results: Results) -> dict[str, list[Chart]]:
    """The charts of each section of the page, without the empty ones."""
    sections = {
        "table": [model_charts.table_chart(results)],
        "velocity": model_charts.velocity_charts(results),
        "parity": [model_charts.parity_chart(results)],
        "residuals": [model_charts.residual_chart(results)],
        "outlines": outline_charts.outline_charts(results),
        "normal": [model_charts.normal_chart(results)],
        "posterior": [
            posterior_charts.marginal_chart(results),
            posterior_charts.map_chart(results),
        ],
        "network": [quality_charts.network_chart(results)],
        "costs": [quality_charts.cost_chart(results)],
    }
    if len(results.lots) > 1:
        sections["residuals"].append(model_charts.lot_residual_chart(results))
    return {name: [c for c in charts if c.panels] for name, charts in sections.items()}


def render(results: Results, charts: dict[str, list[Chart]], template: Path, style: str) -> str:
    environment = Environment(
        loader=FileSystemLoader(template.parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"number": words.number, "duration": words.duration}
    environment.filters |= {"percent": words.percent}
    figures = {
        chart.name: Markup(plotly_json(chart).replace("</", "<\\/"))
        for section in charts.values()
        for chart in section
    }
    return environment.get_template(template.name).render(
        results=results,
        settings=results.settings,
        findings=findings,
        words=words,
        charts=charts,
        figures=figures,
        stage_words=quality_charts.STAGE_WORDS,
        provenance=provenance_tables(results),
        style=Markup(style),
        plotly=_packed(get_plotlyjs()),
    )


def _packed(script: str) -> str:
    """plotly.js in a quarter of its size; the page unpacks it. No time stamp inside."""
    return base64.b64encode(gzip.compress(script.encode(), mtime=0)).decode()


def write_report(inputs: dict[str, Path], benchmarks: Path, page: Path, plots: Path) -> None:
    results = load_results(inputs, benchmarks)
    charts = charts_of(results)
    plots.mkdir(parents=True, exist_ok=True)
    for section in charts.values():
        for chart in section:
            save_png(chart, plots, " (synthetic data)" if results.settings["synthetic"] else "")
    style = Path(inputs["style"]).read_text(encoding="utf-8")
    partial = page.with_name(page.name + ".tmp")
    partial.write_text(render(results, charts, Path(inputs["page"]), style), encoding="utf-8")
    os.replace(partial, page)


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        write_report(
            {name: Path(path) for name, path in snakemake.input.items()},  # noqa: F821
            Path(snakemake.params.benchmarks),  # noqa: F821
            Path(snakemake.output.page),  # noqa: F821
            Path(snakemake.output.plots),  # noqa: F821
        )
