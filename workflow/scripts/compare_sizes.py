"""Sets the sizes of shots computed by two equations of state side by side."""

from pathlib import Path

from atomic_file import write_text
from json_file import read_json
from stage_log import logged_to

SIZES = (
    "final_length_mm",
    "impact_diameter_mm",
    "head_length_mm",
    "rear_length_mm",
    "transition_diameter_mm",
)
NETWORK = "_copper_md"


def pairs(paths) -> list[tuple[dict, dict]]:
    """Runs by the analytic copper and by the network of the same shot."""
    runs = {Path(path).stem: read_json(path) for path in paths}
    shots = [name.removesuffix(NETWORK) for name in runs if name.endswith(NETWORK)]
    return [(runs[f"{shot}_copper"], runs[f"{shot}{NETWORK}"]) for shot in shots]


def table(paths) -> str:
    head = "| shape | m/s | " + " | ".join(name.removesuffix("_mm") for name in SIZES)
    lines = [head.replace("_", " ") + " | Tmax, K | CPU s |", "|---" * (len(SIZES) + 4) + "|"]
    for analytic, network in pairs(paths):
        cells = []
        for name in SIZES:
            known, ours = analytic["sizes"][name], network["sizes"][name]
            cells.append("" if known is None else f"{known:.3f} {100 * (ours / known - 1):+.2f} %")
        hottest = [run["descriptors"]["largest_temperature_K"] for run in (analytic, network)]
        cells.append(f"{hottest[0]:.0f} {hottest[1] - hottest[0]:+.0f}")
        cells.append(f"{analytic['cpu_s']:.1f}, {network['cpu_s']:.1f}")
        question = analytic["question"]
        first = f"| {question['shape'].replace('_', ' ')} | {question['velocity_m_s']:g} | "
        lines.append(first + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        write_text(snakemake.output[0], table(snakemake.input.impacts))  # noqa: F821
