"""Taylor impact of a bar with a reduced head by axisymmetric finite elements.

An independent answer for `solver run`, with which it shares no code and no discretisation: fully
integrated four-node elements (two by two points; F-bar, de Souza Neto et al. 1996, doi
10.1016/0020-7683(95)00259-6, with the element's mean volume), multiplicative J2 plasticity with
linear hardening in logarithmic strains, and a shoulder that meets the head's flank by penalty,
frictionless.

    /usr/bin/python3 tests/verification/studies/finite_elements.py > table.csv
"""

import argparse
import csv
import sys
from dataclasses import dataclass

import numpy as np

DENSITY = 8930.0  # kg/m3
BULK_MODULUS = 138e9  # Pa
POISSON_RATIO = 0.34
SHEAR_MODULUS = 1.5 * BULK_MODULUS * (1 - 2 * POISSON_RATIO) / (1 + POISSON_RATIO)
GRUNEISEN = 2.0
HEATING_SHARE = 0.9  # of plastic work
METALS = {"hard": (350e6, 300e6), "soft": (100e6, 500e6)}  # yield stress, hardening modulus [Pa]
CASES = [("hard", 50), ("hard", 90), ("soft", 90)]  # metals and velocities [m/s]

HEAD_RADIUS, HEAD_LENGTH = 2e-3, 10e-3  # m
REAR_RADIUS, LENGTH = 4e-3, 40e-3  # m

LINEAR_VISCOSITY, QUADRATIC_VISCOSITY = 0.06, 1.2
COURANT = 0.5
PENALTY = 1.0  # contact stiffness over bulk modulus by element size
SAMPLES = 4  # of contact on a segment
RINGING = 10e-6, 30e-6  # after the stop: sizes are means over this time, about one period [s]
FOOT = 2e-3  # height that is read as the foot [m]
SIZES = ["final_length_mm", "head_length_mm", "impact_diameter_mm", "transition_diameter_mm"]


def graded(start, end, first, ratio, largest):
    """Nodes from start to end whose spacing grows from `first` by `ratio` up to `largest`."""
    nodes, spacing = [start], first
    while nodes[-1] < end - 1e-9:
        nodes.append(nodes[-1] + spacing)
        spacing = min(spacing * ratio, largest)
    nodes = np.array(nodes)
    return start + (nodes - start) * (end - start) / (nodes[-1] - start)


@dataclass
class Mesh:
    """Reference nodes, the elements' corners, and what each integration point needs.

    Integration points run along the second axis of (elements, 4) arrays; the derivatives of the
    shape functions are (elements, 4 points, 4 corners).
    """

    radius: np.ndarray  # (nodes,)
    height: np.ndarray
    corners: np.ndarray  # (elements, 4), counter-clockwise
    along_radius: np.ndarray  # dN/dR [1/m]
    along_height: np.ndarray  # dN/dZ
    shape: np.ndarray  # N, (4 points, 4 corners)
    point_radius: np.ndarray  # (elements, 4)
    volume: np.ndarray  # (elements, 4), of the whole ring [m3]
    flank: np.ndarray  # nodes of the head's side, upwards
    shoulder: np.ndarray  # nodes of the step, outwards


def make_mesh(columns):
    """A mesh with `columns` elements across the head's radius, square in the head."""
    size = HEAD_RADIUS / columns
    radii = np.r_[
        np.linspace(0, HEAD_RADIUS, columns + 1)[:-1],
        graded(HEAD_RADIUS, REAR_RADIUS, size, 1.1, 2 * size),
    ]
    heights = np.r_[
        np.linspace(0, HEAD_LENGTH, round(HEAD_LENGTH / size) + 1)[:-1],
        graded(HEAD_LENGTH, LENGTH, size, 1.04, 4 * size),
    ]
    in_head = np.searchsorted(heights, HEAD_LENGTH - 1e-9)
    number, nodes, corners = {}, [], []
    for j in range(len(heights) - 1):
        for i in range(len(radii) - 1):
            if j < in_head and i >= columns:
                continue
            element = []
            for place in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                if place not in number:
                    number[place] = len(nodes)
                    nodes.append((radii[place[0]], heights[place[1]]))
                element.append(number[place])
            corners.append(element)
    radius, height = np.array(nodes).T
    corners = np.array(corners)

    place = 1 / np.sqrt(3)
    s = place * np.array([-1, 1, 1, -1])[:, None]
    t = place * np.array([-1, -1, 1, 1])[:, None]
    corner_s, corner_t = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    shape = (1 + s * corner_s) * (1 + t * corner_t) / 4
    along_s = corner_s * (1 + t * corner_t) / 4
    along_t = corner_t * (1 + s * corner_s) / 4
    r_s, z_s = radius[corners] @ along_s.T, height[corners] @ along_s.T
    r_t, z_t = radius[corners] @ along_t.T, height[corners] @ along_t.T
    area = r_s * z_t - r_t * z_s
    point_radius = radius[corners] @ shape.T
    return Mesh(
        radius,
        height,
        corners,
        (z_t[..., None] * along_s - z_s[..., None] * along_t) / area[..., None],
        (r_s[..., None] * along_t - r_t[..., None] * along_s) / area[..., None],
        shape,
        point_radius,
        2 * np.pi * point_radius * area,
        np.array([number[columns, j] for j in range(in_head + 1)]),
        np.array([number[i, in_head] for i in range(columns, len(radii))]),
    )


