"""Wall time of a study on a number of cores: the schedule of the workflow, simulated.

A chunk of runs is a job of up to 16 cores; as many jobs run at once as there are cores for. In a
job each core that is free takes the next run. Training takes a core a member, sampling one job.
"""

import heapq
from dataclasses import dataclass

from cost.model import OTHER_STAGES_S, StudyCost

CORES_OF_A_JOB = 16  # of workflow/profiles/slurm
START_OF_A_JOB_S = 10  # a job starts, and Snakemake in it


@dataclass
class Schedule:
    cores: int
    chunks: int
    runs_s: float  # wall seconds of all runs
    wall_s: float  # and of the study
    used: float  # share of the cores' time in which they computed runs


def schedule(cost: StudyCost, cores: int, chunks: int) -> Schedule:
    """`chunks`: of the study; more where there are more jobs at once than those."""
    of_job = min(CORES_OF_A_JOB, cores)
    jobs_at_once = max(1, cores // of_job)
    chunks = min(max(chunks, jobs_at_once), len(cost.runs_s))
    bounds = [chunk * len(cost.runs_s) // chunks for chunk in range(chunks + 1)]
    jobs = [
        START_OF_A_JOB_S + makespan(cost.runs_s[first:last], of_job)
        for first, last in zip(bounds, bounds[1:])
    ]
    runs_s = makespan(jobs, jobs_at_once)
    train_s = START_OF_A_JOB_S + makespan(cost.train_s, of_job)
    sample_s = START_OF_A_JOB_S + cost.sample_s / of_job
    used = sum(cost.runs_s) / (cores * runs_s)
    wall_s = runs_s + train_s + sample_s + OTHER_STAGES_S
    return Schedule(cores, chunks, runs_s, wall_s, used)


def makespan(seconds: list[float], workers: int) -> float:
    """Until the last piece is done, when whoever is free takes the next one."""
    free = [0.0] * min(workers, max(len(seconds), 1))
    for piece in seconds:
        heapq.heappush(free, heapq.heappop(free) + piece)
    return max(free)
