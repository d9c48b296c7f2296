"""Turns Snakemake's reasons into causes that a user of the study knows."""

from pathlib import Path

from effects import solver_list
from revisions import split_home
from study import STAGE_SETTINGS, at_revision, design_settings
from why.changes import narrowed_ranges, settings_changes, table_changes
from why.plan import Job
from why.records import code_changes, recorded_codes, recorded_settings

RULES = Path("workflow") / "rules"
LISTED = 3  # files or changes named in a line; the rest are counted


class Causes:
    """The causes of one study's jobs; `table` and `rows` are its measurements."""

    def __init__(self, study: dict, table: Path, rows: list[dict], jobs: list[Job]):
        self.study, self.table, self.rows = study, table, rows
        self.makers = {file: job for job in jobs for file in job.outputs}

    def own(self, job: Job, kind: str, files: list[str]) -> list[str]:
        """What made a job necessary itself; nothing for what follows from other jobs."""
        if kind == "follows":
            return []
        if kind == "missing":
            return [f"its result is not there: {listed(files)}"]
        if kind == "interrupted":
            return [f"it was interrupted: {listed(files)}"]
        if kind == "newer":
            return [cause for file in files for cause in self._of_file(job, file)]
        if kind == "files":
            return ["other files go into it than before"]
        if kind == "code":
            # A result of an earlier taylorcal is told as such, by its parameters.
            noted = recorded_codes(job.outputs[0])
            return [f"the rule {job.rule} in {RULES} changed"] if noted else []
        if kind == "settings":
            return self._of_parameters(job)
        return [f"snakemake says: {kind}"]

    def of_settings(self, file: str) -> list[str]:
        """Of a stage whose settings file is written anew: which settings differ."""
        maker, before = self.makers[file], recorded_settings(file)
        if before is None or not Path(file).exists():
            return [f"its settings are not there: {file}"]
        stage, home = maker.wildcards["stage"], maker.wildcards["study"]
        changes = settings_changes(before, STAGE_SETTINGS[stage](self._study_at(home)))
        if changes:
            return [f"its settings in study.yaml changed: {listed(changes)}"]
        own = [
            cause for kind, files in maker.reasons.items() for cause in self.own(maker, kind, files)
        ]
        return [f"its settings are written anew: {cause}" for cause in own]

    def masked(self, job: Job, told: list[str]) -> list[str]:
        """Code and rows that changed where Snakemake stopped at its first reason."""
        found = [] if "missing" in job.reasons else code_changes(job.outputs[0])
        if job.rule in ("sample", "first_sample") and not any(
            "measurements" in cause for cause in told
        ):
            found += self._of_table(job)
        return found

    def _of_file(self, job: Job, file: str) -> list[str]:
        path = Path(file)
        if path == self.table:
            unseen = "though no number that is fitted did" if self._comparison(job).exists() else ""
            return self._of_table(job) or [f"{file} changed {unseen}".strip()]
        if path.is_relative_to("workflow/report"):
            return [f"the page's template {file} changed"]
        if path.is_relative_to(self.table.parent):
            return [f"the measured outline {file} changed"]
        return [f"{file} is newer than it"]

    def _of_table(self, job: Job) -> list[str]:
        sizes = self.study["calibration"]["fit_sizes"]
        changes = table_changes(self.rows, self._comparison(job), sizes)
        return [f"the measurements changed: {listed(changes)}"] if changes else []

    def _comparison(self, job: Job) -> Path:
        return Path("results") / job.wildcards["study"] / "comparison.json"

    def _of_parameters(self, job: Job) -> list[str]:
        """A rule's parameters: digests of the code, settings, and the share of the runs."""
        output = job.outputs[0]
        if not recorded_codes(output):
            return ["an earlier taylorcal made it, which did not note the code that it ran"]
        found = code_changes(output)
        if job.rule == "design":
            found += self._of_design(output, job.wildcards["study"])
        return found or ["its share of the runs, or another setting in study.yaml, changed"]

    def _of_design(self, output: str, home: str) -> list[str]:
        before, after = recorded_settings(output), design_settings(self._study_at(home))
        changes = settings_changes(before, after)
        if not changes:
            return []
        found = [f"the database that study.yaml asks for changed: {listed(changes)}"]
        narrowed = narrowed_ranges(before["parameters"], after["parameters"])
        for name, limits in narrowed.items():
            found.append(f"its runs would serve with `{name}: {limits}` in database.parameters")
        return found

    def _study_at(self, home: str) -> dict:
        effects = split_home(home)[1]
        known = solver_list("effects") if effects else {}
        return at_revision(self.study, [known[name] for name in effects])


def listed(items: list[str]) -> str:
    more = len(items) - LISTED
    return ", ".join(items[:LISTED]) + (f" and {more} more" if more > 0 else "")
