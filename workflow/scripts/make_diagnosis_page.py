"""Writes diagnosis.html: where the model fails, what is missing, and what adding it did."""

from pathlib import Path

from report import candidates, diagnosis_charts, ladder, ladder_charts, residual_charts, verdict
from report.chart import Chart
from report.diagnosis_results import DiagnosisResults, load_diagnosis
from report.page import write_page
from report.provenance import stage_provenance
from stage_log import logged_to


def charts_of(results: DiagnosisResults) -> dict[str, list[Chart]]:
    """The charts of each section of the page, without the empty ones."""
    sections = {
        "fails": [residual_charts.heat_map(results.comparison)],
        "evidence": [diagnosis_charts.evidence_chart(results)],
        "confounding": [diagnosis_charts.confounding_chart(results)],
        "unseen": [diagnosis_charts.unseen_chart(results)],
        "unexplained": [diagnosis_charts.pattern_chart(results)],
        "ladder": [
            ladder_charts.ladder_chart(results),
            ladder_charts.shape_chart(results),
            ladder_charts.size_chart(results),
        ],
        "confirmation": [ladder_charts.confirmation_chart(results)],
    }
    return {name: [c for c in charts if c.panels] for name, charts in sections.items()}


def write_diagnosis(
    inputs: dict[str, Path], confirmations: dict[str, Path], page: Path, plots: Path
) -> None:
    """`confirmations` by id of the revision; `inputs` may lack the ladder."""
    results = load_diagnosis(inputs, confirmations)
    write_page(
        inputs["page"],
        inputs["style"],
        charts_of(results),
        page,
        plots,
        results=results,
        settings=results.settings,
        scores=[entry["score"] for entry in results.ranked if entry["score"] is not None],
        verdict=verdict,
        candidates=candidates,
        ladder=ladder,
        report="report.html",
        provenance=[
            stage_provenance("Comparison", results.comparison),
            stage_provenance("Diagnosis", results.diagnosis),
        ],
    )


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        given = {
            name: Path(path)
            for name, path in snakemake.input.items()  # noqa: F821
            if isinstance(path, str)
        }
        revisions = snakemake.params.revisions  # noqa: F821
        paths = map(Path, snakemake.input.confirmations)  # noqa: F821
        write_diagnosis(
            given,
            dict(zip(revisions, paths, strict=True)),
            Path(snakemake.output.page),  # noqa: F821
            Path(snakemake.output.plots),  # noqa: F821
        )
