use eigentol::equilibrium::{Search, equilibrium, find_equilibria};
use eigentol::motion::accelerations;
use eigentol::{
    Coordinate, DesignVariable, Equilibrium, Error, Input, Kernels, Matrix, Policy, Real, Stability, Study,
};

use super::bordered::bordered;
use super::models::{FOUR_BAR, FourBar, Point, SLIDER, SliderCrank, Truss, four_bar_potential};
use crate::common::dual::Dual;
use crate::common::{GRAVITY, close};

#[test]
fn a_point_on_a_rod_is_a_pendulum() {
    let (m, l) = (2.0, 0.7);
    let critical = (GRAVITY / l).sqrt();
    for factor in [0.0, 0.5, 0.99, 1.01, 1.5, 4.0] {
        let omega = factor * critical;
        let study = Study::new(bordered(Point))
            .input(Input::new(0), omega)
            .start(Coordinate::new(0), 0.3)
            .guess(Coordinate::new(1), -0.2);
        let state = study.equilibrium().expect("an equilibrium");
        let cos = if factor > 1.0 { 1.0 / factor.powi(2) } else { 1.0 };
        let sin = (1.0 - cos * cos).sqrt();
        let [x, y, force] = state.coordinates[..] else { panic!("three unknowns") };
        assert!((x - l * sin).abs() < 1e-12 * l, "{factor}: {x}");
        close(y, -l * cos, 1e-12);
        // The rod is in tension: weight and centrifugal force along it.
        close(force, m * GRAVITY * cos + m * omega * omega * l * sin * sin, 1e-11);
        assert_eq!(state.stability, Stability::Stable);
        assert!(state.relative_residual < 2e-10);
    }
}

#[test]
fn unstable_states_are_left_and_kept() {
    let u = [0.0];
    let b = [2.0, 0.7];
    let top = [0.0, 0.7, 0.0];
    let nearest = equilibrium(&bordered(Point), &u, &b, &top, Policy::Nearest).expect("the top");
    assert_eq!(nearest.stability, Stability::Divergent { negative: 1 });
    close(nearest.coordinates[2], -2.0 * GRAVITY, 1e-13);
    for start in [top, [1e-3, 0.69, 0.0], [-0.5, 0.5, 3e4]] {
        let stable = equilibrium(&bordered(Point), &u, &b, &start, Policy::Stable).expect("below");
        close(stable.coordinates[1], -0.7, 1e-13);
        close(stable.coordinates[2], 2.0 * GRAVITY, 1e-12);
        assert!(stable.left_unstable_region && stable.stability == Stability::Stable);
    }
    // At rest on a fast turntable the bottom is a saddle; the start value decides the side.
    for side in [-1.0, 1.0] {
        let start = [side * 1e-2, -0.7, 0.0];
        let out = equilibrium(&bordered(Point), &[6.0], &b, &start, Policy::Stable).expect("out");
        assert!(out.coordinates[0] * side > 0.3, "{:?}", out.coordinates);
    }
}

#[test]
fn a_structure_cannot_move() {
    let study = Study::new(bordered(Truss)).input(Input::new(0), 7.0).guess(Coordinate::new(1), -1.0);
    let state = study.equilibrium().expect("an equilibrium");
    let (weight, height, half) = (2.0 * GRAVITY, 1.2, 0.5);
    assert!(state.coordinates[0].abs() < 1e-14);
    close(state.coordinates[1], -height, 1e-14);
    // Equilibrium of the joint: (left - right) half / l = load, (left + right) height / l = weight.
    let (sum, difference) = (weight * 1.3 / height, 7.0 * 1.3 / half);
    close(state.coordinates[2], 0.5 * (sum + difference), 1e-13);
    close(state.coordinates[3], 0.5 * (sum - difference), 1e-13);
    assert_eq!(state.constraints.freedom, 0);
    assert_eq!(state.stability, Stability::Stable);
}

/// Potential and reduced mass of a mechanism with one freedom.
trait Minimal {
    fn potential<T: Real>(&self, t: T) -> T;
    fn mass(&self, t: f64) -> f64;
}

