"""Renders a page that needs no network and no other file, and its charts as PNG."""

import base64
import gzip
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from atomic_file import write_text
from report import words
from report.chart import Chart
from report.plotly_chart import plotly_json
from report.png_chart import save_png

SYNTHETIC_MARK = " (synthetic data)"


def write_page(
    template: Path,
    style: Path,
    charts: dict[str, list[Chart]],
    page: Path,
    plots: Path,
    **context,
) -> None:
    """Writes the page from `context`, which has at least the study's `settings`.

    `charts` are those of each section. Every picture says whether its data are synthetic.
    """
    plots.mkdir(parents=True, exist_ok=True)
    mark = SYNTHETIC_MARK if context["settings"]["synthetic"] else ""
    for section in charts.values():
        for chart in section:
            save_png(chart, plots, mark)
    text = _render(template, style.read_text(encoding="utf-8"), charts, plots.name, context)
    write_text(page, text)


def _render(template: Path, style: str, charts: dict, plots: str, context: dict) -> str:
    environment = Environment(
        loader=FileSystemLoader(template.parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"number": words.number, "duration": words.duration}
    environment.filters |= {"percent": words.percent, "effect": words.effect_words}
    figures = {
        chart.name: Markup(plotly_json(chart).replace("</", "<\\/"))
        for section in charts.values()
        for chart in section
    }
    return environment.get_template(template.name).render(
        words=words,
        charts=charts,
        figures=figures,
        plots=plots,
        style=Markup(style),
        plotly=_packed_plotly(),
        **context,
    )


@cache
def _packed_plotly() -> str:
    """plotly.js in a quarter of its size; the page unpacks it. No time stamp inside."""
    return base64.b64encode(gzip.compress(get_plotlyjs().encode(), mtime=0)).decode()
