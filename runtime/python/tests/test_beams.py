"""Rotating cantilevers beside finite elements: cubic Hermite elements with the tension of the spin."""

import time

import numpy as np
import pytest

import eigentol

LENGTH, STIFFNESS, MASS = 1.3, 40.0, 0.7


def declaration(coordinates, tip):
    carried = f"""
        body weight: point(mass: {tip} kg);
        joint weld: fixed from blade at tip to weight;
    """
    return f"""
    mechanism Blade {{
        input omega: rad/s;
        design radius = 0.2 m;
        body hub: massless;
        joint spin: revolute(z) from ground to hub, driven at omega;
        body blade: beam(length: {LENGTH} m, along: x, up: z, mass_per_length: {MASS} kg/m,
            stiffness_y: {STIFFNESS} N*m^2, bending_y: {coordinates});
        joint clamp: fixed from hub to blade at [radius, 0, 0];
        {carried if tip else ""}
    }}
    """


def by_elements(count, speed, radius, tip):
    """The first three frequencies of flap: stiffness of bending and of the tension, a weight at the tip."""
    h = LENGTH / count
    points, weights = np.polynomial.legendre.leggauss(4)
    s, w = (1 + points) / 2, weights / 2
    ones = np.ones_like(s)
    values = np.array([1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)])
    slopes = np.array([6 * s**2 - 6 * s, h * (1 - 4 * s + 3 * s**2), 6 * s - 6 * s**2, h * (3 * s**2 - 2 * s)]) / h
    curves = np.array([12 * s - 6 * ones, h * (6 * s - 4 * ones), 6 * ones - 12 * s, h * (6 * s - 2 * ones)]) / h**2
    size = 2 * count + 2
    mass, stiffness = np.zeros((size, size)), np.zeros((size, size))
    for element in range(count):
        own = slice(2 * element, 2 * element + 4)
        x = h * (element + s)
        tension = MASS * speed**2 * (radius * (LENGTH - x) + (LENGTH**2 - x**2) / 2)
        tension += tip * speed**2 * (radius + LENGTH)
        mass[own, own] += MASS * h * (values * w) @ values.T
        stiffness[own, own] += STIFFNESS * h * (curves * w) @ curves.T + h * (slopes * w * tension) @ slopes.T
    mass[-2, -2] += tip
    # The lowest modes are the largest eigenvalues of the flexibility, which rounding spares.
    root = np.linalg.cholesky(stiffness[2:, 2:])
    half = np.linalg.solve(root, mass[2:, 2:])
    flexibility = np.linalg.solve(root, half.T)
    return 1 / np.sqrt(np.linalg.eigvalsh((flexibility + flexibility.T) / 2)[:-4:-1])


def timed(function):
    """What a function gives, and the shortest of some times it takes, ms."""
    times = []
    for _ in range(5):
        start = time.perf_counter()
        found = function()
        times.append(1e3 * (time.perf_counter() - start))
    return found, min(times)


@pytest.mark.parametrize("tip", [0.0, 0.5])
@pytest.mark.parametrize("speed", [0.0, 15.0, 40.0])
def test_a_beam_has_the_frequencies_of_its_finite_elements(speed, tip, capsys):
    radius = 0.2
    mechanism = eigentol.Mechanism.from_text(declaration(10, tip))

    def by_beam():
        # A study remembers what it has found.
        study = eigentol.Study(mechanism, inputs={"omega": speed}, design={"radius": radius})
        return np.sort(study.modes().eigenvalues.imag)[:3]

    ours, own_time = timed(by_beam)
    theirs, their_time = timed(lambda: by_elements(64, speed, radius, tip))
    # Elements converge with the fourth power of their length from above.
    coarse = by_elements(32, speed, radius, tip)
    limit = theirs + (theirs - coarse) / 15
    error = theirs / limit - 1
    own_error = ours / limit - 1
    with capsys.disabled():
        print(f"\nspeed {speed}, tip {tip}: 64 elements {their_time:.2f} ms, errors {error};", end=" ")
        print(f"10 coordinates {own_time:.2f} ms, errors {own_error}")
    assert (np.abs(ours / theirs - 1) <= 1.2 * error + 2e-9).all()
    assert (np.abs(ours / theirs - 1) <= 1e-6).all()
