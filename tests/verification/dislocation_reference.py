"""A material point of the dislocation model by a stiff ODE integrator.

Written from the model's equations alone, as a check of the solver's own update: no step
splitting, no linearisation, the state in the lab frame. SI units. "Eq. n" is the number in
Rodionov et al., Materials 2023, 16, 5602 (doi 10.3390/ma16165602).

The equation of state is the linear one: P = K0 (rho/rho0 - 1) + 2 rho0 E, constant K0, so
that G is constant too, and T = T0 + E/cv.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

ELECTRONVOLT = 1.602176634e-19  # [J]

# The twelve fcc systems: unit plane normals n and slip directions b in the crystal frame.
_PLANES_AND_DIRECTIONS = [
    ((1, 1, 1), ((0, 1, -1), (1, 0, -1), (1, -1, 0))),
    ((-1, 1, 1), ((0, 1, -1), (1, 0, 1), (1, 1, 0))),
    ((1, -1, 1), ((0, 1, 1), (1, 0, -1), (1, 1, 0))),
    ((1, 1, -1), ((0, 1, 1), (1, 0, 1), (1, -1, 0))),
]


@dataclass(frozen=True)
class Parameters:
    """The constants of Table 1 and the published optimum, by the solver's names."""

    rho_immobile_initial: float = 6.3e12
    hardening_coefficient: float = 2.8
    immobilization_velocity: float = 0.4
    rho_mobile_initial: float = 1e11
    rho_mobile_free: float = 1e11
    burgers_vector: float = 0.2556e-9
    initial_yield_stress: float = 30e6
    annihilation_coefficient: float = 5
    drag_constant: float = 0.45e-5
    drag_slope: float = 2.5e-8
    dislocation_energy: float = 8
    taylor_quinney: float = 0.9
    initial_grain_diameter: float = 18e-6
    boundary_energy: float = 0.5
    boundary_energy_fraction: float = 0.5
    weakened_zone_diameter: float = 20e-6
    stacking_energy: float = 4.5
    atomic_density: float = 1e29
    initial_density: float = 8930
    poisson_ratio: float = 0.34
    bulk_modulus: float = 138e9
    specific_heat: float = 385
    reference_temperature: float = 300

    @property
    def shear_modulus(self):
        """G of Eq. 26 [Pa]."""
        mu = self.poisson_ratio
        return 1.5 * self.bulk_modulus * (1 - 2 * mu) / (1 + mu)


def schmid_tensors():
    """M^d = sym(b x n) of Eq. 8 in the crystal frame, 12 x 3 x 3."""
    tensors = []
    for plane, directions in _PLANES_AND_DIRECTIONS:
        n = np.array(plane) / np.sqrt(3)
        for direction in directions:
            b = np.array(direction) / np.sqrt(2)
            outer = np.outer(b, n)
            tensors.append((outer + outer.T) / 2)
    return np.array(tensors)


def slip_velocity(force, drag, sound_speed):
    """The root V of B V / (1 - V^2/ct^2)^(3/2) = X, Eqs. 12-14 [m/s]."""
    zeta = np.abs(force) / (sound_speed * drag)
    z = 2 / np.sqrt(3) * np.sinh(np.arcsinh(1.5 * np.sqrt(3) * zeta) / 3)
    ratio = np.divide(z, zeta, out=np.ones_like(z), where=zeta > 0)
    return np.sign(force) * sound_speed * zeta * ratio**1.5


class _State:
    """Where each variable is in the integrator's vector, and its scale."""

    elastic = slice(0, 9)  # u - tr(u)/3 - w, 3 x 3
    plastic = slice(9, 18)  # w, 3 x 3
    mobile = slice(18, 30)
    immobile = slice(30, 42)
    energy = 42  # E [J/kg]
    annihilated = 43  # J [J/m3]
    size = 44

    @classmethod
    def scales(cls):
        scale = np.ones(cls.size)
        scale[cls.elastic] = 1e-3
        scale[cls.plastic] = 1e-1
        scale[cls.mobile] = 1e11
        scale[cls.immobile] = 1e12
        scale[cls.energy] = 1e3
        scale[cls.annihilated] = 1e5
        return scale


