//! Machines that nothing holds, under loads that follow them: their stiffness has different null vectors on the left and
//! on the right. Eigenvalues against those of the whole system of first order, zeros included, by another library.

use eigentol::kernels::Linear;
use eigentol::{Complex, DesignVariable, Matrix, Stability};
use eigentol_statistics::random::RandomNumbers;
use nalgebra::{DMatrix, DVector};

use super::common::study;

/// Four bars in a row that floats in a plane, with springs and perhaps dampers in the joints, between two thrusts along
/// the first and the last bar.
fn row(random: &mut RandomNumbers, damped: bool) -> String {
    let mut number = |low: f64, high: f64| low + (high - low) * random.fraction();
    let thrust = number(-10.0, 60.0);
    let mut text = format!(
        "body b0: rod(mass: {} kg, length: 1 m, along: x);
         joint float: planar(u: x, v: z, q: y) from ground to b0;",
        number(0.5, 2.0)
    );
    for k in 1..4 {
        text += &format!(
            "body b{k}: rod(mass: {} kg, length: 1 m, along: x);
             joint j{k}: revolute(y) from b{} to b{k} at [1, 0, 0] m;
             force s{k}: spring(on: j{k}, stiffness: {} N*m/rad);",
            number(0.5, 2.0),
            k - 1,
            number(5.0, 20.0)
        );
        if damped {
            let damping = number(0.05, 0.5);
            text += &format!("force d{k}: damper(on: j{k}, damping: {damping} N*m*s/rad);");
        }
    }
    format!(
        "mechanism Row {{
            design p = {thrust} N;
            {text}
            point tail: b0; point tip: b3 at [1, 0, 0] m;
            force push: follower(at: tail, force: [1, 0, 0] * p);
            force pull: follower(at: tip, force: [-1, 0, 0] * p); }}"
    )
}

/// The eigenvalues above and on the real axis, those of zero first: six, found to the root of rounding.
fn eigenvalues(linear: &Linear) -> Vec<Complex> {
    let matrix = |matrix: &Matrix| DMatrix::from_fn(6, 6, |i, j| matrix[i][j]);
    let [mass, damping, stiffness] = [&linear.mass, &linear.damping, &linear.stiffness].map(matrix);
    let factors = mass.lu();
    let [damping, stiffness] = [damping, stiffness].map(|matrix| factors.solve(&matrix).expect("masses"));
    let whole = DMatrix::from_fn(12, 12, |i, j| match (i < 6, j < 6) {
        (true, true) => 0.0,
        (true, false) => f64::from(u8::from(i + 6 == j)),
        (false, true) => -stiffness[(i - 6, j)],
        (false, false) => -damping[(i - 6, j - 6)],
    });
    let mut all: Vec<Complex> = whole.complex_eigenvalues().iter().copied().collect();
    all.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    assert!(all[5].norm() < 1e-5 && all[6].norm() > 1e-2, "{all:?}");
    let above = all.drain(6..).filter(|s| s.im > -1e-9 * s.norm());
    above.collect()
}

/// Whether every one of some numbers is near one of others, or to its conjugate.
fn among(some: &[Complex], others: &[Complex]) -> bool {
    some.iter().all(|a| {
        let near = |b: &Complex| (a - b).norm().min((a - b.conj()).norm()) < 1e-7 * a.norm();
        others.iter().any(near)
    })
}

#[test]
fn modes_of_floating_rows_between_thrusts() {
    let mut random = RandomNumbers::new(5, 0);
    let mut unstable = 0;
    for k in 0..32 {
        let text = row(&mut random, k % 2 == 0);
        let study = study(&text);
        let at = study.equilibrium().unwrap_or_else(|error| panic!("{error}\n{text}"));
        let expected = eigenvalues(&at.linear);
        let modes = study.modes().unwrap_or_else(|error| panic!("{error}\n{text}"));
        let found: Vec<Complex> = modes.modes.iter().map(|mode| mode.s).collect();
        assert_eq!(found[..3], [Complex::ZERO; 3], "{found:?}\n{text}");
        let (found, whole) = (&found[3..], (&found, &expected));
        assert!(among(found, &expected), "{whole:?}\n{text}");
        assert!(among(&expected, found), "{whole:?}\n{text}");
        let grows = expected.iter().any(|s| s.re > 1e-7 * s.norm());
        unstable += usize::from(grows);
        let neutral = at.stability == Stability::Neutral { zero: 3 };
        assert_eq!(neutral, !grows, "{:?}\n{text}", at.stability);
    }
    assert!((4..28).contains(&unstable), "{unstable}");
}

