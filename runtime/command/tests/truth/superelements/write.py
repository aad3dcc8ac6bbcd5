"""Writes one superelement in every format: a beam between two nodes with two internal coordinates, in mm, t and s.

Needs numpy and scipy. Run it in this folder. The entries have few digits, so every format holds them exactly.
"""

import json

import numpy as np
import scipy.io
import scipy.sparse


def beam():
    """Stiffness and mass: six motions of each end, x along the beam, then two internal coordinates."""
    span, shear, axial, twist = 500.0, 1200.0, 250000.0, 4e6
    k, m = np.zeros((14, 14)), np.zeros((14, 14))

    def put(matrix, rows, block):
        matrix[np.ix_(rows, rows)] += np.array(block)

    put(k, [0, 6], [[axial, -axial], [-axial, axial]])
    put(k, [3, 9], [[twist, -twist], [-twist, twist]])
    put(m, [0, 6], [[0.0014, 0.0007], [0.0007, 0.0014]])
    put(m, [3, 9], [[2, 1], [1, 2]])
    for across, turn, sign in [(1, 5, 1), (2, 4, -1)]:
        a, b, c = shear, sign * shear * span / 2, shear * span**2 / 3
        put(k, [across, turn, across + 6, turn + 6],
            [[a, b, -a, b], [b, c, -b, c / 2], [-a, -b, a, -b], [b, c / 2, -b, c]])
        p, q = sign * 0.11, sign * 0.065
        put(m, [across, turn, across + 6, turn + 6],
            [[0.00156, p, 0.00054, -q], [p, 10, q, -7.5], [0.00054, q, 0.00156, -p], [-q, -7.5, -p, 10]])
    k[12, 12], k[13, 13] = 2000, 8000
    m[12, 12] = m[13, 13] = 0.002
    for row, column in [(1, 12), (2, 13), (7, 12), (8, 13)]:
        m[row, column] = m[column, row] = 0.0003
    return k, m, np.round(k * 2e-5, 9)


K, M, C = beam()
# Rows as programs number them: not in the order of the stations.
ORDER = [13, *range(6, 12), 12, *range(6)]
LABELS = [(101, d + 1) for d in range(6)] + [(205, d + 1) for d in range(6)] + [(9001, 0), (9002, 0)]
MATRICES = {"mass": M, "stiffness": K, "damping": C}
UNITS = {"length": "mm", "mass": "t", "time": "s"}
STATIONS = [{"name": "left", "node": 101, "position": [0, 0, 100]}, {"name": "right", "node": 205, "position": [500, 0, 100]}]


def shuffled(matrix):
    return matrix[np.ix_(ORDER, ORDER)]


def labels(internal=0):
    return [(node, d if d else internal) for node, d in (LABELS[row] for row in ORDER)]


def describe(name, sources, unknowns=None):
    text = {"superelement": "casing", "units": UNITS, "stations": STATIONS}
    if unknowns:
        text["unknowns"] = unknowns
    with open(f"{name}.json", "w") as file:
        lines = [f'  "{key}": {json.dumps(value)}' for key, value in {**text, **sources}.items()]
        file.write("{\n" + ",\n".join(lines) + "\n}\n")


def text(name, lines):
    with open(name, "w") as file:
        file.writelines(line + "\n" for line in lines)


def lower(matrix):
    return [(i, j) for j in range(len(matrix)) for i in range(j, len(matrix)) if matrix[i, j] != 0]


def matrix_market():
    sources = {}
    for role, matrix in MATRICES.items():
        file = f"market_{role}.mtx"
        matrix = shuffled(matrix)
        scipy.io.mmwrite(file, matrix if role == "damping" else scipy.sparse.coo_matrix(matrix))
        sources[role] = {"file": file}
    describe("market", sources, labels())


def inline():
    """In SI and in the order of the stations, so without units and unknowns."""
    turns = np.array([1, 1, 1, 1e-3, 1e-3, 1e-3] * 2 + [1, 1])
    sources = {}
    for role, matrix in MATRICES.items():
        si = matrix * np.outer(turns, turns) * 1000
        lines = ["%%MatrixMarket matrix coordinate real symmetric", f"14 14 {len(lower(si))}"]
        lines += [f"{i + 1} {j + 1} {si[i, j]:.12g}" for i, j in lower(si)]
        sources[role] = {"matrix_market": "\n".join(lines) if role == "mass" else lines}
    stations = [{"name": s["name"], "node": s["node"], "position": [x / 1000 for x in s["position"]]} for s in STATIONS]
    with open("inline.json", "w") as file:
        json.dump({"superelement": "casing", "stations": stations, **sources}, file, indent=1)
        file.write("\n")


