"""The casing of gas_turbine.mechanism: a lattice of beams, reduced to its stations and twelve modes between them.

    python gas_turbine_casing.py

writes gas_turbine_casing_mass.mtx and gas_turbine_casing_stiffness.mtx beside itself (SI units; numpy only). The lattice
stands for the finite element model of a real casing, which any program that reduces to retained nodes would supply.
"""

import pathlib

import numpy as np

MODULUS, POISSON, DENSITY = 190e9, 0.3, 7850.0
AROUND = 8  # longitudinal members of the barrel
MODES = 12

# Rings of the barrel: place along the axis, radius [m], and what vanes, liners and manifolds weigh there [kg].
RINGS = [
    (0.230, 0.42, 50.0),  # intake, front bearing
    (0.420, 0.36, 60.0),  # compressor
    (0.620, 0.34, 60.0),
    (0.860, 0.40, 70.0),  # diffuser
    (1.080, 0.47, 110.0),  # combustor
    (1.300, 0.45, 90.0),  # turbine
    (1.585, 0.44, 60.0),  # exhaust, rear bearing
]
HOUSINGS = [(0, 24.0), (6, 28.0)]  # ring and mass [kg] of the bearing housings
FEET = [(0, 0.50, -0.75, 0.100), (5, 0.52, -0.75, 0.030)]  # ring, y, z, and thickness of the legs along the axis [m]


class Section:
    """A rectangle; `thickness` is along the normal of a member."""

    def __init__(self, width, thickness):
        a, b = max(width, thickness), min(width, thickness)
        self.area = width * thickness
        self.along_normal = width * thickness**3 / 12  # resists bending along the normal
        self.sideways = thickness * width**3 / 12
        self.torsion = a * b**3 * (1 / 3 - 0.21 * b / a * (1 - (b / a) ** 4 / 12))


def member(p, q, normal, section):
    """Stiffness and mass of a beam between two points in global axes: an Euler-Bernoulli beam, consistent mass."""
    length = np.linalg.norm(q - p)
    x = (q - p) / length
    n = normal - x * (normal @ x)
    n /= np.linalg.norm(n)
    axes = np.array([x, n, np.cross(x, n)])
    stiffness, mass = np.zeros((12, 12)), np.zeros((12, 12))

    rod, share = np.array([[1, -1], [-1, 1]]) / length, np.array([[2, 1], [1, 2]]) * length / 6
    shear = MODULUS / (2 * (1 + POISSON))
    polar = section.along_normal + section.sideways
    for rows, rigid, heavy in [
        ([0, 6], MODULUS * section.area, section.area),
        ([3, 9], shear * section.torsion, polar),
    ]:
        stiffness[np.ix_(rows, rows)] = rigid * rod
        mass[np.ix_(rows, rows)] = DENSITY * heavy * share

    a = length
    bend = np.array([[12, 6 * a, -12, 6 * a], [6 * a, 4 * a * a, -6 * a, 2 * a * a],
                     [-12, -6 * a, 12, -6 * a], [6 * a, 2 * a * a, -6 * a, 4 * a * a]]) / a**3
    heavy = np.array([[156, 22 * a, 54, -13 * a], [22 * a, 4 * a * a, 13 * a, -3 * a * a],
                      [54, 13 * a, 156, -22 * a], [-13 * a, -3 * a * a, -22 * a, 4 * a * a]]) * a / 420
    # Deflection along the normal turns about the third axis; sideways it turns about the normal, the other way.
    for rows, sign, inertia in [([1, 5, 7, 11], 1, section.along_normal), ([2, 4, 8, 10], -1, section.sideways)]:
        turned = np.diag([1, sign, 1, sign])
        stiffness[np.ix_(rows, rows)] = MODULUS * inertia * turned @ bend @ turned
        mass[np.ix_(rows, rows)] = DENSITY * section.area * turned @ heavy @ turned

    to_local = np.kron(np.eye(4), axes)
    return to_local.T @ stiffness @ to_local, to_local.T @ mass @ to_local


class Lattice:
    def __init__(self):
        self.nodes, self.members, self.masses = [], [], []

    def node(self, *place):
        self.nodes.append(np.array(place, float))
        return len(self.nodes) - 1

    def join(self, a, b, normal, section, pieces=1):
        """Members in a line from node to node."""
        ends = np.linspace(self.nodes[a], self.nodes[b], pieces + 1)[1:-1]
        chain = [a, *(self.node(*place) for place in ends), b]
        for pair in zip(chain[:-1], chain[1:]):
            self.members.append((*pair, np.array(normal, float), section))

    def matrices(self):
        order = 6 * len(self.nodes)
        stiffness, mass = np.zeros((order, order)), np.zeros((order, order))
        for a, b, normal, section in self.members:
            k, m = member(self.nodes[a], self.nodes[b], normal, section)
            rows = np.r_[6 * a : 6 * a + 6, 6 * b : 6 * b + 6]
            stiffness[np.ix_(rows, rows)] += k
            mass[np.ix_(rows, rows)] += m
        for node, heavy, radius in self.masses:
            rows = range(6 * node, 6 * node + 6)
            mass[rows, rows] += heavy * np.array([1, 1, 1, radius**2, radius**2, radius**2])
        return stiffness, mass


