#!/usr/bin/python3
"""A sphere flattened between two rigid frictionless planes, with axisymmetric finite elements: the reference for 3D runs.

usage: axisymmetric_sphere.py [--edges N] [--approach SHARE] [--young E] [--poisson NU] [--yield-stress S]
                              [--hardening H] [--csv FILE]

Independent of Pulvis: four-node quads with one dilatation per element (mean dilatation), multiplicative J2 plasticity, a
quarter of the cross-section, explicit steps with mass scaling so that inertia is small, exact contact with the plane.
Prints approach of plane and centre over the radius, force over pi R^2 sigma_y, contact radius over R (area of the nodes
in contact). Literature for comparison: Mesarovic and Fleck, Int. J. Solids Struct. 37 (2000) 7071.
"""
import argparse

import numpy as np

GAUSS = np.array([(x, y) for y in (-1, 1) for x in (-1, 1)]) / np.sqrt(3)
CORNER = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])


def quarter_disc(n):
    """O-grid of the quarter of the unit disc: a core of n x n quads and n rings of 2 n; finer towards the pole (0, 1)."""
    # Core: a square with bulged sides. Rings: from its rim to the arc.
    nodes, quads, index = [], [], {}

    def node(p):
        key = (round(p[0], 9), round(p[1], 9))
        if key not in index:
            index[key] = len(nodes)
            nodes.append(p)
        return index[key]

    side = 0.5

    def core(u, v):
        bulge = 0.12
        return side * u * (1 + bulge * (1 - v * v)) if u else 0.0, side * v * (1 + bulge * (1 - u * u)) if v else 0.0

    grid = [[core(i / n, j / n) for j in range(n + 1)] for i in range(n + 1)]
    for i in range(n):
        for j in range(n):
            quads.append([node(grid[i][j]), node(grid[i + 1][j]), node(grid[i + 1][j + 1]), node(grid[i][j + 1])])
    rim = [grid[n][j] for j in range(n + 1)] + [grid[i][n] for i in range(n - 1, -1, -1)]
    for k in range(2 * n):
        ends = []
        for m in (k, k + 1):
            angle = np.pi / 2 * m / (2 * n)
            a, b = np.array(rim[m]), np.array([np.cos(angle), np.sin(angle)])
            if m == 2 * n:
                b[0] = 0.0
            if m == 0:
                b[1] = 0.0
            ends.append([a + (b - a) * s / n for s in range(n + 1)])
        for s in range(n):
            p, q = ends
            quads.append([node(tuple(p[s])), node(tuple(p[s + 1])), node(tuple(q[s + 1])), node(tuple(q[s]))])
    return np.array(nodes), np.array(quads)


class Body:
    """State of the section; r = x[:, 0], z = x[:, 1]. The nodal masses are the caller's."""

    def __init__(self, nodes, quads, young, poisson, yield_stress, hardening):
        self.X, self.quads = nodes, quads
        self.mu = young / (2 * (1 + poisson))
        self.bulk = young / (3 * (1 - 2 * poisson))
        self.yield_stress, self.hardening = yield_stress, hardening
        shapes = [0.25 * (1 + CORNER[:, 0] * g[0]) * (1 + CORNER[:, 1] * g[1]) for g in GAUSS]
        slopes = [np.stack([0.25 * CORNER[:, 0] * (1 + CORNER[:, 1] * g[1]),
                            0.25 * CORNER[:, 1] * (1 + CORNER[:, 0] * g[0])], 1) for g in GAUSS]
        self.N, self.dN = np.array(shapes), np.array(slopes)  # [4, 4], [4, 4, 2]
        X = self.X[self.quads]  # [e, 4, 2]
        J = np.einsum("eia,gib->egab", X, self.dN)
        self.slope = np.einsum("gib,egbc->egic", self.dN, np.linalg.inv(J))  # dN/dX
        self.R = np.einsum("gi,ei->eg", self.N, X[:, :, 0])
        self.dV = 2 * np.pi * self.R * np.linalg.det(J)
        assert (self.dV > 0).all()
        self.V = self.dV.sum(1)
        e = len(self.quads)
        self.inv_cp = np.tile(np.array([1.0, 1, 1, 0]), (e, 4, 1))  # rr zz tt rz
        self.eps = np.zeros((e, 4))
        self.smallest = np.linalg.det(J).min(1)  # of each element
        self.mass = np.zeros(len(self.X))
        self.x = self.X.copy()
        self.v = np.zeros_like(self.x)

    def add_masses(self, of_elements):
        """[elements, 4]: the masses of an element's corners."""
        for i in range(4):
            np.add.at(self.mass, self.quads[:, i], of_elements[:, i])

    def forces(self):
        x = self.x[self.quads]
        F2 = np.swapaxes(x, 1, 2)[:, None] @ self.slope
        r = x[:, :, 0] @ self.N.T
        ft = r / self.R
        det2 = F2[..., 0, 0] * F2[..., 1, 1] - F2[..., 0, 1] * F2[..., 1, 0]
        jac = det2 * ft
        dv = self.dV * jac
        theta = dv.sum(1) / self.V
        p = 0.5 * self.bulk * (theta - 1 / theta)
        j23 = jac ** (-2 / 3)
        a, b, c, d = F2[..., 0, 0], F2[..., 0, 1], F2[..., 1, 0], F2[..., 1, 1]
        crr, czz, ctt, crz = np.moveaxis(self.inv_cp, 2, 0)
        brr = j23 * (a * a * crr + 2 * a * b * crz + b * b * czz)
        bzz = j23 * (c * c * crr + 2 * c * d * crz + d * d * czz)
        brz = j23 * (a * c * crr + (a * d + b * c) * crz + b * d * czz)
        btt = j23 * ft * ft * ctt
        mean = (brr + bzz + btt) / 3
        s = np.stack([brr - mean, bzz - mean, btt - mean, brz], 2) * self.mu  # Kirchhoff, trial
        norm = np.sqrt(s[..., 0]**2 + s[..., 1]**2 + s[..., 2]**2 + 2 * s[..., 3]**2)
        flow = np.sqrt(2 / 3) * (self.yield_stress + self.hardening * self.eps) * jac  # on Kirchhoff stress
        over = norm - flow
        yields = over > 0
        mubar = self.mu * mean
        dgamma = np.where(yields, over / (2 * mubar + 2 / 3 * self.hardening * jac), 0)
        beta = np.where(yields, 1 - 2 * mubar * dgamma / np.maximum(norm, 1e-300), 1)
        s_new = s * beta[..., None]
        # det b = 1 gives the mean of the returned b.
        dev = s_new / self.mu
        q = 0.5 * (dev[..., 0]**2 + dev[..., 1]**2 + dev[..., 2]**2 + 2 * dev[..., 3]**2)
        det = (dev[..., 0] * dev[..., 1] - dev[..., 3]**2) * dev[..., 2]
        m = mean.copy()
        for _ in range(6):
            m = m - (m**3 - q * m + det - 1) / (3 * m * m - q)
        new = np.stack([dev[..., 0] + m, dev[..., 1] + m, dev[..., 2] + m, dev[..., 3]], 2)
        ia, ib, ic, idd = d / det2, -b / det2, -c / det2, a / det2
        k = 1 / j23
        self.trial = (np.stack([
            k * (ia * ia * new[..., 0] + 2 * ia * ib * new[..., 3] + ib * ib * new[..., 1]),
            k * (ic * ic * new[..., 0] + 2 * ic * idd * new[..., 3] + idd * idd * new[..., 1]),
            k * new[..., 2] / ft**2,
            k * (ia * ic * new[..., 0] + (ia * idd + ib * ic) * new[..., 3] + ib * idd * new[..., 1])], 2),
            self.eps + np.sqrt(2 / 3) * dgamma, yields)
        sig = s_new * (1 / jac)[..., None]
        srr, szz, stt = (sig[..., i] + p[:, None] for i in range(3))
        srz = sig[..., 3]
        inv_f = np.stack([np.stack([ia, ib], 2), np.stack([ic, idd], 2)], 2)
        slope = self.slope @ inv_f  # dN/dx [e, g, 4, 2]
        pull = np.stack([srr, srz, srz, szz], 2).reshape(*srr.shape, 2, 2) * dv[..., None, None]
        f = (slope @ pull).sum(1)  # [e, 4, 2]
        f[:, :, 0] += (stt * dv / r) @ self.N
        return np.stack([-np.bincount(self.quads.ravel(), f[:, :, k].ravel(), len(self.X)) for k in (0, 1)], 1)

    def keep(self):
        metric, eps, yields = self.trial
        self.inv_cp[yields] = metric[yields]
        self.eps = eps


