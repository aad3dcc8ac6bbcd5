"""Adds the eigenvalues of the pencils in a file to it, to 34 digits.

    python3 eigenvalues.py pencils.txt > with_eigenvalues.txt

A pencil is a comment with its name, its size n, and the rows of mass, damping and stiffness. The doubles are taken as
they are; the eigenvalues of the companion matrix are found in 120 digits, without any code of the project. Needs mpmath.
"""

import sys

from mpmath import eig, inverse, matrix, mp, mpf, nstr

mp.dps = 120


def pencils(lines):
    lines = iter(lines)
    for name in lines:
        n = int(next(lines))
        rows = [[mpf(float(x)) for x in next(lines).split()] for _ in range(3 * n)]
        yield name, n, [matrix(rows[k * n : (k + 1) * n]) for k in range(3)]


def eigenvalues(n, mass, damping, stiffness):
    turned = inverse(mass)
    companion = matrix(2 * n)
    for i in range(n):
        companion[i, n + i] = 1
    for matrices, place in ((stiffness, 0), (damping, n)):
        product = -turned * matrices
        for i in range(n):
            for j in range(n):
                companion[n + i, place + j] = product[i, j]
    values, _ = eig(companion, left=False, right=True)
    rounded = lambda x: mpf(0) if abs(x) < mpf(10) ** -60 else x
    values = [(rounded(s.real), rounded(s.imag)) for s in map(mp.mpc, values)]
    return sorted((s for s in values if s[1] >= 0), key=lambda s: (s[0] ** 2 + s[1] ** 2, s[1]))


def main():
    lines = [line.strip() for line in open(sys.argv[1]) if line.strip()]
    for name, n, matrices in pencils(lines):
        found = eigenvalues(n, *matrices)
        weight = sum(2 if im > 0 else 1 for _, im in found)
        assert weight == 2 * n, (name, weight)
        print(name)
        print(n)
        for rows in matrices:
            for i in range(n):
                print(" ".join("0" if x == 0 else repr(float(x)) for x in (rows[i, j] for j in range(n))))
        print(len(found))
        for re, im in found:
            print(nstr(re, 34), nstr(im, 34))


main()
