"""Which impacts the studies of accuracy need."""

from impact_runs import SHAPES, files_of, run_name

VELOCITIES = [60, 90, 120]  # [m/s]
AXISYMMETRIC_ELEMENTS = [6, 8, 12, 16, 24]  # cells over the rear radius
SOLID_ELEMENTS = [4, 6]  # particles over the rear radius: 4k and 14k in all
# 46k particles, as many as the source paper's, where they cost minutes and not an hour.
FINE_SOLID = [(9, "uniform_cylinder", 90), (9, "reduced_head_4mm", 90)]
NOISE_SETTINGS = [("axisymmetric", 6, 8), ("axisymmetric", 12, 16), ("3d", 4, 1), ("3d", 4, 4)]
NOISE_SEEDS = range(1, 9)
NOISE_VELOCITY = 90
DISSIPATION_SETTINGS = [("axisymmetric", 12, 16), ("3d", 4, 1)]
DISSIPATION_CHANGES = ["", "viscosity0.5", "hourglass0.5"]
DISSIPATION_VELOCITY = 90
ENERGY_SETTINGS = [("axisymmetric", 6, 8), ("3d", 4, 1)]  # coarse
ENERGY_VELOCITY = 120


def axisymmetric_name(elements, shape, velocity):
    return run_name("axisymmetric", elements, 16, shape, velocity)


def solid_name(elements, shape, velocity):
    return run_name("3d", elements, 1, shape, velocity)


def convergence_cases(geometry):
    """(elements, shape, velocity) of a geometry."""
    levels = AXISYMMETRIC_ELEMENTS if geometry == "axisymmetric" else SOLID_ELEMENTS
    cases = [(n, shape, v) for n in levels for shape in SHAPES for v in VELOCITIES]
    return cases + (FINE_SOLID if geometry == "3d" else [])


def convergence_runs():
    return [axisymmetric_name(*case) for case in convergence_cases("axisymmetric")] + [
        solid_name(*case) for case in convergence_cases("3d")
    ]


def noise_name(setting, shape, seed):
    return run_name(*setting, shape, NOISE_VELOCITY, seed)


def noise_runs():
    return [
        noise_name(setting, shape, seed)
        for setting in NOISE_SETTINGS
        for shape in SHAPES
        for seed in NOISE_SEEDS
    ]


def dissipation_name(setting, shape, change):
    return run_name(*setting, shape, DISSIPATION_VELOCITY, 1, change)


def dissipation_runs():
    return [
        dissipation_name(setting, shape, change)
        for setting in DISSIPATION_SETTINGS
        for shape in SHAPES
        for change in DISSIPATION_CHANGES
    ]


def energy_name(setting, shape):
    return run_name(*setting, shape, ENERGY_VELOCITY)


def energy_runs():
    return [energy_name(setting, shape) for setting in ENERGY_SETTINGS for shape in SHAPES]


def runs_of_study(wildcards):
    """The answers that the study `wildcards.study` reads."""
    runs = {
        "convergence": convergence_runs,
        "noise": noise_runs,
        "dissipation": dissipation_runs,
        "energy": energy_runs,
    }
    return files_of(runs[wildcards.study]())
