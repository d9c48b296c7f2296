"""Loads what the diagnosis needs into one object for its page."""

from dataclasses import dataclass, field
from pathlib import Path

from json_file import read_json
from report.words import third_words


@dataclass
class DiagnosisResults:
    """`ladder` and `confirmations` are empty before an effect was added."""

    settings: dict
    comparison: dict
    diagnosis: dict
    candidates: dict[str, dict]  # of candidates.json, by name
    next_experiments: list[dict]
    ladder: list[dict] = field(default_factory=list)  # revisions in the order of adding
    confirmations: dict[str, dict] = field(default_factory=dict)  # by id of the revision

    @property
    def thirds(self) -> dict[str, str]:
        """Of the velocities of the comparisons, which are the same in all revisions."""
        return third_words(self.comparison["velocity_thirds_m_s"], narrow=True)

    @property
    def ranked(self) -> list[dict]:
        """Candidates of the diagnosis with what candidates.json says of them, best first.

        Those of which nothing can be concluded come last; their numbers may be None.
        """
        found = [
            {**self.candidates.get(entry["name"], {}), **entry}
            for entry in self.diagnosis["candidates"]
        ]
        return sorted(
            found, key=lambda entry: (entry["abstain"], -(entry["log_evidence_gain"] or 0))
        )


def load_diagnosis(
    inputs: dict[str, Path], confirmations: dict[str, Path] | None = None
) -> DiagnosisResults:
    """`inputs`: settings, comparison, diagnosis, candidates, next_experiment, perhaps ladder.

    `confirmations` holds the confirmation.json of revisions by their id.
    """
    ladder = []
    if "ladder" in inputs:
        ladder = read_json(inputs["ladder"], "taylorcal/ladder/1")["revisions"]
    return DiagnosisResults(
        settings=read_json(inputs["settings"]),
        comparison=read_json(inputs["comparison"], "taylorcal/comparison/1"),
        diagnosis=read_json(inputs["diagnosis"], "taylorcal/diagnosis/1"),
        candidates={
            entry["name"]: entry for entry in read_json(inputs["candidates"])["candidates"]
        },
        ladder=ladder,
        confirmations={key: read_json(path) for key, path in (confirmations or {}).items()},
        next_experiments=read_json(inputs["next_experiment"])["next_experiments"],
    )
