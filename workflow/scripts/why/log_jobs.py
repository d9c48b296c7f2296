"""Snakemake's log handler for `why.plan`: each planned job as a marked line of JSON."""

import json

MARK = "planned: "  # Snakemake's own words go to the same stream


def log_handler(message: dict) -> None:
    if message["level"] == "job_info":
        told = {key: message[key] for key in ("name", "output", "reason")}
        print(MARK + json.dumps({**told, "wildcards": dict(message["wildcards"])}), flush=True)
    elif message["level"] == "shellcmd":
        print(MARK + json.dumps({"shell": message["msg"]}), flush=True)
