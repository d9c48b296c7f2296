"""What a job's log says of the machine that it ran on, and of what it cost there.

The first line is `host NAME`, the last `took 1.234 s, 2.105 s user, 0.031 s system`. Both stand
in the log alone, so that results have the same bytes wherever and however fast they are made.
"""

import os
import platform
import re
import time
from dataclasses import dataclass
from pathlib import Path

HOST = re.compile(r"^host (\S+)$", re.MULTILINE)
TOOK = re.compile(r"^took ([\d.]+) s, ([\d.]+) s user, ([\d.]+) s system$", re.MULTILINE)


@dataclass
class JobRecord:
    host: str | None
    wall_s: float | None
    cpu_s: float | None


def job_record(log: Path) -> JobRecord:
    """What the log holds of it; a log of an earlier taylorcal, or none, holds nothing."""
    text = log.read_text(encoding="utf-8", errors="replace") if log.exists() else ""
    host, took = HOST.search(text), TOOK.findall(text)
    if not took:
        return JobRecord(host[1] if host else None, None, None)
    wall_s, user_s, system_s = map(float, took[-1])
    return JobRecord(host[1] if host else None, wall_s, user_s + system_s)


def logged_words(words: str, started: float) -> str:
    """The log of a job that Python does; `started`: by time.perf_counter()."""
    took, used = time.perf_counter() - started, os.times()
    cost = f"took {took:.3f} s, {used.user:.3f} s user, {used.system:.3f} s system"
    return f"host {platform.node()}\n{words.rstrip()}\n{cost}\n"