class MaterialPoint:
    """The right-hand side of the model under one constant velocity gradient."""

    def __init__(self, parameters, velocity_gradient, orientation, density):
        self.p = parameters
        gradient = np.asarray(velocity_gradient, dtype=float)
        self.rate = (gradient + gradient.T) / 2
        self.spin = (gradient - gradient.T) / 2
        self.divergence = np.trace(gradient)
        self.orientation = orientation  # crystal to lab at the start
        self.initial_density = density
        self.crystal_tensors = schmid_tensors()

    def density(self, time):
        """Eq. 1 under a constant velocity gradient [kg/m3]."""
        return self.initial_density * np.exp(-self.divergence * time)

    def rotation(self, time):
        """The lattice orientation: dM/dt = W M - M W, solved exactly for constant W."""
        w = self.spin
        axis = np.array([w[2, 1], w[0, 2], w[1, 0]])
        return Rotation.from_rotvec(axis * time) * self.orientation

    def slip_resistance(self, immobile):
        """Taylor hardening Ys, Eq. 20 [Pa]."""
        p = self.p
        density = max(np.sum(immobile), 0.0)
        hardening = p.hardening_coefficient * p.shear_modulus * p.burgers_vector
        return p.initial_yield_stress + hardening * np.sqrt(density)

    def temperature(self, energy):
        return self.p.reference_temperature + energy / self.p.specific_heat

    def pressure(self, density, energy):
        p = self.p
        cold = p.bulk_modulus * (density / p.initial_density - 1)
        return cold + 2 * p.initial_density * energy

    def derivative(self, time, state):
        p = self.p
        b = p.burgers_vector
        elastic = state[_State.elastic].reshape(3, 3)
        plastic = state[_State.plastic].reshape(3, 3)
        mobile, immobile = state[_State.mobile], state[_State.immobile]
        energy = state[_State.energy]
        density = self.density(time)
        line_energy = p.dislocation_energy * ELECTRONVOLT  # for each b of length [J]

        lattice = self.rotation(time).as_matrix()
        tensors = lattice @ self.crystal_tensors @ lattice.T
        deviator = 2 * p.shear_modulus * elastic  # Eq. 4
        force = b * np.einsum("dij,ij->d", tensors, deviator)  # Eq. 11
        threshold = b * self.slip_resistance(immobile) / 2
        excess = np.maximum(np.abs(force) - threshold, 0) * np.sign(force)
        drag = p.drag_constant + p.drag_slope * self.temperature(energy)
        velocity = slip_velocity(excess, drag, np.sqrt(p.shear_modulus / density))

        plastic_rate = b * np.einsum("dij,d->ij", tensors, mobile * velocity)  # Eq. 9
        deviatoric_rate = self.rate - self.divergence / 3 * np.eye(3)

        speed = np.abs(velocity)
        # Eqs. 17-19; the multiplying force is the effective one.
        multiplied = (1 - p.taylor_quinney) / line_energy * b * mobile
        multiplied = multiplied * np.abs(excess * velocity)
        immobilized = p.immobilization_velocity * (mobile - p.rho_mobile_free)
        immobilized = immobilized * np.sqrt(np.maximum(immobile, 0))
        annihilation = p.annihilation_coefficient * b * speed * mobile
        pairs, with_immobile = 2 * annihilation * mobile, annihilation * immobile

        change = np.empty(_State.size)
        turned = self.spin @ elastic - elastic @ self.spin  # Eqs. 5-7
        change[_State.elastic] = (deviatoric_rate - plastic_rate + turned).ravel()
        turned = self.spin @ plastic - plastic @ self.spin
        change[_State.plastic] = (plastic_rate + turned).ravel()
        change[_State.mobile] = (  # Eq. 15
            multiplied - immobilized - pairs - with_immobile - mobile * self.divergence
        )
        # Eq. 16
        change[_State.immobile] = immobilized - with_immobile - immobile * self.divergence
        heating = p.taylor_quinney * np.sum(deviator * plastic_rate)
        change[_State.energy] = (
            heating - self.pressure(density, energy) * self.divergence
        ) / density  # Eq. 3
        # Eq. 21
        change[_State.annihilated] = line_energy / b * np.sum(pairs + 2 * with_immobile)
        return change

    def observe(self, time, state):
        """The columns of `solver point` but the time."""
        p = self.p
        deviator = 2 * p.shear_modulus * state[_State.elastic].reshape(3, 3)
        plastic = state[_State.plastic].reshape(3, 3)
        annihilated = state[_State.annihilated]
        finer = p.boundary_energy_fraction * annihilated / (3 * p.boundary_energy)
        stacked = (1 - p.boundary_energy_fraction) * annihilated
        energy_of_weak = 6 * p.burgers_vector * p.stacking_energy * ELECTRONVOLT * p.atomic_density
        return {
            "von_mises_Pa": np.sqrt(1.5 * np.sum(deviator**2)),
            "stress_deviator_xx_Pa": deviator[0, 0],
            "stress_deviator_yy_Pa": deviator[1, 1],
            "stress_deviator_zz_Pa": deviator[2, 2],
            "stress_deviator_xy_Pa": deviator[0, 1],
            "stress_deviator_xz_Pa": deviator[0, 2],
            "stress_deviator_yz_Pa": deviator[1, 2],
            "temperature_K": self.temperature(state[_State.energy]),
            "mobile_density_m2": np.sum(state[_State.mobile]),
            "immobile_density_m2": np.sum(state[_State.immobile]),
            "slip_resistance_Pa": self.slip_resistance(state[_State.immobile]),
            "equivalent_plastic_strain": np.sqrt(2 / 3 * np.sum(plastic**2)),
            "grain_diameter_m": 1 / (1 / p.initial_grain_diameter + finer),  # Eq. 22
            "weakened_fraction": p.weakened_zone_diameter * stacked / energy_of_weak,
            "annihilated_energy_J_m3": annihilated,
        }


