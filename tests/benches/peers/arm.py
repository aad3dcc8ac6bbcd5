"""CasADi's side of the seven-joint arm: recursive Newton-Euler and composite bodies in each body's own frame.

The arm is that of `tests/truth/panda_arm.json`, its numbers constants; a spring of 1 N m/rad turns the first joint back, which
nothing else does, because a declaration without it has no steady state.

Usage: arm.py count ARM                operation counts as one line of JSON
       arm.py emit ARM FOLDER NAME..   C code of the named functions, FOLDER/arm_NAME.c
"""

import json
import sys

import casadi as ca
import numpy as np

from chain import compiled, operations, upper

GRAVITY = 9.81
SPRING = 1.0


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(*vectors):
    return [sum(parts[1:], parts[0]) for parts in zip(*vectors)]


def times(matrix, vector):
    return [sum(matrix[i][j] * vector[j] for j in range(3)) for i in range(3)]


def transposed(matrix):
    return [list(row) for row in zip(*matrix)]


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


class Arm:
    def __init__(self, path):
        with open(path) as file:
            joints = json.load(file)["joints"]
        self.n = len(joints)
        self.q, self.v, self.a = (ca.SX.sym(name, self.n) for name in "qva")
        self.bodies = []
        for k, joint in enumerate(joints):
            placement = [[ca.SX(x) for x in row] for row in joint["R"]]
            # from the body's frame to its parent's: the placement, then the turn about z
            s, c = ca.sin(self.q[k]), ca.cos(self.q[k])
            turn = [[c, -s, 0], [s, c, 0], [0, 0, 1]]
            rotation = transposed([times(placement, column) for column in transposed(turn)])
            mass, center = joint["mass"], np.array(joint["com"])
            about_origin = np.array(joint["Ic"]) - mass * skew(center) @ skew(center)
            first = [ca.SX(x) for x in mass * center]
            second = [[ca.SX(x) for x in row] for row in about_origin]
            offset = [ca.SX(x) for x in joint["p"]]
            self.bodies.append((rotation, offset, mass, first, second))

    def torques(self, moving):
        """Inverse dynamics; at rest without accelerations where not `moving`."""
        zero = [ca.SX(0)] * 3
        spin, spin_rate, rise = zero, zero, [ca.SX(0), ca.SX(0), ca.SX(GRAVITY)]
        loads = []
        for k, (rotation, offset, mass, first, second) in enumerate(self.bodies):
            back = transposed(rotation)
            v, a = (self.v[k], self.a[k]) if moving else (ca.SX(0), ca.SX(0))
            carried = add(rise, cross(spin_rate, offset), cross(spin, cross(spin, offset)))
            rise = times(back, carried)
            before = times(back, spin)
            spin = add(before, [0, 0, v])
            spin_rate = add(times(back, spin_rate), [before[1] * v, -before[0] * v, a])
            weight = [mass * x for x in rise]
            force = add(weight, cross(spin_rate, first), cross(spin, cross(spin, first)))
            moment = add(times(second, spin_rate), cross(spin, times(second, spin)), cross(first, rise))
            loads.append((force, moment))
        torques = [None] * self.n
        force, moment = zero, zero
        for k in reversed(range(self.n)):
            force, moment = add(loads[k][0], force), add(loads[k][1], moment)
            torques[k] = moment[2]
            rotation, offset = self.bodies[k][:2]
            force = times(rotation, force)
            moment = add(times(rotation, moment), cross(offset, force))
        torques[0] = torques[0] + SPRING * self.q[0]
        return ca.vertcat(*torques)

    def mass(self):
        """Composite bodies."""
        n = self.n
        full = ca.SX(n, n)
        total, first, second = 0.0, [ca.SX(0)] * 3, [[ca.SX(0)] * 3 for _ in range(3)]
        for k in reversed(range(n)):
            rotation, offset, mass, own_first, own_second = self.bodies[k]
            total += mass
            first = add(own_first, first)
            second = [add(a, b) for a, b in zip(own_second, second)]
            # a unit acceleration about z at this joint: force = z x first, moment = second z
            force, moment = [-first[1], first[0], ca.SX(0)], [row[2] for row in second]
            full[k, k] = moment[2]
            for j in reversed(range(k)):
                turn, arm = self.bodies[j + 1][:2]
                force = times(turn, force)
                moment = add(times(turn, moment), cross(arm, force))
                full[j, k] = full[k, j] = moment[2]
            # over to the parent: first and second moments turned, then moved by the offset
            turned = times(rotation, first)
            rows = [times(rotation, row) for row in second]
            columns = transposed(rows)
            second = [[None] * 3 for _ in range(3)]
            products = [times(rotation, column) for column in columns]
            for i in range(3):
                for j in range(i + 1):
                    entry = products[j][i]
                    # second moment of a body about a point: I + (2 first.p + m p.p) 1 - first p^T - p first^T - m p p^T
                    entry = entry - turned[i] * offset[j] - offset[i] * turned[j] - total * offset[i] * offset[j]
                    if i == j:
                        entry = entry + sum(2 * turned[x] * offset[x] + total * offset[x] ** 2 for x in range(3))
                    second[i][j] = second[j][i] = entry
            first = add(turned, [total * x for x in offset])
        return full

    def derivatives(self):
        """Mass matrix, torques by velocities and by positions: a reverse sweep per torque gives a row of all three."""
        n = self.n
        rows = ca.jacobian(self.torques(True), ca.vertcat(self.a, self.v, self.q))
        return [rows[:, k * n : (k + 1) * n] for k in range(3)]

    def function(self, name):
        """(inputs, outputs), matrices by columns."""
        if name == "motion_residual":
            return [self.a, self.v, self.q], [self.torques(True)]
        if name == "motion":
            still = ca.substitute(self.torques(True), self.a, ca.SX.zeros(self.n))
            return [self.v, self.q], [self.mass(), -still]
        if name == "residual_and_stiffness":
            torques = self.torques(False)
            return [self.q], [torques, ca.jacobian(torques, self.q).T]
        if name == "motion_linear":
            return [self.a, self.v, self.q], [x.T for x in self.derivatives()]
        raise SystemExit(f"no function {name}")


