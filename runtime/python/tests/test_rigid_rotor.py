"""Unbalance response of a rigid rotor on bearings with cross coupling: by its four equations, and by ROSS."""

import numpy as np
import pytest

import eigentol

LENGTH = 0.8
# Height, mass, moments of inertia across and about the axis, unbalance and its angle.
DISKS = [(0.3, 20.0, 0.5, 0.9, 2e-4, 0.5), (0.55, 12.0, 0.2, 0.35, 1e-4, -1.0)]
# Coefficients xx, xy, yx, yy of the bearings at both ends.
STIFFNESS = [(9e6, 3e6, -5e6, 4e6), (12e6, 2e6, -4e6, 7e6)]
DAMPING = [(9e3, -1e3, -1e3, 12e3), (15e3, -2e3, -2e3, 11e3)]
SPEEDS = [150.0, 480.0, 640.0, 1100.0]


def declaration():
    def matrix(xx, xy, yx, yy):
        return f"[[{xx}, {xy}, 0], [{yx}, {yy}, 0], [0, 0, 0]]"

    disks = [
        f"rigid(mass: {mass} kg, inertia: [{across}, {across}, {about}] kg*m^2) at [0, 0, {z}] m"
        for z, mass, across, about, _, _ in DISKS
    ]
    unbalances = "".join(
        f"unbalance u{k}: on rotor, amount: {amount} kg*m, angle: {angle} rad, at [0, 0, {z}] m;\n"
        for k, (z, _, _, _, amount, angle) in enumerate(DISKS)
    )
    bearings = "".join(
        f"""
        point foot{k}: ground at [0, 0, {z}] m;
        point journal{k}: seat at [0, 0, {z}] m;
        force film{k}: bushing(from: foot{k}, to: journal{k},
            stiffness: {matrix(*STIFFNESS[k])} N/m, damping: {matrix(*DAMPING[k])} N*s/m);
        output x{k} = position(journal{k}).x;
        output y{k} = position(journal{k}).y;
        """
        for k, z in enumerate((0.0, LENGTH))
    )
    return f"""
    mechanism Rotor {{
        input speed: rad/s;
        body seat: massless;
        body rotor: {" + ".join(disks)};
        joint lie: free(u: x, v: y, w: z, a: x, b: y, c: z) from ground to seat, w driven at 0, c driven at 0;
        joint spin: revolute(z) from seat to rotor, driven at speed;
        {unbalances}
        {bearings}
    }}
    """


def by_hand(speed):
    """Amplitudes x, y of both journals: displacements of the centre of mass and tilts about x and y."""
    heights, masses, across, about, amounts, angles = np.array(DISKS).T
    center = masses @ heights / masses.sum()
    transverse = across.sum() + masses @ (heights - center) ** 2
    inertia = np.diag([masses.sum(), masses.sum(), transverse, transverse])
    gyroscopic = np.zeros((4, 4))
    gyroscopic[2, 3] = speed * about.sum()
    gyroscopic[3, 2] = -speed * about.sum()

    def seen(z):
        return np.array([[1.0, 0.0, 0.0, z - center], [0.0, 1.0, center - z, 0.0]])

    def assembled(coefficients):
        pairs = zip((0.0, LENGTH), coefficients, strict=True)
        return sum(seen(z).T @ np.reshape(own, (2, 2)) @ seen(z) for z, own in pairs)

    stiffness = assembled(STIFFNESS) - speed**2 * inertia + 1j * speed * (assembled(DAMPING) + gyroscopic)
    force = sum(
        seen(z).T @ (amount * speed**2 * np.exp(1j * angle) * np.array([1.0, -1j]))
        for z, amount, angle in zip(heights, amounts, angles, strict=True)
    )
    motion = np.linalg.solve(stiffness, force)
    return np.concatenate([seen(0.0) @ motion, seen(LENGTH) @ motion])


@pytest.fixture(scope="module")
def mechanism():
    return eigentol.Mechanism.from_text(declaration())


def ours(mechanism, speed):
    return eigentol.Study(mechanism, inputs={"speed": speed}).forced_response().outputs[0]


@pytest.mark.parametrize("speed", SPEEDS)
def test_a_rigid_rotor_vibrates_as_its_four_equations(mechanism, speed):
    np.testing.assert_allclose(ours(mechanism, speed), by_hand(speed), rtol=1e-12)


def test_a_rigid_rotor_vibrates_as_that_of_ross(mechanism):
    """Theirs has a nearly massless shaft that bends by less than a millionth of what the bearings give."""
    ross = pytest.importorskip("ross", reason="ROSS is absent: unbalance responses are not compared")
    stiff = ross.Material(name="stiff", rho=1e-3, E=5e18, G_s=2e18)
    kinds = {"shear_effects": False, "rotary_inertia": False, "gyroscopic": False}
    nodes = [0.0, *(disk[0] for disk in DISKS), LENGTH]
    shaft = [ross.ShaftElement(L=part, idl=0, odl=0.05, material=stiff, **kinds) for part in np.diff(nodes)]
    disks = [
        ross.DiskElement(n=k, m=mass, Id=across, Ip=about)
        for k, (_, mass, across, about, _, _) in enumerate(DISKS, start=1)
    ]
    names = ("xx", "xy", "yx", "yy")
    bearings = [
        ross.BearingElement(
            n=node,
            kzz=1e6,
            **{f"k{name}": value for name, value in zip(names, stiffness, strict=True)},
            **{f"c{name}": value for name, value in zip(names, damping, strict=True)},
        )
        for node, stiffness, damping in zip((0, len(nodes) - 1), STIFFNESS, DAMPING, strict=True)
    ]
    theirs = ross.Rotor(shaft, disks, bearings).run_unbalance_response(
        node=[1, 2],
        unbalance_magnitude=[disk[4] for disk in DISKS],
        unbalance_phase=[disk[5] for disk in DISKS],
        frequency=np.array(SPEEDS),
    )
    per_node = len(theirs.forced_resp) // len(nodes)
    rows = [0, 1, per_node * (len(nodes) - 1), per_node * (len(nodes) - 1) + 1]
    for k, speed in enumerate(SPEEDS):
        expected = theirs.forced_resp[rows, k]
        np.testing.assert_allclose(ours(mechanism, speed), expected, rtol=1e-5)