def reference_curve(path, tolerance=1e-7, method="LSODA"):
    """Integrates a path of `solver point` (the same dictionary as its JSON file).

    Returns {column: array} with a row at duration * k/outputs, k = 1..outputs, of each
    segment.
    """
    if path["equation_of_state"] != "linear":
        raise ValueError("the reference knows the linear equation of state only")
    parameters = Parameters(**path["parameters"])
    w, x, y, z = path["orientation_quaternion_wxyz"]
    orientation = Rotation.from_quat([x, y, z, w])
    scale = _State.scales()
    state = np.zeros(_State.size)
    state[_State.mobile] = parameters.rho_mobile_initial
    state[_State.immobile] = parameters.rho_immobile_initial
    density, start, rows = parameters.initial_density, 0.0, []
    for segment in path["segments"]:
        gradient = segment["velocity_gradient_per_s"]
        point = MaterialPoint(parameters, gradient, orientation, density)
        duration = segment["duration_s"]
        shares = np.arange(1, segment["outputs"] + 1) / segment["outputs"]
        solution = solve_ivp(
            lambda t, y: point.derivative(t * duration, y * scale) * duration / scale,
            (0.0, 1.0),
            state / scale,
            method=method,
            t_eval=shares,
            rtol=tolerance,
            atol=tolerance,
        )
        if not solution.success:
            raise RuntimeError(f"the reference integration failed: {solution.message}")
        for time, scaled in zip(duration * shares, solution.y.T):
            rows.append({"time_s": start + time, **point.observe(time, scaled * scale)})
        state = solution.y[:, -1] * scale
        orientation, density = point.rotation(duration), point.density(duration)
        start += duration
    return {column: np.array([row[column] for row in rows]) for column in rows[0]}