def count(arm):
    moving, still, mass = arm.torques(True), arm.torques(False), arm.mass()
    state = [arm.a, arm.v, arm.q]
    counts = {
        "inverse dynamics": operations(state, [moving]),
        "mass": operations(state, [upper(mass)]),
        "stiffness at rest": operations(state, [ca.jacobian(still, arm.q)]),
        "derivatives in motion": operations(state, arm.derivatives()),
    }
    print(json.dumps(counts))


def check(arm, path):
    """The state that the file stores, computed by Pinocchio."""
    with open(path) as file:
        stored = json.load(file)["states"][0]
    f = ca.Function("f", [arm.a, arm.v, arm.q], [arm.torques(True), arm.mass()])
    torques, mass = f(stored["qddot"], stored["qdot"], stored["q"])
    torques = np.array(torques).ravel() - np.eye(arm.n)[0] * SPRING * stored["q"][0]
    assert np.allclose(torques, stored["tau"], rtol=1e-10, atol=1e-10), torques
    assert np.allclose(np.array(mass), stored["M"], rtol=1e-10, atol=1e-10), mass


def emit(arm, folder, names):
    for name in names:
        f = compiled(*arm.function(name), f"arm_{name}")
        code = ca.CodeGenerator(f"arm_{name}.c", {"with_header": False})
        code.add(f)
        code.generate(folder + "/")


if __name__ == "__main__":
    action, path = sys.argv[1:3]
    arm = Arm(path)
    check(arm, path)
    if action == "count":
        count(arm)
    else:
        emit(arm, sys.argv[3], sys.argv[4:])
