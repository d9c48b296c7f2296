"""Paths of deformation for the comparison of a material point."""

import numpy as np

# Velocity gradients for a unit rate: what the metal of an impact undergoes.
MOTIONS = {
    "compression": np.diag([0.5, 0.5, -1.0]),
    "compression_with_volume_change": np.diag([0.45, 0.45, -1.0]),
    "shear": np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]),
    "shear_and_rotation": np.array([[0.0, 1.7, 0.3], [-0.7, 0.0, 0.2], [0.0, 0.1, 0.0]]),
    "rotation": np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.5], [0.0, -0.5, 0.0]]),
}

PARAMETER_SETS = {
    "published_optimum": {},
    "few_dislocations": {
        "rho_immobile_initial": 1e11,
        "hardening_coefficient": 4.7,
        "immobilization_velocity": 0.09,
    },
}


def random_orientation(seed):
    """A uniformly distributed unit quaternion w, x, y, z."""
    quaternion = np.random.default_rng(seed).normal(size=4)
    return (quaternion / np.linalg.norm(quaternion)).tolist()


def segment(gradient, strain, rate, outputs):
    return {
        "velocity_gradient_per_s": (rate * np.asarray(gradient)).tolist(),
        "duration_s": strain / rate,
        "outputs": outputs,
    }


def path_of(motion, rate, parameters, orientation, time_step=1e-9):
    """A path to a strain of 0.3 that shows the yield point in detail.

    A rotation needs a stress to turn: the metal is compressed before it.
    """
    gradient = MOTIONS[motion]
    first = MOTIONS["compression"] if motion == "rotation" else gradient
    return {
        "equation_of_state": "linear",
        "parameters": parameters,
        "orientation_quaternion_wxyz": orientation,
        "time_step_s": time_step,
        "segments": [segment(first, 0.03, rate, 15), segment(gradient, 0.27, rate, 27)],
    }
