//! A follower force and a rigid-body mode: non-symmetric and singular stiffness, in closed form.

use eigentol_tests::machines::{sliding_pair, ziegler_column};
use eigentol_tests::rederived::{Machine, State};

use super::common::{assert_close, assert_within};

struct Column {
    machine: Machine,
    design: Vec<f64>,
}

impl Column {
    fn new(damping: f64) -> Self {
        let machine = Machine::new(ziegler_column::DECLARATION);
        let mut design = machine.nominal().to_vec();
        design[3] = damping;
        Self { machine, design }
    }

    /// At `P = p k / l`.
    fn at(&self, p: f64) -> State {
        let [_, l, k, _] = self.design[..] else { panic!("four variables") };
        self.machine.at(&[p * k / l], &self.design, &[0.0; 2])
    }

    /// `m l^2`.
    fn inertia(&self) -> f64 {
        self.design[0] * self.design[1].powi(2)
    }
}

/// The largest real part of the eigenvalues.
fn growth(state: &State) -> f64 {
    let parts = state.eigenvalues().into_iter().map(|s| s.re);
    parts.fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn frequencies_under_a_follower_force() {
    let column = Column::new(0.0);
    let [_, l, k, _] = column.design[..] else { panic!("four variables") };
    for p in [0.0, 0.5, 1.5, 2.0, 2.08, 5.0, 6.0] {
        let state = column.at(p);
        // 2 x^2 - h x + 1 = 0.
        let h: f64 = 7.0 - 2.0 * p;
        let root = (h * h - 8.0).sqrt();
        for (mode, sign) in state.general_modes().iter().zip([-1.0, 1.0]) {
            let mode = mode.as_ref().expect("a simple mode");
            if h < -8.0_f64.sqrt() {
                // Both x are negative: two growing and two decaying real pairs.
                assert_eq!(mode.s.im.value, 0.0);
                continue;
            }
            let x = (h + sign * root) / 4.0;
            // Variables m, l, k, c and P; p depends on l, k and P: dx/dp = -2 x / (4 x - h).
            let omega = (x * k / column.inertia()).sqrt();
            let dx = -2.0 * x / (4.0 * x - h);
            let by_p = 0.5 * omega / x * dx;
            let force = p * k / l;
            let gradient = [
                -0.5 * omega / column.design[0],
                -omega / l + by_p * force / k,
                0.5 * omega / k - by_p * p / k,
                0.0,
                by_p * l / k,
            ];
            let what = format!("p = {p}");
            assert_close(&[mode.s.im.value], &[omega], 0.0, &what);
            assert_within(1e-9, &mode.s.im.gradient, &gradient, 1e-3, &what);
        }
        if p >= 5.0 {
            let rates: Vec<f64> = state.eigenvalues().iter().map(|s| s.re).collect();
            let expected = [-1.0, 1.0].map(|sign| {
                let x: f64 = (h + sign * root) / 4.0;
                (-x * k / column.inertia()).sqrt()
            });
            for rate in expected {
                let found = |one: &f64| rates.iter().any(|s| (s - one).abs() < 1e-9 * rate);
                assert!(found(&rate) && found(&-rate), "{rates:?} and {rate}");
            }
        }
    }
}

/// `P l / k = 2.086`, undamped: two frequencies meet and give way to a growing pair.
#[test]
fn flutter_of_the_undamped_column() {
    let column = Column::new(0.0);
    let critical = 3.5 - 2.0_f64.sqrt();
    assert!((critical - 2.086).abs() < 5e-4);
    for offset in [1e-2, 1e-5] {
        let below = column.at(critical - offset);
        assert!(growth(&below).abs() < 1e-8, "{:?}", below.eigenvalues());
        let above = column.at(critical + offset);
        // x = (h +- sqrt(h^2 - 8)) / 4 with h^2 - 8 = -8 sqrt(2) offset + 4 offset^2; |x|^2 = 1/2.
        let h = 7.0 - 2.0 * (critical + offset);
        let angle = (8.0 - h * h).sqrt().atan2(h);
        let size = (column.design[2] / column.inertia()).sqrt() * 0.5_f64.powf(0.25);
        let rate = size * (0.5 * angle).sin();
        assert_within(1e-7, &[growth(&above)], &[rate], 0.0, "growth");
        assert_eq!(above.eigenvalues().len(), 2);
    }
    // Where they meet, neither has a derivative.
    assert_eq!(column.at(critical).general_modes(), [None, None]);
}

/// Any damping, however small, reduces the flutter load by a third: `41/28 + c^2 / (2 m l^2 k)`.
#[test]
fn flutter_of_the_damped_column() {
    for damping in [1e-3, 0.1, 2.0] {
        let column = Column::new(damping);
        let square = damping * damping / (column.inertia() * column.design[2]);
        let critical = 41.0 / 28.0 + 0.5 * square;
        let state = column.at(critical);
        assert!(growth(&state).abs() < 1e-8, "{:?}", state.eigenvalues());
        assert!(growth(&column.at(critical - 1e-3)) < 0.0);
        assert!(growth(&column.at(critical + 1e-3)) > 0.0);
        assert!(critical < 3.5 - 2.0_f64.sqrt());
    }
}

/// Without its anchor the pair drifts: a double eigenvalue `s = 0`, and one frequency.
#[test]
fn a_rigid_body_mode() {
    let machine = Machine::new(sliding_pair::DECLARATION);
    let nominal = machine.nominal().to_vec();
    let [m1, m2, _, coupling] = nominal[..] else { panic!("four variables") };
    let free = [m1, m2, 0.0, coupling];
    let elastic = (coupling * (m1 + m2) / (m1 * m2)).sqrt();
    let complexes = machine.eigenvalues(&[], &free, &[0.0, 0.05]);
    let (last, drifting) = complexes.split_last().expect("eigenvalues");
    assert!((last.im - elastic).abs() < 1e-10 * elastic && last.re.abs() < 1e-10, "{last}");
    // One or both of the double zero, depending on rounding.
    assert!(!drifting.is_empty());
    for s in drifting {
        assert!(s.norm() < 1e-6 * elastic, "{s}");
    }

    for anchor in [1e-3, 10.0, 1e3] {
        let state = machine.at(&[], &[m1, m2, anchor, coupling], &[0.0; 2]);
        // m1 m2 x^2 - e x + ka kc = 0, x = w^2.
        let e = m1 * coupling + m2 * (anchor + coupling);
        let root = (e * e - 4.0 * m1 * m2 * anchor * coupling).sqrt();
        let large = (e + root) / (2.0 * m1 * m2);
        let squares = [anchor * coupling / (m1 * m2 * large), large];
        for (mode, x) in state.undamped_modes().iter().zip(squares) {
            let mode = mode.as_ref().expect("a simple mode");
            assert_close(&[mode.lambda.value], &[x], 0.0, "lambda");
            // Derivatives by m1, m2, ka, kc, from the equation.
            let slope = 2.0 * m1 * m2 * x - e;
            let gradient = [
                m2 * x * x - coupling * x,
                m1 * x * x - (anchor + coupling) * x,
                coupling - m2 * x,
                anchor - (m1 + m2) * x,
            ]
            .map(|rate| -rate / slope);
            assert_within(1e-9, &mode.lambda.gradient, &gradient, 1e-3 * x, "gradient");
        }
    }
}