class Bar:
    """A bar of one of METALS that hits a rigid anvil at height 0 at `velocity` [m/s]."""

    def __init__(self, columns, velocity, metal):
        self.yield_stress, self.hardening_modulus = METALS[metal]
        self.mesh = mesh = make_mesh(columns)
        self.size = HEAD_RADIUS / columns
        self.r, self.z = mesh.radius.copy(), mesh.height.copy()
        self.vr, self.vz = np.zeros_like(self.r), np.full_like(self.z, -velocity)
        self.mass = self.gathered(DENSITY * mesh.volume @ mesh.shape)
        # Inverse plastic metric: rr, zz, hoop, rz.
        self.metric = [np.ones_like(mesh.volume) for _ in range(3)] + [np.zeros_like(mesh.volume)]
        self.plastic_strain = np.zeros_like(mesh.volume)
        self.heat = np.zeros_like(mesh.volume)  # J/m3
        self.step = 0.0

    def gathered(self, at_corners):
        """Sums of (elements, 4 corners) at the nodes."""
        return np.bincount(self.mesh.corners.ravel(), at_corners.ravel(), len(self.mesh.radius))

    def gradient(self, values):
        """d/dR and d/dZ of a nodal field at the integration points."""
        at_corners = values[self.mesh.corners][:, None, :]
        return (
            (self.mesh.along_radius * at_corners).sum(-1),
            (self.mesh.along_height * at_corners).sum(-1),
        )

    def shear_stress(self, rr, rz, zr, zz, hoop):
        """Kirchhoff deviator (rr, zz, rz, hoop) after radial return, for the gradient F."""
        c_rr, c_zz, c_hoop, c_rz = self.metric
        left_r, left_z = rr * c_rr + rz * c_rz, rr * c_rz + rz * c_zz
        b_rr, b_rz = left_r * rr + left_z * rz, left_r * zr + left_z * zz
        b_zz = zr * (c_rr * zr + c_rz * zz) + zz * (c_rz * zr + c_zz * zz)
        b_hoop = hoop**2 * c_hoop
        middle, half = (b_rr + b_zz) / 2, (b_rr - b_zz) / 2
        spread = np.hypot(half, b_rz)
        angle = np.arctan2(b_rz, half) / 2
        cosine, sine = np.cos(angle), np.sin(angle)
        strain = np.log(np.array([middle + spread, middle - spread, b_hoop])) / 2
        mean = strain.mean(0)
        stress = 2 * SHEAR_MODULUS * (strain - mean)
        equivalent = np.sqrt(1.5 * (stress**2).sum(0))
        flow = self.yield_stress + self.hardening_modulus * self.plastic_strain
        stiffness = 3 * SHEAR_MODULUS + self.hardening_modulus
        slip = np.maximum(equivalent - flow, 0) / stiffness
        kept = 1 - 3 * SHEAR_MODULUS * slip / np.maximum(equivalent, 1.0)
        self.plastic_strain += slip
        self.heat += HEATING_SHARE * (flow + self.hardening_modulus * slip) * slip
        stress = stress * kept

        b_1, b_2, b_hoop = np.exp(2 * (mean + (strain - mean) * kept))
        b_rr, b_zz = cosine**2 * b_1 + sine**2 * b_2, sine**2 * b_1 + cosine**2 * b_2
        b_rz = cosine * sine * (b_1 - b_2)
        det = rr * zz - rz * zr
        i_rr, i_rz, i_zr, i_zz = zz / det, -rz / det, -zr / det, rr / det
        row_r, row_z = b_rr * i_rr + b_rz * i_rz, b_rz * i_rr + b_zz * i_rz
        self.metric = [
            i_rr * row_r + i_rz * row_z,
            i_zr * (b_rr * i_zr + b_rz * i_zz) + i_zz * (b_rz * i_zr + b_zz * i_zz),
            b_hoop / hoop**2,
            i_zr * row_r + i_zz * row_z,
        ]
        return (
            cosine**2 * stress[0] + sine**2 * stress[1],
            sine**2 * stress[0] + cosine**2 * stress[1],
            cosine * sine * (stress[0] - stress[1]),
            stress[2],
        )

    def internal_forces(self):
        """Nodal forces (radial, axial) of the stresses, and the next stable time step."""
        mesh = self.mesh
        (rr, rz), (zr, zz) = self.gradient(self.r), self.gradient(self.z)
        now = self.r[mesh.corners] @ mesh.shape.T
        hoop = now / mesh.point_radius
        det = rr * zz - rz * zr
        change = det * hoop
        mean_change = (change * mesh.volume).sum(1) / mesh.volume.sum(1)
        bar = np.cbrt(mean_change[:, None] / change)
        s_rr, s_zz, s_rz, s_hoop = self.shear_stress(
            rr * bar, rz * bar, zr * bar, zz * bar, hoop * bar
        )
        pressure = (
            BULK_MODULUS * (1 / mean_change[:, None] - 1) + GRUNEISEN * self.heat
        ) * mean_change[:, None]

        (v_rr, v_rz), (v_zr, v_zz) = self.gradient(self.vr), self.gradient(self.vz)
        dilation = (v_rr * zz - v_rz * zr - v_zr * rz + v_zz * rr) / det
        dilation += self.vr[mesh.corners] @ mesh.shape.T / now
        corner_r, corner_z = self.r[mesh.corners], self.z[mesh.corners]
        diagonals = corner_r[:, [2, 3]] - corner_r[:, [0, 1]], (
            corner_z[:, [2, 3]] - corner_z[:, [0, 1]]
        )
        area = np.abs(
            diagonals[0][:, 0] * diagonals[1][:, 1] - diagonals[0][:, 1] * diagonals[1][:, 0]
        )
        longest = np.hypot(*diagonals).max(1)
        narrowest = area / 2 / longest
        sound = np.sqrt((BULK_MODULUS + 4 * SHEAR_MODULUS / 3) / DENSITY)
        width = narrowest[:, None]
        viscous = (
            DENSITY
            * width
            * dilation
            * (LINEAR_VISCOSITY * sound + QUADRATIC_VISCOSITY * width * np.maximum(-dilation, 0))
        )

        mean = viscous - pressure
        s_rr, s_zz, s_hoop = s_rr + mean, s_zz + mean, s_hoop + mean
        per_det = mesh.volume / det
        # First Piola-Kirchhoff stress times volume: tau F^-T.
        p_rr, p_rz = per_det * (s_rr * zz - s_rz * rz), per_det * (s_rz * rr - s_rr * zr)
        p_zr, p_zz = per_det * (s_rz * zz - s_zz * rz), per_det * (s_zz * rr - s_rz * zr)
        radial = (p_rr[..., None] * mesh.along_radius + p_rz[..., None] * mesh.along_height).sum(1)
        axial = (p_zr[..., None] * mesh.along_radius + p_zz[..., None] * mesh.along_height).sum(1)
        radial += (s_hoop * mesh.volume / now) @ mesh.shape
        return -self.gathered(radial), -self.gathered(axial), COURANT * narrowest.min() / sound

    def add_contact(self, force_r, force_z):
        """Penalty forces between the flank and the shoulder, where one is inside the other."""
        share = (np.arange(SAMPLES) + 0.5) / SAMPLES
        for own, other in (
            (self.mesh.flank, self.mesh.shoulder),
            (self.mesh.shoulder, self.mesh.flank),
        ):
            first, last = np.repeat(own[:-1], SAMPLES), np.repeat(own[1:], SAMPLES)
            s = np.tile(share, len(own) - 1)
            r = (1 - s) * self.r[first] + s * self.r[last]
            z = (1 - s) * self.z[first] + s * self.z[last]
            edge = np.hypot(self.r[last] - self.r[first], self.z[last] - self.z[first])
            a, b = other[:-1], other[1:]
            edge_r, edge_z = self.r[b] - self.r[a], self.z[b] - self.z[a]
            square = edge_r**2 + edge_z**2
            from_r, from_z = r[:, None] - self.r[a], z[:, None] - self.z[a]
            along = (from_r * edge_r + from_z * edge_z) / square
            gap = (from_r * edge_z - from_z * edge_r) / np.sqrt(square)
            inside = (along >= 0) & (along <= 1) & (gap < 0) & (gap > -self.size)
            shallowest = np.where(inside, gap, -np.inf).argmax(1)
            sample = np.flatnonzero(inside.any(1))
            if not len(sample):
                continue
            k = shallowest[sample]
            push = -gap[sample, k] * PENALTY * BULK_MODULUS / self.size
            push *= np.pi * r[sample] * edge[sample] / SAMPLES  # half: the other pass as well
            push_r = push * (edge_z / np.sqrt(square))[k]
            push_z = -push * (edge_r / np.sqrt(square))[k]
            at = along[sample, k]
            for nodes, weight in (
                (first[sample], 1 - s[sample]),
                (last[sample], s[sample]),
                (a[k], at - 1),
                (b[k], -at),
            ):
                np.add.at(force_r, nodes, weight * push_r)
                np.add.at(force_z, nodes, weight * push_z)

    def advance(self):
        """One time step; returns it [s]."""
        force_r, force_z, stable = self.internal_forces()
        self.add_contact(force_r, force_z)
        self.step = min(stable, 1.05 * self.step) if self.step else stable
        self.vr += force_r / self.mass * self.step
        self.vz += force_z / self.mass * self.step
        self.vr[self.mesh.radius == 0] = 0
        through = self.z + self.vz * self.step < 0
        self.vz[through] = -self.z[through] / self.step
        self.r += self.vr * self.step
        self.z += self.vz * self.step
        return self.step

    def plane(self, height, radius):
        """Mean height of a material plane within a radius, weighted by reference area [m]."""
        on = np.flatnonzero(
            (np.abs(self.mesh.height - height) < 1e-9) & (self.mesh.radius < radius + 1e-9)
        )
        on = on[np.argsort(self.mesh.radius[on])]
        r, z = self.mesh.radius[on], self.z[on]
        # Integral of 2 r z(r) of a piecewise linear z.
        slope = np.diff(z) / np.diff(r)
        pieces = (z[:-1] - slope * r[:-1]) * np.diff(r**2) + slope * np.diff(r**3) * 2 / 3
        return pieces.sum() / r[-1] ** 2

    def sizes(self):
        """SIZES as `solver run` defines them [mm]."""
        face = self.plane(0.0, HEAD_RADIUS)
        flank = self.mesh.flank[:-1]
        return [
            1e3 * (self.plane(LENGTH, REAR_RADIUS) - face),
            1e3 * (self.plane(HEAD_LENGTH, HEAD_RADIUS) - face),
            2e3 * self.r[flank][self.z[flank] < FOOT].max(),
            2e3 * self.r[self.mesh.shoulder[0]],
        ]

    def outline(self):
        """Height and radius of the free surface from foot to rear [mm], (nodes, 2)."""
        side = np.flatnonzero(self.mesh.radius > REAR_RADIUS - 1e-9)
        side = side[np.argsort(self.mesh.height[side])]
        nodes = np.r_[self.mesh.flank, self.mesh.shoulder[1:-1], side]
        return 1e3 * np.column_stack([self.z[nodes] - self.plane(0.0, HEAD_RADIUS), self.r[nodes]])


