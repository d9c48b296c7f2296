"""Which impacts the studies of accuracy need."""

from impact_runs import SHAPES, files_of, run_name

VELOCITIES = [60, 90, 120]  # [m/s]
EVERYWHERE = {shape: VELOCITIES for shape in SHAPES}
# Geometry, grains a point, cells or particles over the rear radius, and velocities. In 3D one
# grain is the source paper's choice; several tell what belongs to the geometry and what to
# the grains, and sixteen are as many as an axisymmetric cell has.
AT_90 = {shape: [90] for shape in SHAPES}
SERIES = [
    ("axisymmetric", 16, [5, 8, 12, 16], EVERYWHERE),
    ("3d", 1, [4, 6, 9], AT_90),
    ("3d", 4, [4, 6, 9], EVERYWHERE),
    ("3d", 4, [12], AT_90),
    ("3d", 16, [4, 6], AT_90),
]
# Sizes of single runs scatter by more than what is left of the mesh in fine cells, and by as
# much as parts the two geometries. Particles have several seeds where those are compared: as
# many across as `standard` and `fine` have, four grains each.
CELL_SEEDS = range(1, 7)
PARTICLE_SEEDS = range(1, 3)
COMPARED_PARTICLES = [6, 9]
NOISE_SETTINGS = [
    ("axisymmetric", 5, 8),
    ("axisymmetric", 8, 16),
    ("3d", 4, 1),
    ("3d", 4, 4),
    ("3d", 6, 4),  # as many particles as standard
]
NOISE_SEEDS = {"axisymmetric": range(1, 17), "3d": range(1, 5)}
NOISE_VELOCITY = 90
DISSIPATION_SETTINGS = [
    ("axisymmetric", 8, 16),
    ("3d", 4, 1),  # coarse
    ("3d", 6, 4),  # standard
    ("3d", 9, 4),  # fine
]
DISSIPATION_CHANGES = ["", "viscosity0.5", "hourglass0.5"]
DISSIPATION_VELOCITY = 90
DISSIPATION_SEEDS = {"axisymmetric": range(1, 7), "3d": range(1, 3)}
ENERGY_SETTINGS = [("axisymmetric", 5, 8), ("3d", 4, 1)]  # coarse
ENERGY_VELOCITY = 120


def convergence_cases(series):
    """(elements, shape, velocity) of one of SERIES."""
    *_, levels, velocities = series
    return [(n, shape, v) for n in levels for shape in velocities for v in velocities[shape]]


def convergence_names(series, case):
    """One a seed."""
    geometry, grains, *_ = series
    seeds = [1]
    if geometry == "axisymmetric":
        seeds = CELL_SEEDS
    elif grains == 4 and case[0] in COMPARED_PARTICLES:
        seeds = PARTICLE_SEEDS
    return [run_name(geometry, case[0], grains, *case[1:], seed) for seed in seeds]


def convergence_runs():
    return [
        name
        for series in SERIES
        for case in convergence_cases(series)
        for name in convergence_names(series, case)
    ]


def noise_name(setting, shape, seed):
    return run_name(*setting, shape, NOISE_VELOCITY, seed)


def noise_runs():
    return [
        noise_name(setting, shape, seed)
        for setting in NOISE_SETTINGS
        for shape in SHAPES
        for seed in NOISE_SEEDS[setting[0]]
    ]


def dissipation_names(setting, shape, change):
    """One a seed."""
    seeds = DISSIPATION_SEEDS[setting[0]]
    return [run_name(*setting, shape, DISSIPATION_VELOCITY, seed, change) for seed in seeds]


def dissipation_runs():
    return [
        name
        for setting in DISSIPATION_SETTINGS
        for shape in SHAPES
        for change in DISSIPATION_CHANGES
        for name in dissipation_names(setting, shape, change)
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
