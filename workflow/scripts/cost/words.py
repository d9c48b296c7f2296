"""Words a study's cost."""

from cost.model import StudyCost
from cost.schedule import CORES_OF_A_JOB, schedule

CORES = [1, 2, 4, 16, 64, 256, 1000, 4000, 10000]
FEW_RUNS = 20


def cost_words(name: str, study: dict, cost: StudyCost) -> str:
    solver, longest = study["solver"], max(cost.runs_s)
    better = study["database"]["better"]
    finer = (
        f", {better['runs']} of them {better['geometry']}, {better['fidelity']}" if better else ""
    )
    near = study["database"]["near_posterior"]
    second = f", {near['runs']} of them in a second round" if near else ""
    lines = [
        f"{name}: about {_core_hours(cost.core_hours)} before anything is there.",
        f"  {len(cost.runs_s)} runs, {solver['geometry']}, {solver['fidelity']}{finer}{second}: "
        f"{_core_hours(sum(cost.runs_s) / 3600)}, the longest {duration(longest)}",
    ]
    for shape in dict.fromkeys(cost.shapes):
        own = [run for run, of in zip(cost.runs_s, cost.shapes) if of == shape]
        lines.append(f"    {shape:<20}{len(own):>6} runs, {sum(own) / len(own):8.2f} CPU s each")
    lines.append(
        f"  training {duration(sum(cost.train_s))}, sampling {duration(cost.sample_s)} CPU"
    )
    if cost.measured_runs < FEW_RUNS:
        lines.append(f"  A kind of run rests on {cost.measured_runs} measured: take it as a guess.")
    return "\n".join([*lines, "", table(study, cost)])


def table(study: dict, cost: StudyCost) -> str:
    lines = [f"{'cores':>7}{'chunks':>8}{'wall time':>12}{'of it runs':>12}{'cores busy':>12}"]
    for cores in CORES:
        plan = schedule(cost, cores, study["database"]["chunks"])
        lines.append(
            f"{cores:>7}{plan.chunks:>8}{duration(plan.wall_s):>12}{duration(plan.runs_s):>12}"
            f"{100 * plan.used:>10.0f} %"
        )
    lines.append(
        "`chunks`: what `database.chunks` must be at least; one is a job of "
        f"{CORES_OF_A_JOB} cores."
    )
    return "\n".join(lines)


def duration(seconds: float) -> str:
    if seconds < 90:
        return f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h"


def _core_hours(hours: float) -> str:
    return f"{hours:.2g} core-hours" if hours < 10 else f"{hours:.0f} core-hours"
