"""Flyer plate experiments: the measured one, and the source paper's three velocities.

A name such as `paper_152_6.3e12` is the experiment, the velocity [m/s] and the initial density of
immobilized dislocations per slip system [1/m2].
"""

DENSITIES = ["1e11", "6.3e12"]
MEASURED = "measured_308"
PAPER = ["paper_152", "paper_266", "paper_355"]
THICKNESSES_MM = {"measured": (1.78, 4.00), "paper": (0.56, 2.47)}  # of flyer and target
DURATION_US = {"measured": 2.2, "paper": 1.2}


def plate_document(wildcards):
    """plate.json of the experiment `wildcards.plate`."""
    experiment, velocity, density = wildcards.plate.split("_")
    flyer, target = THICKNESSES_MM[experiment]
    return {
        "flyer_thickness_mm": flyer,
        "target_thickness_mm": target,
        "velocity_m_s": float(velocity),
        "duration_us": DURATION_US[experiment],
        "material": {"rho_immobile_initial": float(density)},
    }


def plate_file(experiment, density):
    return f"results/verification/plates/{experiment}_{density}.csv"


def plate_files(wildcards):
    """The velocities that the figure shows."""
    return [
        plate_file(experiment, density)
        for experiment in [MEASURED, *PAPER]
        for density in DENSITIES
    ]