def harwell_boeing():
    sources = {}
    for role, matrix in MATRICES.items():
        matrix = shuffled(matrix)
        sources[role] = {"file": f"harwell_{role}.matrix"}
        if role == "mass":
            scipy.io.hb_write(sources[role]["file"], scipy.sparse.csc_matrix(matrix))
            continue
        # Lower triangle, as the guide has it; the damping as ANSYS did it before release 11: both halves in spite of the type.
        half = scipy.sparse.csc_matrix(np.tril(matrix) if role == "stiffness" else matrix)
        value = ("(1P,4E20.12)", 4, "{:20.12E}") if role == "stiffness" else ("(3D26.16)", 3, "{:26.16E}")
        blocks = [(half.indptr + 1, 8, "{:10d}"), (half.indices + 1, 8, "{:10d}"), (half.data, *value[1:])]
        cards = [["".join(form.format(x) for x in block[k:k + n]) for k in range(0, len(block), n)] for block, n, form in blocks]
        if role == "damping":
            cards[2] = [line.replace("E", "D") for line in cards[2]]
        counts = [len(card) for card in cards]
        right = 1 if role == "damping" else 0
        head = [f"{'Casing, ' + role:72}CASING", "".join(f"{x:14d}" for x in [sum(counts) + right, *counts, right]),
                "RSA" + " " * 11 + "".join(f"{x:14d}" for x in [14, 14, half.nnz, 0]),
                f"{'(8I10)':16}{'(8I10)':16}{value[0]:20}{'(1E20.12)':20}"]
        text(sources[role]["file"], head + ["F" + " " * 13 + f"{1:14d}{14:14d}"] * right + sum(cards, []) + ["  0.0"] * right)
    describe("harwell", sources, labels())


def abaqus():
    names = labels(internal=1)
    # *MATRIX OUTPUT, FORMAT=MATRIX INPUT: the lower triangle of one matrix, all of another; and FORMAT=COORDINATE.
    for role, matrix in MATRICES.items():
        matrix = shuffled(matrix)
        pairs = [(j, i) if role == "mass" else (i, j) for i, j in lower(matrix)]
        if role == "stiffness":
            pairs = sorted({(i, j) for i, j in pairs} | {(j, i) for i, j in pairs})
        head = ["** ", "** ASSEMBLED NODE BASED MATRIX", "** "] if role != "damping" else []
        text(f"abaqus_{role}.mtx", head + [
            "{},{},{},{}, {: .15e}".format(*names[i], *names[j], matrix[i, j]) for i, j in pairs])
        text(f"coordinate_{role}.mtx", ["{:8d} {:8d} {: .15e}".format(i + 1, j + 1, matrix[i, j]) for i, j in pairs])
    describe("abaqus", {role: {"file": f"abaqus_{role}.mtx"} for role in MATRICES})
    describe("coordinate", {role: {"file": f"coordinate_{role}.mtx"} for role in MATRICES}, labels())


def substructure():
    names = labels(internal=1)
    # As CalculiX writes it: a node for each motion.
    lines = ["**", "** GENERATION OF SUBSTRUCTURE", f"*USER ELEMENT,NODES={14:11d},LINEAR", "** ELEMENT NODES"]
    nodes = [f"{node:10d}," for node, _ in names]
    lines += ["**" + "".join(nodes[k:k + 10]) for k in range(0, 14, 10)]
    lines += [f"{names[0][1]:10d}"] + [f"{k + 1:10d},{names[k][1]:10d}" for k in range(1, 14)]
    matrix = shuffled(K)
    lines.append("*MATRIX,TYPE=STIFFNESS")
    for row in range(14):
        for k in range(0, row + 1, 4):
            lines.append("".join(f"{x:20.13E}," for x in matrix[row, k:min(k + 4, row + 1)]))
    text("substructure_ccx.mtx", lines)
    # As Abaqus writes it: a node with all its motions, and both matrices.
    order = [12, 13, *range(6, 12), *range(6)]
    lines = ["**", "** SUBSTRUCTURE GENERATED", "*USER ELEMENT, NODES=        4, LINEAR", "** ELEMENT NODES", "** 9001, 9002, 205,", "** 101",
             "1", "3, 1, 2, 3, 4, 5, 6"]
    for kind, matrix in [("STIFFNESS", K), ("MASS", M), ("VISCOUS DAMPING", C)]:
        lines.append(f"*MATRIX,TYPE={kind}")
        for n, row in enumerate(order):
            for k in range(0, n + 1, 4):
                some = matrix[row, order[k:min(k + 4, n + 1)]]
                lines.append(", ".join(f"{x:.13g}" for x in some) + (" ," if n + 1 == k + len(some) else ""))
    text("substructure.mtx", lines)
    beside = {"file": "substructure.mtx"}
    describe("substructure", {"mass": beside, "stiffness": {"file": "substructure_ccx.mtx"}, "damping": {**beside, "name": "viscousdamping"}})


def calculix():
    for ending, matrix in [("sti", K), ("mas", M)]:
        matrix = shuffled(matrix)
        pairs = sorted({(j, i) for i, j in lower(matrix)} | {(i, i) for i in range(14)}, key=lambda pair: (pair[1], pair[0]))
        text(f"calculix.{ending}", [f"{i + 1} {j + 1} {matrix[i, j]:20.13e}" for i, j in pairs])
    text("calculix.dof", [f"{node}.{d}" for node, d in labels()])
    describe("calculix", {"mass": {"file": "calculix.mas"}, "stiffness": {"file": "calculix.sti"}})


