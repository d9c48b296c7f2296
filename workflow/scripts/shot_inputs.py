"""The inputs of a run that belong to its shot and not to the material."""

SHOT_INPUTS = ["velocity_m_s", "initial_diameter_mm", "length_to_diameter"]
SHOT_INPUTS += ["initial_temperature_K"]
