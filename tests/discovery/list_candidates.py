"""Writes candidates.json: every axisymmetric effect of the solver, and some constants.

/usr/bin/python3 tests/discovery/list_candidates.py --solver build/bin/solver --out candidates.json
"""

import argparse
import json
import subprocess
from pathlib import Path

# Constants that the study keeps fixed, and the standard deviation of what is known of them.
CONSTANTS = {
    "initial_yield_stress": 1.0e7,
    "annihilation_coefficient": 2.0,
}
# The same physics as an effect, under another name: only tables of twins have it in their list.
TWINS = {"drag_slope": 1.0e-8}


def solver_list(solver: Path, what: str) -> list[dict]:
    """What `solver effects` or `solver parameters` lists."""
    command = [str(solver), what, "--json"]
    answer = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return json.loads(answer)[what]


def effect_candidate(effect: dict) -> dict:
    kept = ["name", "symbol", "unit", "lowest", "highest", "prior", "signed", "typical"]
    kept += ["description", "equation", "source"]
    return {**{key: effect[key] for key in kept}, "kind": "effect", "base": 0.0}


def constant_candidate(constant: dict, scale: float) -> dict:
    kept = ["name", "symbol", "unit", "lowest", "highest", "description", "source"]
    return {
        **{key: constant[key] for key in kept},
        "kind": "constant",
        "base": constant["default"],
        "prior": {"kind": "normal", "scale": scale},
        "signed": True,
        # Down where up would leave the range, as for a share that is nearly one.
        "typical": scale if constant["default"] + scale <= constant["highest"] else -scale,
        "equation": "",
    }


def candidates(effects: list[dict], constants: list[dict]) -> list[dict]:
    """Effects of axisymmetric runs, then CONSTANTS and TWINS; `typical` is a change from base."""
    chosen = [effect_candidate(item) for item in effects if "axisymmetric" in item["geometries"]]
    by_name = {item["name"]: item for item in constants}
    scales = {**CONSTANTS, **TWINS}
    return chosen + [constant_candidate(by_name[name], scale) for name, scale in scales.items()]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--solver", type=Path, default=Path("build/bin/solver"))
    parser.add_argument("--out", type=Path, required=True)
    options = parser.parse_args()
    lists = [solver_list(options.solver, what) for what in ("effects", "parameters")]
    text = json.dumps({"candidates": candidates(*lists)}, indent=1)
    options.out.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