/// Derivatives by the thrust, which the left vectors decide, against differences.
#[test]
fn derivatives_of_floating_rows_between_thrusts() {
    let mut random = RandomNumbers::new(6, 0);
    let mut compared = 0;
    for k in 0..10 {
        let text = row(&mut random, k % 2 == 0);
        let study = study(&text);
        let thrust: DesignVariable<_> = DesignVariable::new(0);
        let at = study.design_values()[0];
        let step = 1e-5 * at.abs();
        let ends = [at - step, at + step].map(|value| {
            let modes = study.clone().design(thrust, value).modes();
            modes.expect("modes").modes
        });
        let modes = study.modes().expect("modes").modes;
        let found = study.sensitivities().expect("derivatives").modes;
        for (k, mode) in modes.iter().enumerate().skip(3) {
            let Some(slopes) = found[k].s() else { continue };
            let [low, high] = ends.each_ref().map(|modes| {
                let others = modes.iter().map(|other| other.s);
                let near = |a: &Complex, b: &Complex| (a - mode.s).norm().total_cmp(&(b - mode.s).norm());
                others.min_by(near).expect("a mode")
            });
            let difference = (high - low) / (2.0 * step);
            let error = (slopes.by_design[0] - difference).norm();
            assert!(
                error < 1e-5 * (difference.norm() + mode.s.norm() / at.abs()),
                "{} {difference}\n{text}",
                slopes.by_design[0]
            );
            compared += 1;
        }
    }
    assert!(compared > 25, "{compared}");
}

/// A row with its second bar split into two that are pinned to each other at both ends, a closed loop.
fn with_a_loop(row: &str, share: f64) -> String {
    let (start, rest) = row.split_once("body b1: rod(mass: ").expect("a second bar");
    let (mass, rest) = rest.split_once(" kg").expect("its mass");
    let mass: f64 = mass.parse().expect("a number");
    let rest = rest.replacen(
        "point tail",
        &format!(
            "body twin: rod(mass: {} kg, length: 1 m, along: x);
             joint root: revolute(y) from b0 to twin at [1, 0, 0] m;
             joint end: revolute(y) from b1 to twin at [1, 0, 0] m at [1, 0, 0] m on twin;
             point tail",
            mass * share
        ),
        1,
    );
    let mass = mass * (1.0 - share);
    format!("{start}body b1: rod(mass: {mass} kg{rest}")
}

/// A bar in two parts moves as in one piece: eigenvalues and derivatives are those of the row without a loop.
#[test]
fn loops_in_floating_rows_between_thrusts() {
    let mut random = RandomNumbers::new(7, 0);
    for k in 0..8 {
        let text = row(&mut random, k % 2 == 0);
        let closed = with_a_loop(&text, 0.1 + 0.8 * random.fraction());
        let [expected, found] = [&text, &closed].map(|text| {
            let derivatives = study(text).sensitivities();
            let derivatives = derivatives.unwrap_or_else(|error| panic!("{error}\n{text}"));
            let slopes = derivatives.modes.into_iter().map(|mode| {
                let slopes = mode.s().map(|slopes| slopes.by_design[0]);
                slopes.unwrap_or_default()
            });
            let modes = study(text).modes().expect("modes").modes;
            let values = modes.iter().map(|mode| mode.s);
            values.zip(slopes).collect::<Vec<_>>()
        });
        assert_eq!(found.len(), expected.len(), "{closed}");
        for ((s, slope), (exact, exact_slope)) in found.iter().zip(&expected) {
            let error = (s - exact).norm();
            assert!(error <= 1e-8 * exact.norm(), "{s} {exact}\n{closed}");
            let error = (slope - exact_slope).norm();
            let size = exact_slope.norm() + exact.norm();
            assert!(error <= 1e-6 * size, "{slope} {exact_slope}\n{closed}");
        }
    }
}

/// Rods in a row under a thrust at the end of the first, which falls as fast as it is pushed: the thrust turns with the
/// whole, which accelerates it across.
struct Missile {
    text: String,
    /// By place of the nozzle across and angle of each rod: mass, stiffness and damping at rest.
    matrices: [DMatrix<f64>; 3],
}

