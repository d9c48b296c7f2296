"""What the source paper states, and the impacts that answer it."""

from dataclasses import dataclass

from impact_runs import files_of, run_name

ELEMENTS, GRAINS = 12, 16
SOLID_ELEMENTS, SOLID_GRAINS = 6, 1


@dataclass(frozen=True)
class Statement:
    """A figure of the paper at optimum (ii), and the descriptor of our run that answers it.

    Of descriptors that the geometries define each in its own way, solver/impact/impact_result.hpp
    tells what they are.
    """

    shape: str
    velocity: float  # [m/s]
    what: str
    stated: str
    descriptor: str
    scale: float = 1.0


STATEMENTS = [
    Statement("uniform_cylinder", 117.6, "stop time, us", "about 70", "stop_time_us"),
    Statement("uniform_cylinder", 117.6, "largest temperature, K", "460", "largest_temperature_K"),
    Statement(
        "uniform_cylinder", 117.6, "mean von Mises stress, GPa", "0.35-0.45", "mean_von_mises_GPa"
    ),
    Statement(
        "uniform_cylinder",
        117.6,
        "peak radial strain rate, 1e4/s",
        "4",
        "peak_strain_rate_per_s",
        1e-4,
    ),
    Statement("uniform_cylinder", 86.9, "smallest grain, um", "5", "smallest_grain_um"),
    Statement(
        "uniform_cylinder",
        86.9,
        "largest weakened fraction, %",
        "3.6",
        "largest_weakened_fraction",
        100,
    ),
    Statement("reduced_head_4mm", 112.4, "stop time, us", "about 110", "stop_time_us"),
    Statement("reduced_head_4mm", 112.4, "largest temperature, K", "820", "largest_temperature_K"),
    Statement(
        "reduced_head_4mm",
        112.4,
        "peak radial strain rate, 1e4/s",
        "6.9",
        "peak_strain_rate_per_s",
        1e-4,
    ),
    Statement("reduced_head_3mm", 120, "stop time, us", "about 120", "stop_time_us"),
    Statement("reduced_head_3mm", 120, "largest temperature, K", "980", "largest_temperature_K"),
    Statement(
        "reduced_head_3mm", 120, "mean von Mises stress, GPa", "up to 0.9", "mean_von_mises_GPa"
    ),
    Statement(
        "reduced_head_3mm",
        120,
        "peak radial strain rate, 1e4/s",
        "10",
        "peak_strain_rate_per_s",
        1e-4,
    ),
    Statement("reduced_head_3mm", 122, "smallest grain, um", "0.7", "smallest_grain_um"),
    Statement(
        "reduced_head_3mm",
        122,
        "largest weakened fraction, %",
        "35",
        "largest_weakened_fraction",
        100,
    ),
    Statement("truncated_cone", 125, "stop time, us", "about 123", "stop_time_us"),
    Statement("truncated_cone", 125, "largest temperature, K", "1000", "largest_temperature_K"),
    Statement(
        "truncated_cone",
        125,
        "peak radial strain rate, 1e4/s",
        "10",
        "peak_strain_rate_per_s",
        1e-4,
    ),
]


def axisymmetric_name(shape, velocity):
    return run_name("axisymmetric", ELEMENTS, GRAINS, shape, velocity)


def solid_name(shape, velocity):
    return run_name("3d", SOLID_ELEMENTS, SOLID_GRAINS, shape, velocity)


def paper_cases():
    """(shape, velocity) in the order of the statements, each once."""
    return list(dict.fromkeys((s.shape, s.velocity) for s in STATEMENTS))


def paper_runs(wildcards):
    """The answers that the table and the figures read."""
    names = (axisymmetric_name, solid_name)
    return files_of(name(*case) for case in paper_cases() for name in names)