def impact(columns, velocity, metal):
    """SIZES of a bar that has stopped, means over one period of its ringing, and the bar."""
    bar = Bar(columns, velocity, metal)
    since_stop, weights, readings = None, [], []
    while since_stop is None or since_stop < RINGING[1]:
        step = bar.advance()
        if since_stop is None:
            if bar.mass @ bar.vz > 0:
                since_stop = 0.0
            continue
        since_stop += step
        if since_stop > RINGING[0]:
            weights.append(step)
            readings.append(bar.sizes())
    return dict(zip(SIZES, np.average(readings, axis=0, weights=weights))), bar


def computed(table, metal, velocity, columns):
    """SIZES in a row of a table that this program has printed."""
    case = {"metal": metal, "velocity_m_s": str(velocity), "columns_in_head": str(columns)}
    with open(table, newline="") as file:
        for row in csv.DictReader(file):
            if case.items() <= row.items():
                return {name: float(row[name]) for name in SIZES}
    raise LookupError(f"{table} has no row for {case}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--columns", type=int, nargs="+", default=[4, 8, 12])
    arguments = parser.parse_args()
    table = csv.DictWriter(
        sys.stdout, ["metal", "velocity_m_s", "columns_in_head", *SIZES], lineterminator="\n"
    )
    table.writeheader()
    for metal, velocity in CASES:
        for columns in arguments.columns:
            sizes, _ = impact(columns, velocity, metal)
            row = {"metal": metal, "velocity_m_s": velocity, "columns_in_head": columns}
            table.writerow(row | {name: f"{size:.4f}" for name, size in sizes.items()})
            sys.stdout.flush()


if __name__ == "__main__":
    main()