impl Missile {
    fn new(random: &mut RandomNumbers, rods: usize, (thrust, damped): (f64, bool)) -> Self {
        let mut number = |low: f64, high: f64| low + (high - low) * random.fraction();
        let masses: Vec<f64> = (0..rods).map(|_| number(0.5, 2.0)).collect();
        let acceleration = thrust / masses.iter().sum::<f64>();
        let size = rods + 1;
        let [mut mass, mut stiffness, mut damping] = [(); 3].map(|()| DMatrix::zeros(size, size));
        let mut text = format!(
            "mechanism Missile {{
                input thrust: N;
                gravity thrust / ({} kg) along -x;
                body b0: rod(mass: {} kg, length: 1 m, along: x);
                joint flight: planar(px: x, pz: z, q0: -y) from ground to b0;
                point nozzle: b0; force push: follower(at: nozzle, force: [thrust, 0, 0]);\n",
            masses.iter().sum::<f64>(),
            masses[0]
        );
        for (k, &own) in masses.iter().enumerate() {
            let centre = DVector::from_fn(size, |i, _| match i {
                0 => 1.0,
                i if i <= k => 1.0,
                i if i == k + 1 => 0.5,
                _ => 0.0,
            });
            mass += own * &centre * centre.transpose();
            mass[(k + 1, k + 1)] += own / 12.0;
            for i in 0..=k {
                stiffness[(i + 1, i + 1)] -= own * acceleration * centre[i + 1];
            }
            if k > 0 {
                let (spring, damper) = (number(5.0, 20.0), if damped { number(0.05, 0.5) } else { 0.0 });
                let bend = DVector::from_fn(size, |i, _| f64::from(i == k + 1) - f64::from(i == k));
                stiffness += spring * &bend * bend.transpose();
                damping += damper * &bend * bend.transpose();
                text += &format!(
                    "body b{k}: rod(mass: {own} kg, length: 1 m, along: x);
                     joint j{k}: revolute(-y) from b{} to b{k} at [1 m, 0, 0];
                     force s{k}: spring(on: j{k}, stiffness: {spring} N*m/rad);\n",
                    k - 1
                );
                if damped {
                    text += &format!("force d{k}: damper(on: j{k}, damping: {damper} N*m*s/rad);\n");
                }
            }
        }
        stiffness[(0, 1)] -= thrust;
        Self { text: text + "}", matrices: [mass, stiffness, damping] }
    }

    /// The eigenvalues that are not zero, above and on the real axis.
    fn eigenvalues(&self) -> Vec<Complex> {
        let [mass, stiffness, damping] = &self.matrices;
        let n = mass.nrows();
        let factors = mass.clone().lu();
        let [stiffness, damping] = [stiffness, damping].map(|matrix| factors.solve(matrix).expect("masses"));
        let whole = DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
            (true, _) => f64::from(u8::from(i + n == j)),
            (false, true) => -stiffness[(i - n, j)],
            (false, false) => -damping[(i - n, j - n)],
        });
        let all: Vec<Complex> = whole.complex_eigenvalues().iter().copied().collect();
        let most = all.iter().fold(0.0, |most: f64, s| most.max(s.norm()));
        // Four zeros are found to the fourth root of rounding.
        let clear = |s: &Complex| s.norm() > 5e-3 * most && s.im > -1e-9 * s.norm();
        all.into_iter().filter(clear).collect()
    }
}

#[test]
fn missiles_under_thrust() {
    let mut random = RandomNumbers::new(8, 0);
    for k in 0..24 {
        let rods = 2 + k % 4;
        let thrust = [0.0, 0.01, 1.0, 3.0, -5.0, 20.0][k % 6] * (1.0 + random.fraction());
        let missile = Missile::new(&mut random, rods, (thrust, k % 3 == 0));
        let study = study(&missile.text).input(eigentol::Input::new(0), thrust);
        let modes = study.modes();
        let modes = modes.unwrap_or_else(|error| panic!("{error}\n{thrust} {}", missile.text));
        let found: Vec<Complex> = modes.modes.iter().map(|mode| mode.s).collect();
        let expected = missile.eigenvalues();
        assert_eq!(found[..3], [Complex::ZERO; 3], "{found:?}\n{}", missile.text);
        let whole = (thrust, &found, &expected);
        assert!(among(&found[3..], &expected), "{whole:?}\n{}", missile.text);
        assert!(among(&expected, &found[3..]), "{whole:?}\n{}", missile.text);
        let shapes = modes.modes.iter().flat_map(|mode| mode.shape.iter().chain(mode.left()));
        assert!(shapes.into_iter().all(|x| x.is_finite()), "{}", missile.text);
        let grows = expected.iter().any(|s| s.re > 1e-7 * s.norm());
        let at = study.equilibrium().expect("an equilibrium");
        let neutral = at.stability == Stability::Neutral { zero: 3 };
        assert_eq!(neutral, !grows, "{:?} {whole:?}\n{}", at.stability, missile.text);
    }
}

