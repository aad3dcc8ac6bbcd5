"""CasADi's side of the chain of bars: closed forms in, C and operation counts out.

The mechanism: n uniform bars in series, the first hinged on the axis of a base that spins about the vertical z at `omega`, all
hinges about y, gravity along -z. Coordinates q are relative angles, design variables b = (lengths, masses).

Two ways in which an expert could state it:

  typed    M and K in closed form in absolute angles phi_i = q_1 + .. + q_i, then carried over to relative angles
  energies only kinetic and potential energy; CasADi differentiates them

Usage: chain.py count N [all]          operation counts as one line of JSON
       chain.py emit N FOLDER NAME..   C code of the named functions, FOLDER/NAME.c
"""

import json
import sys

import casadi as ca

GRAVITY = 9.81


def constants(n, lengths, masses):
    """c_ij and d_i of uniform bars: M_ij = c_ij cos(phi_i - phi_j), V_gravity = -g sum d_i cos phi_i."""
    beyond = [ca.SX(0)] * (n + 1)  # mass hanging on the far end of bar i
    for i in reversed(range(n)):
        beyond[i] = beyond[i + 1] + masses[i]
    far = [beyond[i + 1] for i in range(n)]
    d = [lengths[i] * (masses[i] / 2 + far[i]) for i in range(n)]
    c = [[None] * n for _ in range(n)]
    for i in range(n):
        c[i][i] = lengths[i] ** 2 * (masses[i] / 3 + far[i])
        for j in range(i):
            c[i][j] = c[j][i] = lengths[j] * d[i]  # the nearer bar carries the farther one by its whole length
    return c, d


class Chain:
    """The expressions of one formulation."""

    def __init__(self, n, formulation):
        self.n = n
        self.q = ca.SX.sym("q", n)
        self.u = ca.SX.sym("u", 1)
        self.b = ca.SX.sym("b", 2 * n)
        lengths = [self.b[i] for i in range(n)]
        masses = [self.b[n + i] for i in range(n)]
        {"typed": self.typed, "energies": self.energies}[formulation](lengths, masses)

    def absolute_angles(self):
        angles, angle = [], 0
        for i in range(self.n):
            angle = angle + self.q[i]
            angles.append(angle)
        return angles

    def typed(self, lengths, masses):
        n, w2 = self.n, self.u[0] ** 2
        c, d = constants(n, lengths, masses)
        field = [[w2 * c[i][j] for j in range(n)] for i in range(n)]
        phi = self.absolute_angles()
        s, k = [ca.sin(x) for x in phi], [ca.cos(x) for x in phi]
        pull = [sum(field[i][j] * s[j] for j in range(n)) for i in range(n)]
        residual = [GRAVITY * d[i] * s[i] - pull[i] * k[i] for i in range(n)]
        mass, stiffness = {}, {}
        for i in range(n):
            mass[i, i] = c[i][i]
            stiffness[i, i] = GRAVITY * d[i] * k[i] + pull[i] * s[i] - field[i][i] * k[i] ** 2
            for j in range(i):
                mass[j, i] = c[i][j] * ca.cos(phi[i] - phi[j])
                stiffness[j, i] = -(field[i][j] * k[i] * k[j])
        self.residual = ca.vertcat(*suffix_sums(residual))
        self.mass = relative(mass, n)
        self.stiffness = relative(stiffness, n)

    def energies(self, lengths, masses):
        n, w2 = self.n, self.u[0] ** 2
        c, d = constants(n, lengths, masses)
        phi, rate = ca.SX.sym("phi", n), ca.SX.sym("rate", n)
        pairs = [(i, j) for i in range(n) for j in range(i)]
        kinetic = sum(c[i][i] * rate[i] ** 2 for i in range(n)) / 2
        kinetic = kinetic + sum(c[i][j] * ca.cos(phi[i] - phi[j]) * rate[i] * rate[j] for i, j in pairs)
        # the centrifugal field is a potential too
        potential = -sum(GRAVITY * d[i] * ca.cos(phi[i]) for i in range(n))
        potential = potential - w2 * sum(c[i][i] * ca.sin(phi[i]) ** 2 for i in range(n)) / 2
        potential = potential - w2 * sum(c[i][j] * ca.sin(phi[i]) * ca.sin(phi[j]) for i, j in pairs)
        matrices = (ca.hessian(kinetic, rate)[0], ca.hessian(potential, phi)[0])
        results = [ca.gradient(potential, phi), *matrices]
        results = ca.substitute(results, [phi], [ca.vertcat(*self.absolute_angles())])
        self.residual = ca.vertcat(*suffix_sums([results[0][i] for i in range(n)]))
        upper = [{(j, i): x[j, i] for i in range(n) for j in range(i + 1)} for x in results[1:]]
        self.mass, self.stiffness = (relative(x, n) for x in upper)

    def mode_functional(self):
        phi, lam = ca.SX.sym("phi", self.n), ca.SX.sym("lambda", 1)
        pencil = self.stiffness - lam * self.mass
        return phi, lam, ca.dot(phi, ca.mtimes(pencil, phi))

    def partials(self, quantity, variables):
        """One dense matrix per variable, side by side."""
        entries = ca.jacobian(ca.vec(quantity), variables)
        return ca.densify(entries)

    def function(self, name):
        """(inputs, outputs) with the shapes of the generated kernel of the same name, matrices by columns."""
        at = [self.q, self.u, self.b]
        if name == "residual":
            return at, [self.residual]
        if name == "residual_and_stiffness":
            return at, [self.residual, self.stiffness]
        if name == "linear":
            return at, [self.mass, self.stiffness]
        if name == "mode_gradient":
            phi, lam, functional = self.mode_functional()
            return at + [phi, lam], [ca.gradient(functional, x) for x in at]
        if name == "all":
            outputs = [self.partials(self.residual, x) for x in (self.u, self.b)]
            for matrix in (self.mass, self.stiffness):
                outputs += [self.partials(matrix, x) for x in at]
            return at, outputs
        raise SystemExit(f"no function {name}")