def casing():
    """The lattice, and its stations: two bearing housings, then feet in front and behind, right and left."""
    lattice = Lattice()
    stringer, diagonal = Section(0.180, 0.022), Section(0.120, 0.016)
    flange, strut = Section(0.080, 0.120), Section(0.160, 0.036)
    angles = 2 * np.pi * np.arange(AROUND) / AROUND
    outward = np.array([[0, np.cos(angle), np.sin(angle)] for angle in angles])
    rings = [[lattice.node(x, *(radius * out[1:])) for out in outward] for x, radius, _ in RINGS]
    following = np.roll(np.arange(AROUND), -1)
    for ring, (_, _, heavy) in zip(rings, RINGS):
        for k, after in enumerate(following):
            lattice.join(ring[k], ring[after], outward[k] + outward[after], flange)
            lattice.masses.append((ring[k], heavy / AROUND, 0.05))
    for near, far in zip(rings[:-1], rings[1:]):
        for k, after in enumerate(following):
            lattice.join(near[k], far[k], outward[k], stringer)
            lattice.join(near[k], far[after], outward[k] + outward[after], diagonal)
            lattice.join(near[after], far[k], outward[k] + outward[after], diagonal)

    stations = []
    for ring, heavy in HOUSINGS:
        hub = lattice.node(RINGS[ring][0], 0, 0)
        stations.append(hub)
        lattice.masses.append((hub, heavy, 0.09))
        for k in range(1, AROUND, 2):  # four struts, their breadth along the axis
            lattice.join(hub, rings[ring][k], np.cross([1, 0, 0], outward[k]), strut, pieces=2)
    for ring, y, z, thickness in FEET:
        for side, k in ((-1, AROUND // 2), (1, 0)):
            foot = lattice.node(RINGS[ring][0], side * y, z)
            stations.append(foot)
            lattice.masses.append((foot, 8.0, 0.06))
            lattice.join(foot, rings[ring][k], [1, 0, 0], Section(0.200, thickness), pieces=4)
            # A brace across, from the foot to the lower part of the ring.
            lattice.join(foot, rings[ring][5 if side < 0 else 7], [1, 0, 0], Section(0.060, thickness), pieces=2)
    return lattice, stations


def reduced(stiffness, mass, stations, modes):
    """Craig and Bampton: motions of the stations, then the lowest modes with all stations held."""
    held = np.concatenate([np.arange(6 * node, 6 * node + 6) for node in stations])
    free = np.setdiff1d(np.arange(len(mass)), held)
    inner = stiffness[np.ix_(free, free)]
    root = np.linalg.cholesky(mass[np.ix_(free, free)])
    half = np.linalg.solve(root, inner)
    _, shapes = np.linalg.eigh(np.linalg.solve(root, half.T))
    shapes = np.linalg.solve(root.T, shapes[:, :modes])
    shapes *= np.sign(shapes[np.abs(shapes).argmax(axis=0), np.arange(modes)])
    basis = np.zeros((len(mass), len(held) + modes))
    basis[held, np.arange(len(held))] = 1
    basis[free, : len(held)] = -np.linalg.solve(inner, stiffness[np.ix_(free, held)])
    basis[free, len(held) :] = shapes
    return basis.T @ stiffness @ basis, basis.T @ mass @ basis


def matrix_market(matrix, rounded=1e-11):
    """Text of a symmetric matrix without entries that are rounding."""
    matrix = (matrix + matrix.T) / 2
    size = np.sqrt(np.diag(matrix))
    rows, columns = np.nonzero(np.tril(np.abs(matrix) > rounded * np.outer(size, size)))
    lines = [f"{i + 1} {j + 1} {matrix[i, j]:.12g}" for i, j in zip(rows, columns)]
    head = f"%%MatrixMarket matrix coordinate real symmetric\n{len(matrix)} {len(matrix)} {len(lines)}\n"
    return head + "\n".join(lines) + "\n"


if __name__ == "__main__":
    lattice, stations = casing()
    stiffness, mass = lattice.matrices()
    beside = pathlib.Path(__file__).with_suffix("")
    for name, matrix in zip(("stiffness", "mass"), reduced(stiffness, mass, stations, MODES)):
        pathlib.Path(f"{beside}_{name}.mtx").write_text(matrix_market(matrix))
    print(f"{len(lattice.nodes)} nodes, {mass[::6, ::6].sum():.1f} kg; stations [m]:")
    for node in stations:
        print("   ", lattice.nodes[node].round(6).tolist())