/// Two equal rods: `omega^2 = 24 - 3 T`, zero at 8 N. There another motion is neutral.
#[test]
fn two_rods_under_thrust() {
    let text = include_str!("../../../truth/strangers/thrust_two_rods.mechanism");
    for thrust in [0.0, 0.1, 1.0, 3.7, 5.96, 7.0, 7.99, 8.0, 8.01, 12.0] {
        let study = study(text).input(eigentol::Input::new(0), thrust);
        let modes = study.modes().unwrap_or_else(|error| panic!("{thrust}: {error}"));
        let lambda: Vec<f64> = modes.modes.iter().map(|mode| mode.lambda).collect();
        assert_eq!(lambda[..3], [0.0; 3], "{thrust}");
        for lambda in &lambda[3..] {
            let expected = 24.0 - 3.0 * thrust;
            assert!((lambda - expected).abs() < 1e-11, "{thrust}: {lambda} {expected}");
        }
        let stability = study.equilibrium().expect("an equilibrium").stability;
        let expected = match thrust {
            ..8.0 => Stability::Neutral { zero: 3 },
            8.0 => Stability::Neutral { zero: 4 },
            _ => Stability::Divergent { negative: 1 },
        };
        assert_eq!(stability, expected, "{thrust}");
    }
}

/// A row of rods in weight that its thrust balances, whatever the input.
fn launcher(random: &mut RandomNumbers, damped: bool) -> (String, f64) {
    let mut number = |low: f64, high: f64| low * f64::powf(high / low, random.fraction());
    let rods = number(2.0, 5.0) as usize;
    let each: Vec<[f64; 3]> = (0..rods).map(|_| [number(0.1, 10.0), number(0.3, 3.0), number(0.3, 3.0)]).collect();
    let whole: f64 = each.iter().map(|rod| rod[0]).sum();
    let mut text = format!("input thrust: N; gravity thrust / ({whole} kg) along -x;");
    for (k, [mass, length, stiffness]) in each.iter().enumerate() {
        text += &format!("body b{k}: rod(mass: {mass} kg, length: {length} m, along: x);");
        let Some(last) = k.checked_sub(1) else {
            text += "joint flight: planar(px: x, pz: z, pitch: -y) from ground to b0;";
            continue;
        };
        let at = each[last][1];
        text += &format!(
            "joint h{k}: revolute(-y) from b{last} to b{k} at [{at} m, 0, 0];
             force s{k}: spring(on: h{k}, stiffness: {stiffness} N*m/rad);"
        );
        if damped {
            let damping = number(1e-3, 0.1);
            text += &format!("force d{k}: damper(on: h{k}, damping: {damping} N*m*s/rad);");
        }
    }
    text += "point nozzle: b0; force engine: follower(at: nozzle, force: [thrust, 0, 0]);";
    let softest = each[1..].iter().fold(f64::INFINITY, |least, rod| least.min(rod[2]));
    (format!("mechanism Launcher {{ {text} }}"), number(3.0, 30.0) * softest)
}

/// Along a thrust that turns with a free machine, what a list says is what the eigenvalues of the whole system of first
/// order say at hundreds of thrusts: motions that grow, with oscillation and without.
#[test]
fn events_along_a_thrust_are_those_of_counting() {
    const VALUES: usize = 600;
    let mut random = RandomNumbers::new(8, 0);
    let mut changes = 0;
    for k in 0..6 {
        let (text, most) = launcher(&mut random, k % 3 == 0);
        let study = study(&text);
        let input = eigentol::Input::new(0);
        let linear = |thrust: f64| {
            let at = study.clone().input(input, thrust).equilibrium();
            at.unwrap_or_else(|error| panic!("{error}\n{text}")).linear
        };
        let [still, pushed] = [0.0, most].map(linear);
        let n = still.mass.row_count();
        let matrix = |matrix: &Matrix| DMatrix::from_fn(n, n, |i, j| matrix[i][j]);
        let factors = matrix(&still.mass).lu();
        let solved = |m: &Matrix| -> DMatrix<f64> { factors.solve(&matrix(m)).expect("masses") };
        let [c, k0, k1]: [DMatrix<f64>; 3] = [&still.damping, &still.stiffness, &pushed.stiffness].map(solved);
        let count = |share: f64| {
            let k = &k0 + (&k1 - &k0) * share;
            let whole = DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
                (true, true) => 0.0,
                (true, false) => f64::from(u8::from(i + n == j)),
                (false, true) => -k[(i - n, j)],
                (false, false) => -c[(i - n, j - n)],
            });
            let mut all: Vec<Complex> = whole.complex_eigenvalues().iter().copied().collect();
            all.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
            // Six zeros: two that drift, and a turn that accelerates one of them.
            let grows = all[6..].iter().filter(|s| s.re > 1e-6 * s.norm());
            let (turning, straight): (Vec<&Complex>, Vec<&Complex>) = grows.partition(|s| s.im.abs() > 1e-6 * s.norm());
            [turning.len() / 2, straight.len()]
        };
        let share = |j: usize| (j as f64 + 0.5) / VALUES as f64;
        let counts: Vec<_> = (0..VALUES).map(|j| count(share(j))).collect();
        let expected = counts.windows(2).enumerate().filter(|(_, two)| two[0] != two[1]);
        let expected: Vec<f64> = expected.map(|(j, _)| most * share(j)).collect();
        let values: Vec<f64> = (0..=20).map(|j| most * f64::from(j) / 20.0).collect();
        let sweep = study.sweep(input, &values).expect("a sweep");
        let critical = sweep.critical.iter().map(|state| state.value);
        let flutter = sweep.flutter_onsets.iter().map(|onset| onset.value);
        let found: Vec<f64> = critical.chain(flutter).collect();
        let close = |a: f64, b: f64| (a - b).abs() < 2.5 * most / VALUES as f64;
        let whole = format!("{expected:?} {found:?}\n{text}");
        assert!(expected.iter().all(|a| found.iter().any(|b| close(*a, *b))), "{whole}");
        assert!(found.iter().all(|a| expected.iter().any(|b| close(*a, *b))), "{whole}");
        changes += expected.len();
    }
    assert!(changes > 4, "{changes}");
}