def suffix_sums(values):
    sums, total = [], 0
    for value in reversed(values):
        total = total + value
        sums.append(total)
    return sums[::-1]


def relative(upper, n):
    """S_kl = sum of the symmetric matrix over i >= k, j >= l, from its upper triangle: two additions per entry."""
    full = ca.SX(n, n)
    for k in reversed(range(n)):
        row = suffix_sums([upper[k, l] for l in range(k, n)])
        for l in reversed(range(k, n)):
            total = row[l - k]
            if k + 1 < n:  # add the rows below; on the diagonal S_(k+1)k = S_k(k+1), which this row has just found
                total = total + (full[k, k + 1] if l == k else full[k + 1, l])
            full[k, l] = full[l, k] = total
    return full


def compiled(inputs, outputs, name="f"):
    return ca.Function(name, inputs, ca.cse([ca.densify(x) for x in outputs]))


def operations(inputs, outputs):
    """Every node but inputs, outputs and constants."""
    f = compiled(inputs, outputs)
    free = {ca.OP_INPUT, ca.OP_OUTPUT, ca.OP_CONST, ca.OP_PARAMETER}
    return sum(f.instruction_id(k) not in free for k in range(f.n_instructions()))


def upper(matrix):
    n = matrix.shape[0]
    return ca.vertcat(*[matrix[i, j] for i in range(n) for j in range(i, n)])


def count(n, everything):
    table = {"bars": n}
    for formulation in ("typed", "energies"):
        chain = Chain(n, formulation)
        at = [chain.q, chain.u, chain.b]
        mk = [chain.residual, upper(chain.mass), upper(chain.stiffness)]
        phi, lam, functional = chain.mode_functional()
        counts = {
            "mk": operations(at, mk),
            "adj": operations(at + [phi, lam], [ca.gradient(functional, x) for x in (chain.q, chain.b)]),
        }
        if everything:
            partials = [ca.jacobian(x, y) for x in mk[1:] for y in (chain.b, chain.q)]
            counts["all"] = operations(at, mk + [ca.jacobian(chain.residual, chain.b)] + partials)
        table[formulation] = counts
    print(json.dumps(table))


def emit(n, folder, names):
    chain = Chain(n, "typed")
    for name in names:
        inputs, outputs = chain.function(name)
        f = compiled(inputs, outputs, f"chain{n}_{name}")
        code = ca.CodeGenerator(f"chain{n}_{name}.c", {"with_header": False})
        code.add(f)
        code.generate(folder + "/")


if __name__ == "__main__":
    action, n = sys.argv[1], int(sys.argv[2])
    if action == "count":
        count(n, "all" in sys.argv[3:])
    else:
        emit(n, sys.argv[3], sys.argv[4:])
