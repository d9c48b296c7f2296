"""Entries as `solver effects --json` and `solver parameters --json` give them."""


def effect(name: str, **changes) -> dict:
    entry = {
        "name": name,
        "symbol": "k",
        "equation": "tau = k p",
        "unit": "1",
        "lowest": 0.0,
        "highest": 0.5,
        "prior": {"kind": "half_normal", "scale": 0.15},
        "signed": False,
        "typical": 0.1,
        "acts_on": "anvil",
        "geometries": ["axisymmetric", "3d"],
        "description": "what it does",
        "source": "a paper",
    }
    return {**entry, **changes}


EFFECTS = {
    entry["name"]: entry
    for entry in [
        effect("anvil_friction"),
        effect("phonon_drag", lowest=-0.8, highest=2.0, signed=True, typical=0.4),
        effect("oblique_impact", geometries=["3d"]),
    ]
}

CONSTANTS = {
    "initial_yield_stress": (30e6, "Pa"),
    "annihilation_coefficient": (5.0, "1"),
    "rho_mobile_initial": (1e11, "1/m2"),
    "drag_slope": (2.5e-8, "Pa s/K"),
    "poisson_ratio": (0.34, "1"),
    "dislocation_energy": (8.0, "eV"),
}
PARAMETERS = {
    name: {
        "name": name,
        "symbol": "c",
        "unit": unit,
        "default": value,
        "description": "a constant",
        "source": "Table 1",
    }
    for name, (value, unit) in CONSTANTS.items()
}