/// The zero of `V'` near `t`, with `V''` over the mass.
fn minimum(model: &impl Minimal, mut t: f64) -> (f64, f64) {
    for _ in 0..60 {
        let (first, second) = derivatives(model, t);
        let step = (first / second.abs()).clamp(-0.2, 0.2);
        t -= step;
    }
    (t, derivatives(model, t).1 / model.mass(t))
}

fn derivatives(model: &impl Minimal, t: f64) -> (f64, f64) {
    let at = Dual::new(Dual::new(t, 1.0), Dual::new(1.0, 0.0));
    let value = model.potential(at);
    (value.value.slope, value.slope.slope)
}

struct MinimalFourBar<'a> {
    b: &'a [f64; 8],
    omega: f64,
    side: f64,
}

impl MinimalFourBar<'_> {
    fn points<T: Real>(&self, t: T) -> [T; 4] {
        let b = self.b.map(T::constant);
        let (sin, cos) = t.sin_cos();
        let (ax, ay) = (b[2] * cos, b[2] * sin);
        let (dx, dy) = (b[5] - ax, -ay);
        let square = dx * dx + dy * dy;
        let two = T::constant(2.0);
        let along = T::constant(0.5) + (b[3] * b[3] - b[4] * b[4]) / (two * square);
        let across = T::constant(self.side) * (b[3] * b[3] / square - along * along).sqrt();
        [ax, ay, ax + along * dx - across * dy, ay + along * dy + across * dx]
    }
}

impl Minimal for MinimalFourBar<'_> {
    fn potential<T: Real>(&self, t: T) -> T {
        let b = self.b.map(T::constant);
        four_bar_potential(&self.points(t), T::constant(self.omega), &b)
    }

    fn mass(&self, t: f64) -> f64 {
        let rates = self.points(Dual::new(t, 1.0)).map(|x| x.slope);
        let [ax, ay, bx, by] = rates;
        self.b[0] * (ax * ax + ay * ay) + self.b[1] * (bx * bx + by * by)
    }
}

/// `phi^T K_c phi / phi^T M phi` along the only free direction.
fn rayleigh(state: &Equilibrium, direction: &[f64]) -> f64 {
    let n = direction.len();
    let form = |matrix: &Matrix| -> f64 {
        (0..n).map(|i| (0..n).map(|j| direction[i] * matrix[i][j] * direction[j]).sum::<f64>()).sum()
    };
    form(&state.linear.stiffness) / form(&state.linear.mass)
}

#[test]
fn a_four_bar_with_a_diagonal_spring() {
    for omega in [0.0, 2.0, 4.0] {
        for (side, guess) in [(1.0, [0.6, 0.5]), (-1.0, [0.4, -0.4])] {
            let model = MinimalFourBar { b: &FOUR_BAR, omega, side };
            let study = Study::new(bordered(FourBar))
                .input(Input::new(0), omega)
                .start(Coordinate::new(0), 0.2)
                .guess(Coordinate::new(1), -0.3)
                .guess(Coordinate::new(2), guess[0])
                .guess(Coordinate::new(3), guess[1]);
            let state = study.equilibrium().expect("an equilibrium");
            let [ax, ay, bx, by, ..] = state.coordinates[..] else { panic!("four coordinates") };
            let (t, lambda) = minimum(&model, ay.atan2(ax));
            let expected = model.points(t);
            for (have, want) in [ax, ay, bx, by].into_iter().zip(expected) {
                assert!((have - want).abs() < 1e-11, "{omega} {side}: {have} {want}");
            }
            let rates = model.points(Dual::new(t, 1.0)).map(|x| x.slope);
            let mut direction = [0.0; 7];
            direction[..4].copy_from_slice(&rates);
            close(rayleigh(&state, &direction), lambda, 1e-9);
            assert_eq!(state.stability, Stability::Stable);
        }
    }
}

struct MinimalSlider {
    gravity: f64,
}

