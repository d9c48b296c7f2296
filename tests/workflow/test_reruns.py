"""What invalidates what: each line of the table in workflow/README.md, on the tiny study."""

import re
import shutil
from concurrent.futures import ThreadPoolExecutor

import pytest
from tiny_study import NEW_ROW, ROOT, Workspace, copy_workspace, use_own_workflow, use_stand_ins

from why.words import STAGES

CHAIN = ["design", "runs", "merge", "train", "sample", "compare", "report"]
README = (ROOT / "workflow" / "README.md").read_text(encoding="utf-8")


def replaced(old: str, new: str, file: str = "experiments/tiny/study.yaml"):
    """An edit of a file of the workspace."""

    def edit(workspace: Workspace) -> None:
        if file.startswith("workflow/"):
            use_own_workflow(workspace)
        path = workspace.folder / file
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new, 1))

    return edit


def deleted(*files: str):
    def edit(workspace: Workspace) -> None:
        for file in files:
            path = workspace.results / file
            shutil.rmtree(path) if path.is_dir() else path.unlink()

    return edit


def other_code(*programs: str):
    """The programs as if built of other sources; the rest as if rebuilt of the same."""

    def edit(workspace: Workspace) -> None:
        use_stand_ins(workspace, dict.fromkeys(programs, "0123456789abcdef"))

    return edit


def all_of(*edits):
    def edit(workspace: Workspace) -> None:
        for one in edits:
            one(workspace)

    return edit


def checked_out_anew(workspace: Workspace) -> None:
    """All files of the checkout have a new date."""
    use_own_workflow(workspace)
    for path in [*workspace.study.iterdir(), *(workspace.folder / "workflow").rglob("*")]:
        path.touch()


def new_row(workspace: Workspace) -> None:
    with (workspace.study / "measurements.csv").open("a") as file:
        file.write(NEW_ROW)


covered = replaced("  runs: 24\n", "  runs: 24\n  parameters: { hardening_coefficient: [1, 5] }\n")
narrower = replaced("lower: 1, upper: 5", "lower: 1.5, upper: 4")
SCRIPTS = "workflow/scripts"

# By the first column of the table; the second column says what is expected.
EDITS = {
    "a checkout written anew": checked_out_anew,
    "programs rebuilt from the same sources": other_code(),
    "a comment in `study.yaml` or in a script": all_of(
        replaced("title:", "# a remark\ntitle:"),
        replaced("EDGE_RUNS = 3", "EDGE_RUNS  =  3  # a remark", f"{SCRIPTS}/make_design.py"),
    ),
    "the priors' ranges in `database.parameters`": covered,
    "`chunks/`, `config/` or `design.h5` deleted": deleted("chunks", "config", "design.h5"),
    "`title`, `about`": replaced("title: Four shots", "title: Some shots"),
    "a template of the page": replaced("</", "<!-- --></", "workflow/report/page.html.j2"),
    "a script of the report": replaced("import", "import os\nimport", f"{SCRIPTS}/report/chart.py"),
    "`report.html` or `plots/` deleted": deleted("plots"),
    "a row of the table": new_row,
    "`calibration:`, its `seed`": replaced("  draws: 2000", "  seed: 2\n  draws: 2000"),
    "`scope` of a parameter": replaced("scope: per_lot", "scope: shared"),
    "a prior narrower than `database.parameters`": all_of(covered, narrower),
    "code of `calibrate`": other_code("calibrate"),
    "`posterior.h5` deleted": deleted("posterior.h5"),
    "`emulator:`, size of the network": replaced("hidden_layers: 2", "hidden_layers: 3"),
    "`emulator.epochs`": replaced("epochs: 60", "epochs: 61"),
    "`emulator.seed`": replaced("  epochs: 60", "  seed: 2\n  epochs: 60"),
    "code of `emulator`": other_code("emulator"),
    "`emulator.json` deleted": deleted("emulator.json"),
    "`database.h5` deleted": deleted("database.h5"),
    "`solver:`": replaced("fidelity: coarse", "fidelity: standard"),
    "`database.chunks`": replaced("chunks: 2", "chunks: 3"),
    "code of `solver`": other_code("solver"),
    "code in `common/`": other_code("solver", "emulator", "calibrate"),
    "`database:`, ranges and number of runs": replaced("runs: 24", "runs: 26"),
    "`database.seed`": replaced("  runs: 24", "  seed: 2\n  runs: 24"),
    "a prior's range that `database.parameters` does not name": narrower,
    "a prior of another kind": replaced("prior: log_uniform", "prior: uniform"),
    "the script that chooses the runs": replaced(
        "EDGE_RUNS = 3", "EDGE_RUNS = 2", f"{SCRIPTS}/make_design.py"
    ),
}


def table() -> dict[str, str]:
    """The lines of the README's table: a change, and from where it reruns."""
    lines = README.split("## What reruns\n")[1].split("\n\n")[1].splitlines()
    rows = [re.fullmatch(r"\| (.+?) \| (.+?) \|", line) for line in lines]
    return {row[1]: row[2] for row in rows[2:] if row} if all(rows[2:]) else {}


def expected_rules(words: str) -> set[str]:
    """`nothing`, a stage in the words of `taylorcal why`, or `... and what follows`."""
    if words == "nothing":
        return set()
    stage = words.removesuffix(" and what follows")
    rule = {told: rule for rule, told in STAGES.items()}[stage]
    return set(CHAIN[CHAIN.index(rule) :]) if stage != words else {rule}


def test_each_line_of_the_table_is_tested():
    assert list(table()) == list(EDITS)


@pytest.fixture(scope="module")
def plans(finished, tmp_path_factory):
    """The plan after each change, to come; two at a time, since Snakemake starts slowly."""

    def plan(change: str) -> set[str]:
        folder = tmp_path_factory.mktemp("change") / "copy"
        workspace = copy_workspace(finished, folder)
        EDITS[change](workspace)
        return workspace.planned_rules()

    with ThreadPoolExecutor(2) as pool:
        yield {change: pool.submit(plan, change) for change in EDITS}


@pytest.mark.parametrize("change", EDITS)
def test_a_change_reruns_what_the_table_says(plans, change):
    stages = plans[change].result() - {"settings", "all"}
    assert stages == expected_rules(table()[change])


def test_a_narrower_prior_is_sampled_with_the_network_as_it_is(copied):
    all_of(covered, narrower)(copied)
    network = (copied.results / "emulator.json").read_bytes()
    done = copied.run("--show-failed-logs", "results/tiny/comparison.json")
    assert done.returncode == 0, done.stdout
    assert (copied.results / "emulator.json").read_bytes() == network
    assert copied.planned_rules() == {"settings", "report", "all"}


def test_results_can_be_kept_when_code_changed(copied):
    other_code("solver")(copied)
    before = (copied.results / "posterior.h5").read_bytes()
    assert copied.run("--touch").returncode == 0
    assert copied.planned_rules() == set()
    assert (copied.results / "posterior.h5").read_bytes() == before