/// A uniform free beam under a thrust that follows its end flutters at `109.69 EI / L^2` (Beal 1965), whatever the range.
#[test]
fn a_flexible_missile_flutters() {
    let text = "mechanism Missile { input thrust: N; gravity thrust / (1 kg) along -x;
        body hull: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 1 N*m^2, bending_y: 9);
        joint flight: planar(px: x, pz: z, pitch: -y) from ground to hull;
        point nozzle: hull at root; force engine: follower(at: nozzle, force: [thrust, 0, 0]); }";
    for range in [[0.0, 130.0], [10.0, 120.0]] {
        let sweep = study(text).sweep(eigentol::Input::new(0), &range);
        let sweep = sweep.expect("a sweep");
        let onsets: Vec<f64> = sweep.flutter_onsets.iter().map(|x| x.value).collect();
        assert!(sweep.critical.is_empty(), "{range:?}");
        assert_eq!(onsets.len(), 1, "{onsets:?}");
        assert!((onsets[0] - 109.69).abs() < 5e-3, "{onsets:?}");
    }
}

/// Where gravity is a function of the thrust, the loads balance at every thrust: what rounding leaves of the difference is no
/// reason to have no derivatives. They are those of frequencies at neighbouring thrusts.
#[test]
fn loads_that_balance_by_a_declared_function_have_derivatives() {
    let mut random = RandomNumbers::new(5, 0);
    for _ in 0..8 {
        let mut number = |low: f64, high: f64| low + (high - low) * random.fraction();
        let (length, mass, thrust) = (number(0.5, 3.0), number(0.2, 4.0), number(1.0, 20.0));
        let text = format!(
            "mechanism Missile {{ input thrust: N; gravity thrust / ({mass} kg/m * {length} m) along -x;
            body hull: beam(length: {length} m, along: x, up: z, mass_per_length: {mass} kg/m, stiffness_y: 9 N*m^2,
                bending_y: 4);
            joint flight: planar(px: x, pz: z, pitch: -y) from ground to hull;
            point nozzle: hull at root; force engine: follower(at: nozzle, force: [thrust, 0, 0]); }}"
        );
        let thrust_input = eigentol::Input::new(0);
        let at = |thrust: f64| study(&text).input(thrust_input, thrust);
        let slopes = at(thrust).sensitivities().unwrap_or_else(|error| panic!("{text}: {error}"));
        let step = 1e-4 * thrust;
        let beside = [thrust - step, thrust + step].map(|thrust| at(thrust).modes().expect("modes"));
        let mut compared = 0;
        for (k, mode) in slopes.modes.iter().enumerate() {
            let Some(found) = mode.frequency() else { continue };
            let [low, high] = [&beside[0], &beside[1]].map(|modes| modes.modes[k].frequency().expect("a frequency"));
            let expected = (high - low) / (2.0 * step);
            assert!((found.by_input[0] - expected).abs() < 1e-6 * (expected.abs() + high / thrust), "{text} mode {k}");
            compared += 1;
        }
        assert!(compared >= 4, "{text}");
    }
}