impl MinimalSlider {
    /// Centres and angles, as in the absolute coordinates.
    fn places<T: Real>(&self, t: T) -> [T; 7] {
        let [_, _, _, l1, l2, ..] = SLIDER.map(T::constant);
        let half = T::constant(0.5);
        let (s1, c1) = t.sin_cos();
        let rod = -(l1 * s1 / l2).asin();
        let (s2, c2) = rod.sin_cos();
        [half * l1 * c1, half * l1 * s1, t, l1 * c1 + half * l2 * c2, l1 * s1 + half * l2 * s2, rod, l1 * c1 + l2 * c2]
    }
}

impl Minimal for MinimalSlider {
    fn potential<T: Real>(&self, t: T) -> T {
        let [m1, m2, _, _, _, k, s0] = SLIDER.map(T::constant);
        let p = self.places(t);
        let stretch = p[6] - s0;
        T::constant(self.gravity) * (m1 * p[1] + m2 * p[4]) + T::constant(0.5) * k * stretch * stretch
    }

    fn mass(&self, t: f64) -> f64 {
        let rates = self.places(Dual::new(t, 1.0)).map(|x| x.slope);
        let [m1, m2, m3, l1, l2, ..] = SLIDER;
        let masses = [m1, m1, m1 * l1 * l1 / 12.0, m2, m2, m2 * l2 * l2 / 12.0, m3];
        rates.iter().zip(masses).map(|(v, m)| m * v * v).sum()
    }
}

#[test]
fn a_slider_crank_under_gravity() {
    for (gravity, crank) in [(GRAVITY, 1.2), (GRAVITY, -1.0), (40.0, -0.9), (0.0, 0.8)] {
        let study = Study::new(bordered(SliderCrank)).input(Input::new(0), gravity).start(Coordinate::new(2), crank);
        let state = study.equilibrium().expect("an equilibrium");
        let model = MinimalSlider { gravity };
        let (t, lambda) = minimum(&model, state.coordinates[2]);
        for (have, want) in state.coordinates.iter().zip(model.places(t)) {
            assert!((have - want).abs() < 1e-11, "{gravity}: {have} {want}");
        }
        let rates = model.places(Dual::new(t, 1.0)).map(|x| x.slope);
        let mut direction = [0.0; 13];
        direction[..7].copy_from_slice(&rates);
        close(rayleigh(&state, &direction), lambda, 1e-9);
        // The slider's equation: the spring balances the pin force.
        let spring = SLIDER[5] * (state.coordinates[6] - SLIDER[6]);
        assert!((spring + state.coordinates[11]).abs() < 1e-10 * (1.0 + spring.abs()));
        assert_eq!(state.stability, Stability::Stable);
    }
}

/// Total derivatives, including reactions, against differences of re-solved states.
fn check_shift(study: &Study<impl Kernels>, scale: impl Fn(usize) -> f64) {
    let state = study.equilibrium().expect("an equilibrium");
    let shift = study.equilibrium_shift().expect("regular");
    for variable in 0..state.design.len() {
        let solve = |offset: f64| {
            let mut b = state.design.clone();
            b[variable] += offset;
            equilibrium(study.mechanism(), &state.inputs, &b, &state.coordinates, Policy::Stable)
                .expect("an equilibrium nearby")
                .coordinates
        };
        let h = 1e-3 * state.design[variable].abs();
        let (far, near) = ((solve(h), solve(-h)), (solve(0.5 * h), solve(-0.5 * h)));
        for i in 0..state.coordinates.len() {
            let coarse = (far.0[i] - far.1[i]) / (2.0 * h);
            let fine = (near.0[i] - near.1[i]) / h;
            let difference = fine + (fine - coarse) / 3.0;
            let exact = shift.by_design[i][variable];
            let size = scale(i) / state.design[variable];
            assert!((exact - difference).abs() < 1e-8 * size, "{i} by {variable}: {exact} {difference}");
        }
    }
}

