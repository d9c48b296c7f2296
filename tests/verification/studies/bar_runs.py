"""Taylor bars with Johnson-Cook strength whose final sizes others have published."""

OFHC_COPPER = {  # The solver's own constants are Johnson and Cook's for OFHC copper.
    "size": "--diameter-mm 7.62 --length-mm 25.4",
    "material": {"strength": "johnson_cook"},
}
STEEL_42CRMO4 = {
    "size": "--diameter-mm 6.4 --length-mm 32.4 --temperature-K 293 --until-us 80",
    "material": {
        "strength": "johnson_cook",
        "equation_of_state": "linear",
        "initial_density": 7830,
        "poisson_ratio": 0.3,
        "bulk_modulus": 206e9 / (3 * (1 - 2 * 0.3)),
        "specific_heat": 460,
        "taylor_quinney": 0.9,
        "reference_temperature": 293,
        "jc_a": 806e6,
        "jc_b": 614e6,
        "jc_n": 0.168,
        "jc_c": 0.0089,
        "jc_m": 1.1,
        "jc_melting_temperature": 1813,
    },
}
BARS = {"ofhc_copper": OFHC_COPPER, "steel_42CrMo4": STEEL_42CRMO4}
SHOTS = [("ofhc_copper", 130), ("ofhc_copper", 146), ("ofhc_copper", 190), ("steel_42CrMo4", 287)]
FIDELITIES = {"axisymmetric": "standard", "3d": "coarse"}


def bar_words(bar, velocity, geometry, fidelity):
    """Arguments of `solver run`; one grain a point, as all would answer the same."""
    words = f"--velocity {velocity} {BARS[bar]['size']} --numerics grains_per_point=1"
    words += f" --geometry {geometry} --fidelity {fidelity}"
    settings = [f"--set {name}={value}" for name, value in BARS[bar]["material"].items()]
    return " ".join([words, *settings])


def arguments_of_bar(wildcards):
    geometry = wildcards.geometry
    return bar_words(wildcards.bar, wildcards.velocity, geometry, FIDELITIES[geometry])


def bar_stem(bar, velocity, geometry):
    """Where a bar's answer is: with .json and .h5."""
    return f"results/verification/bars/{bar}_v{velocity}_{geometry}"


def bar_files(wildcards):
    return [
        bar_stem(*shot, geometry) + suffix
        for shot in SHOTS
        for geometry in FIDELITIES
        for suffix in [".json", ".h5"]
    ]