def dmig():
    names = labels()

    def wide(name, matrix, lower=False):
        lines = [f"DMIG    {name:8}{0:8d}{6:8d}{2:8d}{0:8d}{'':16}{14:8d}"]
        for j in range(14):
            rows = [i for i in (range(j, 14) if lower else range(j + 1)) if matrix[i, j] != 0]
            lines += [f"DMIG*   {name:16}{names[j][0]:16d}{names[j][1]:16d}"] * bool(rows)
            lines += ["*       {:16d}{:16d}{}".format(*names[i], f"{matrix[i, j]:16.9E}".replace("E", "D")) for i in rows]
        return lines

    def short(value):
        mantissa, exponent = f"{value:.2e}".split("e")
        number = mantissa.rstrip("0") + f"{int(exponent):+d}"
        assert len(number) <= 8 and float(number[:-2] + "e" + number[-2:]) == value, value
        return number

    def narrow(name, matrix):
        lines = [f"DMIG    {name:8}{0:8d}{1:8d}{1:8d}", "$ All entries, eight characters each, two to a line"]
        for j in range(14):
            fields = ["{:8d}{:8d}{:>8}{:8}".format(*names[i], short(matrix[i, j]), "") for i in range(14) if matrix[i, j] != 0]
            lines.append("DMIG    {:8}{:8d}{:8d}{:8}{}".format(name, *names[j], "", fields[0]).rstrip())
            lines += [("        " + "".join(fields[k:k + 2])).rstrip() for k in range(1, len(fields), 2)]
        return lines

    other = ["DMIG    PAX            0       9       2       0                       1", "DMIG*   PAX                            1               0",
             "*                    101               1 1.000000000D+00"]
    text("nastran.pch", ["$TITLE   = CASING", *other, *wide("KAAX", shuffled(K)), *wide("MAAX", shuffled(M)), *wide("BAAX", shuffled(C), lower=True)])
    text("nastran_small.pch", [*narrow("KAAX", shuffled(K)), "GRID         101             0.0     0.0   100.0", *narrow("MAAX", shuffled(M))])
    beside = {"file": "nastran.pch"}
    describe("nastran", {role: beside for role in MATRICES})
    describe("nastran_small", {"mass": {"file": "nastran_small.pch", "name": "maax"}, "stiffness": {"file": "nastran_small.pch"}, "damping": beside})


def op4():
    def header(name, matrix, kind, form, per_line, width, big=False):
        rows = -len(matrix) if big else len(matrix)
        return f"{matrix.shape[1]:8d}{rows:8d}{form:8d}{kind:8d}{name:8}1P,{per_line}E{width}.{width - 7}"

    def numbers(values, per_line, width):
        words = [f"{x:{width}.{width - 7}E}" for x in values]
        return ["".join(words[k:k + per_line]) for k in range(0, len(words), per_line)]

    def last(matrix, per_line, width):
        return [f"{matrix.shape[1] + 1:8d}{1:8d}{1:8d}", *numbers([1.0], per_line, width)]

    def dense(name, matrix, kind, per_line, width, form=6):
        lines = [header(name, matrix, kind, form, per_line, width)]
        for j, column in enumerate(matrix.T):
            filled = np.flatnonzero(column)
            if len(filled):
                some = column[filled[0]:filled[-1] + 1]
                lines += [f"{j + 1:8d}{filled[0] + 1:8d}{len(some):8d}", *numbers(some, per_line, width)]
        return lines + last(matrix, per_line, width)

    def strings(name, matrix, kind, per_line, width, big):
        lines = [header(name, matrix, kind, 6, per_line, width, big)]
        words = 2 if kind == 2 else 1
        for j, column in enumerate(matrix.T):
            filled = np.flatnonzero(column)
            runs = [run for run in np.split(filled, np.flatnonzero(np.diff(filled) > 1) + 1) if len(run)]
            total = sum(len(run) * words + (2 if big else 1) for run in runs)
            lines += [f"{j + 1:8d}{0:8d}{total:8d}"] * bool(runs)
            for run in runs:
                length, row = len(run) * words + 1, run[0] + 1
                lines.append(f"{length:8d}{row:8d}" if big else f"{length * 65536 + row:12d}")
                lines += numbers(column[run], per_line, width)
        return lines + last(matrix, per_line, width)

    k, m, c = shuffled(K), shuffled(M), shuffled(C)
    text("casing.op4", dense("PHG", m[:, :3], 2, 3, 23, form=2) + dense("KGG", k, 2, 3, 23) + strings("MGG", m, 2, 5, 16, False))
    text("big.op4", strings("BGG", c, 1, 5, 16, True) + strings("KGG", k, 2, 3, 23, True) + strings("MGG", m, 1, 5, 16, False))
    describe("op4", {"mass": {"file": "casing.op4"}, "stiffness": {"file": "casing.op4"}, "damping": {"file": "big.op4"}}, labels())
    describe("big", {role: {"file": "big.op4"} for role in MATRICES}, labels())


for write in [matrix_market, inline, harwell_boeing, abaqus, substructure, calculix, dmig, op4]:
    write()