def flatten(n, approach, young, poisson, yield_stress, hardening, steps):
    """Rows of approach/R, force/(pi R^2 sigma_y), contact radius/R. steps: number of steps for the whole approach."""
    body = Body(*quarter_disc(n), young, poisson, yield_stress, hardening)
    # Nodal masses are scaled to a uniform stable step: inertia only serves to reach equilibrium.
    body.add_masses(np.repeat((body.V / 4 * (body.bulk + 4 / 3 * body.mu) / body.smallest)[:, None], 4, axis=1))
    axis, equator = body.X[:, 0] < 1e-9, body.X[:, 1] < 1e-9
    dt, rows = 0.35, []
    # Time lag of the force: a hundred steps. The damping force on the whole body stays far below the contact force.
    damping, smoothing, force = 5e-4, 0.01, 0.0
    for step in range(steps):
        share = (step + 1) / steps
        plane = 1 - approach * share
        f = body.forces()
        body.keep()
        body.v = (1 - damping) * body.v + f / body.mass[:, None] * dt
        body.v[axis, 0] = 0
        body.v[equator, 1] = 0
        x = body.x + dt * body.v
        above = x[:, 1] > plane
        held = (x[above, 1] - plane) * body.mass[above] / dt**2  # momentum removed by the plane
        x[above, 1] = plane
        body.v[above, 1] = (plane - body.x[above, 1]) / dt
        body.x = x
        force += smoothing * (held.sum() - force)
        if (step + 1) % max(1, steps // 40) == 0:
            radius = body.x[above, 0].max() if above.any() else 0
            rows.append((1 - plane, force / (np.pi * yield_stress), radius))
    return np.array(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--edges", type=int, default=12, help="quads along a side of the core")
    parser.add_argument("--approach", type=float, default=0.2, help="of plane and centre, over the radius")
    parser.add_argument("--young", type=float, default=200e9)
    parser.add_argument("--poisson", type=float, default=0.3)
    parser.add_argument("--yield-stress", type=float, default=240e6)
    parser.add_argument("--hardening", type=float, default=440e6)
    parser.add_argument("--steps", type=int, default=40000)
    parser.add_argument("--csv")
    a = parser.parse_args()
    rows = flatten(a.edges, a.approach, a.young / a.yield_stress, a.poisson, 1.0, a.hardening / a.yield_stress, a.steps)
    lines = ["approach_over_R,force_over_pi_R2_sigma_y,contact_radius_over_R"]
    lines += [f"{r[0]:.5f},{r[1]:.5f},{r[2]:.4f}" for r in rows]
    print("\n".join(lines))
    if a.csv:
        with open(a.csv, "w", encoding="utf-8") as out:
            out.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