#[test]
fn derivatives_of_states_and_reactions() {
    let scale = |motions: usize| move |i| if i < motions { 1.0 } else { 100.0 };
    let study = Study::new(bordered(Point))
        .input(Input::new(0), 5.0)
        .start(Coordinate::new(0), 0.5)
        .guess(Coordinate::new(1), -0.3);
    check_shift(&study, scale(2));
    let study = Study::new(bordered(FourBar))
        .input(Input::new(0), 2.0)
        .start(Coordinate::new(0), 0.2)
        .guess(Coordinate::new(1), -0.3)
        .guess(Coordinate::new(2), 0.6)
        .guess(Coordinate::new(3), 0.5);
    check_shift(&study, scale(4));
    let study = Study::new(bordered(SliderCrank)).input(Input::new(0), GRAVITY).start(Coordinate::new(2), -1.0);
    check_shift(&study, scale(7));
    let study = Study::new(bordered(Truss)).input(Input::new(0), 7.0).guess(Coordinate::new(1), -1.0);
    check_shift(&study, scale(2));
}

#[test]
fn several_starts_find_both_ends() {
    let search = Search::new([-2.0, -2.0, -1e6], [2.0, 2.0, 1e6]).starts(20).seed(3);
    let found = find_equilibria(&bordered(Point), &[6.0], &[2.0, 0.7], &[0.1; 3], &search, eigentol::Watch::default())
        .expect("valid values");
    // Two stable ones outside, plus the bottom and the top.
    assert_eq!(found.len(), 4, "{:?}", found.iter().map(|s| &s.coordinates).collect::<Vec<_>>());
}

#[test]
fn a_sweep_follows_the_assembly_mode() {
    let study = Study::new(bordered(FourBar))
        .start(Coordinate::new(0), 0.2)
        .guess(Coordinate::new(1), -0.3)
        .guess(Coordinate::new(2), 0.4)
        .guess(Coordinate::new(3), -0.4);
    let values: Vec<f64> = (0..=20).map(|i| 0.25 * f64::from(i)).collect();
    let sweep = study.sweep(Input::new(0), &values).expect("valid handles");
    for point in &sweep {
        let state = point.equilibrium.as_ref().expect("an equilibrium");
        let [ax, ay, bx, by, ..] = state.coordinates[..] else { panic!("four coordinates") };
        let model = MinimalFourBar { b: &FOUR_BAR, omega: point.value, side: -1.0 };
        let points = model.points(minimum(&model, ay.atan2(ax)).0);
        let off = [ax, ay, bx, by].into_iter().zip(points).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-10, "at {}", point.value);
    }
}

#[test]
fn accelerations_of_a_swinging_point() {
    let (m, l, t, rate) = (2.0, 0.7, 0.4_f64, 1.3);
    let (sin, cos) = t.sin_cos();
    let q = [l * sin, -l * cos, 1e3];
    let velocity = [l * cos * rate, l * sin * rate, 17.0];
    let values = accelerations(&bordered(Point), &velocity, &q, &[0.0], &[m, l]).expect("regular");
    let swing = -GRAVITY / l * sin;
    close(values[0], l * (swing * cos - rate * rate * sin), 1e-13);
    close(values[1], l * (swing * sin + rate * rate * cos), 1e-13);
    close(values[2], m * (GRAVITY * cos + l * rate * rate), 1e-13);
    let massless = accelerations(&bordered(Point), &velocity, &q, &[0.0], &[0.0, l]);
    assert!(matches!(massless, Err(Error::SingularMass { .. })));
}

#[test]
fn held_values_are_kept_until_it_moves() {
    let study = Study::new(bordered(FourBar))
        .design(DesignVariable::new(6), 0.0)
        .start(Coordinate::new(0), 0.2)
        .guess(Coordinate::new(1), -0.3)
        .guess(Coordinate::new(2), 0.4)
        .guess(Coordinate::new(3), -0.4);
    assert_eq!(study.assembly().expect("it closes").coordinates[0], 0.2);
    assert_eq!(study.start_values()[1], -0.3);
    let state = study.equilibrium().expect("an equilibrium");
    assert_ne!(state.coordinates[0], 0.2);
    let text = state.to_string();
    assert!(text.contains("reaction") && text.contains("coupler [N]"), "{text}");
}
