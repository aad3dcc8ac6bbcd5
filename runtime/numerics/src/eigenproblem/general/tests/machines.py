"""Compares eigenvalues written by `MACHINES=file cargo test -p eigentol-numerics -- --ignored no_machine` with their values to
34 digits: `python machines.py file [every]`. Prints how many are farther off than their stated error."""

import sys

from mpmath import eig, matrix, mp, mpc, mpf

mp.dps = 80


def exact(n, mass, damping, stiffness):
    square = lambda flat: matrix([[mpf(x) for x in flat[i * n : (i + 1) * n]] for i in range(n)])
    mass, damping, stiffness = map(square, (mass, damping, stiffness))
    inverse = mass**-1
    k, c = -inverse * stiffness, -inverse * damping
    companion = matrix(2 * n, 2 * n)
    for i in range(n):
        companion[i, n + i] = 1
        for j in range(n):
            companion[n + i, j], companion[n + i, n + j] = k[i, j], c[i, j]
    return eig(companion, left=False, right=False)


wrong, count = 0, 0
for line in list(open(sys.argv[1]))[:: int(sys.argv[2]) if len(sys.argv) > 2 else 1]:
    seed, n, *numbers = line.split()
    n, numbers = int(n), [float(x) for x in numbers]
    square = n * n
    values = exact(n, numbers[:square], numbers[square : 2 * square], numbers[2 * square : 3 * square])
    roots = numbers[3 * square :]
    found = []
    for re, im, error in zip(roots[::3], roots[1::3], roots[2::3]):
        found += [(mpc(re, im), error)] + ([(mpc(re, -im), error)] if im > 0 else [])
    # Nearest first, each once.
    pairs = sorted((abs(s - x), i, j) for i, (s, _) in enumerate(found) for j, x in enumerate(values))
    left, right = set(), set()
    for distance, i, j in pairs:
        if i in left or j in right:
            continue
        left.add(i), right.add(j)
        count += 1
        error = mpf(found[i][1])
        if distance > error:
            wrong += 1
            print(seed, n, found[i][0], mp.nstr(distance, 3), mp.nstr(error, 3))
print(f"{wrong} of {count} eigenvalues farther off than their error")
