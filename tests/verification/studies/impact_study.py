"""Which impacts the studies of accuracy need."""

from impact_runs import SHAPES, run_name

VELOCITIES = [60, 90, 120]  # [m/s]
AXISYMMETRIC_ELEMENTS = [6, 8, 12, 16, 24]  # cells over the rear radius
SOLID_ELEMENTS = [4, 6, 9]  # particles over the rear radius: 4k, 14k and 46k in all
NOISE_SETTINGS = [("axisymmetric", 6, 8), ("axisymmetric", 12, 16), ("3d", 4, 1), ("3d", 4, 8)]
NOISE_SEEDS = range(1, 9)
NOISE_VELOCITY = 90
DISSIPATION_SETTINGS = [("axisymmetric", 12, 16), ("3d", 6, 1)]
DISSIPATION_CHANGES = ["", "viscosity0.5", "hourglass0.5"]
DISSIPATION_VELOCITY = 90


def axisymmetric_name(elements, shape, velocity):
    return run_name("axisymmetric", elements, 16, shape, velocity)


def solid_name(elements, shape, velocity):
    return run_name("3d", elements, 1, shape, velocity)


def convergence_runs():
    cases = [(shape, velocity) for shape in SHAPES for velocity in VELOCITIES]
    return [axisymmetric_name(n, *case) for n in AXISYMMETRIC_ELEMENTS for case in cases] + [
        solid_name(n, *case) for n in SOLID_ELEMENTS for case in cases
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
