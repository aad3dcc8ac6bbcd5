//! Rotors that were refused, or lost answers, with numbers from finite elements in another program (degrees 7 and 9 agree).

use eigentol::forced::Measure;
use eigentol::{Complex, DesignVariable, Input, Output, Study};

use crate::beams::compared::machine;

/// Material removed from what is declared thicker than its bore: random designs of the compiler's checks, in which an oversize of
/// nominally nothing is a tenth of a metre, decide nothing. How many variables are declared is no matter.
#[test]
fn an_oversize_of_nothing_is_no_lack_of_mass() {
    for others in 0..6 {
        let others: String = (0..others).map(|k| format!("design other{k} = 1 kg +/- 5%;")).collect();
        for body in [
            "body thing: shaft(along: x, up: z, material: steel, sections: [[300 mm, 50 mm + over, 40 mm]]) spinning at omega;
                point g: ground; point p: thing at root;
                force held: bushing(from: g, to: p, stiffness: [0, 1, 1] MN/m, turning_stiffness: [0, 1, 1] MN*m/rad);",
            "body thing: tube(density: 7850 kg/m^3, inner: 40 mm, outer: 50 mm + over, length: 300 mm, axis: x);
                joint slides: prismatic(x) from ground to thing; force held: spring(on: slides, stiffness: 1 kN/m);",
        ] {
            let text = format!(
                "mechanism Oversize {{ input omega: rad/s; {others} design over = 0 mm +/- 0.05 mm;
                    material steel: density 7850 kg/m^3, modulus 200 GPa, poisson 0.3; {body} }}"
            );
            assert!(!Study::new(machine(&text)).modes().expect("modes").modes.is_empty());
        }
    }
}

/// Whether a shaft that bends twists too, and nothing holds its rotation: the phase under an unbalance depends on where it stands,
/// the amplitude and its derivatives do not.
#[test]
fn a_free_rotation_has_derivatives_of_amplitudes() {
    let study = |lines: &str| {
        let text = format!(
            "mechanism Rotor {{ input omega: rad/s; design k = 20 MN/m; design u = 500 g*mm;
                material steel: density 7850 kg/m^3, modulus 205 GPa, poisson 0.3;
                body rotor: shaft(along: x, up: z, material: steel, lines: {lines}, sections: [[400 mm, 80 mm], [600 mm, 80 mm]])
                    spinning at omega;
                body wheel: rigid(mass: 40 kg, inertia: [0.8, 0.45, 0.45] kg*m^2);
                joint turns: revolute(x) from rotor at station 1 to wheel, driven at omega;
                point seat_a: ground; point a: rotor at root; point seat_b: ground at [1, 0, 0] m; point b: rotor at tip;
                force left: bushing(from: seat_a, to: a, stiffness: [0, k, k], damping: [0, 10, 10] kN*s/m);
                force right: bushing(from: seat_b, to: b, stiffness: [0, k, k], damping: [0, 10, 10] kN*s/m);
                unbalance heavy: on wheel, amount: u;
                point middle: rotor at station 1; output y = position(middle).y; }}"
        );
        Study::new(machine(&text)).input(Input::new(0), 314.0)
    };
    let [plain, free] = ["bending", "[bending, torsion]"].map(|lines| {
        let all = study(lines).forced_sensitivities().expect("a response");
        all.modulus(0, Output::new(0), Measure::Displacement).expect("derivatives")
    });
    for (a, b) in plain.iter().zip(free.iter()) {
        assert!((a - b).abs() < 1e-9 * a.abs(), "{a} {b}");
    }
}

/// A slight cone in one row and in eight.
#[test]
fn a_slight_cone_is_eight_shorter_ones() {
    for line in ["torsion", "bending"] {
        let study = |rows: usize| {
            let end = |k: usize| 60.0 - 2.0 * k as f64 / rows as f64;
            let row = |k: usize| format!("[{} m, taper({} mm, {} mm)],", 1.0 / rows as f64, end(k), end(k + 1));
            let rows: String = (0..rows).map(row).collect();
            Study::new(machine(&format!(
                "mechanism Cone {{ input omega: rad/s;
                    material steel: density 7850 kg/m^3, modulus 200 GPa, poisson 0.3;
                    body rotor: shaft(along: x, up: z, material: steel, lines: {line}, sections: [{rows}]) spinning at omega;
                    body wheel: rigid(mass: 5 kg, inertia: [0.02, 0.01, 0.01] kg*m^2);
                    joint turns: revolute(x) from rotor at root to wheel, driven at omega;
                    point seat_a: ground; point a: rotor at root; point seat_b: ground at [1, 0, 0] m; point b: rotor at tip;
                    force left: bushing(from: seat_a, to: a, stiffness: [100, 100, 100] MN/m, turning_stiffness: [1, 0, 0] MN*m/rad);
                    force right: bushing(from: seat_b, to: b, stiffness: [0, 100, 100] MN/m); }}"
            )))
        };
        let [one, eight] = [1, 8].map(|rows| study(rows).input(Input::new(0), 500.0).modes().expect("modes").modes);
        for (one, eight) in one.iter().zip(&eight).take(6) {
            assert!((one.s - eight.s).norm() < 2e-7 * eight.s.norm(), "{line}: {} {}", one.s, eight.s);
        }
    }
}

/// A cone whose tip is a variable, in one row and in sixteen: derivatives where it does not taper yet, and modes where it does.
#[test]
fn a_cone_may_grow_from_none() {
    let study = |rows: usize| {
        let end = |k: usize| format!("60 mm + (tip - 60 mm) * {k} / {rows}");
        let row = |k: usize| format!("[1 m / {rows}, taper({}, {})],", end(k), end(k + 1));
        let rows: String = (0..rows).map(row).collect();
        let text = format!(
            "mechanism Cone {{ input omega: rad/s; design tip = 60 mm;
                material steel: density 7850 kg/m^3, modulus 200 GPa, poisson 0.3;
                body rotor: shaft(along: x, up: z, material: steel, sections: [{rows}]) spinning at omega;
                point seat_a: ground; point a: rotor at root; point seat_b: ground at [1, 0, 0] m; point b: rotor at tip;
                force left: bushing(from: seat_a, to: a, stiffness: [0, 100, 100] MN/m);
                force right: bushing(from: seat_b, to: b, stiffness: [0, 100, 130] MN/m); }}"
        );
        Study::new(machine(&text)).input(Input::new(0), 300.0)
    };
    let studies = [1, 16].map(study);
    let [one, sixteen] = studies.each_ref().map(|study| study.sensitivities().expect("derivatives").modes);
    for (mode, (one, sixteen)) in one.iter().zip(&sixteen).enumerate().take(6) {
        let [a, b] = [one, sixteen].map(|mode| mode.s().expect("derivatives").by_design[0].im);
        assert!((a - b).abs() < 1e-6 * b.abs(), "{mode}: {a} {b}");
    }
    for (tip, tolerance) in [(50e-3, 1e-6), (40e-3, 5e-6)] {
        let [one, sixteen] = studies
            .each_ref()
            .map(|study| study.clone().design(DesignVariable::new(0), tip).modes().expect("modes").modes);
        for (one, sixteen) in one.iter().zip(&sixteen).take(8) {
            assert!((one.s - sixteen.s).norm() < tolerance * one.s.norm(), "{tip}: {} {}", one.s, sixteen.s);
        }
    }
}

/// A stiff shaft on very soft springs, of whose slow modes rounding leaves five digits: two across, equal and not three, one along
/// and one about the axis.
#[test]
fn two_equal_modes_of_soft_springs_are_two() {
    let study = Study::new(machine(
        "mechanism Soft { input omega: rad/s;
            material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
            material titanium: density 4430 kg/m^3, modulus 114 GPa, poisson 0.34;
            body rotor: shaft(along: x, up: z, lines: [bending, torsion, stretch], sections: [
                [0.1148 m, taper(0.0433715 m, 0.0441007 m), 0.0253748 m, titanium],
                [0.05604 m, 0.0702506 m, 0 m, steel],
                [0.04688 m, 0.0295434 m, 0 m, steel],
                [0.1149 m, taper(0.0758718 m, 0.0615267 m), 0 m, steel]]) spinning at omega;
            point seat: ground at [0.1148, 0, 0] m; point journal: rotor at station 1;
            force film: bushing(from: seat, to: journal, stiffness: [0, 100e3, 100e3] N/m, damping: [0, 10, 10] N*s/m);
            point base: ground; point end: rotor at root;
            force soft: bushing(from: base, to: end, stiffness: [1e3, 1e3, 1e3] N/m, turning_stiffness: [1, 1, 1] N*m/rad); }",
    ));
    let modes = study.input(Input::new(0), 0.0).modes().expect("modes").modes;
    let slow: Vec<f64> = modes.iter().map(|mode| mode.s.im).filter(|frequency| *frequency < 100.0).collect();
    let expected = [12.177_171, 12.177_171, 13.108_294, 17.522_529];
    assert!(slow.len() == expected.len(), "{slow:?}");
    assert!(slow.iter().zip(expected).all(|(found, expected)| (found / expected - 1.0).abs() < 1e-5), "{slow:?}");
}

/// A short stiff shaft whose material lags, in stiff damped bearings: four modes, and where the first meets the speed.
#[test]
fn a_stiff_rotor_that_lags_keeps_its_modes_and_its_critical_speed() {
    let study = Study::new(machine(
        "mechanism Stiff { input omega: rad/s;
            material steel: density 7850 kg/m^3, modulus 209 GPa, poisson 0.3;
            body rotor: shaft(along: x, up: z, material: steel, lag: 5 us, sections: [[60 mm, 70 mm]]) spinning at omega;
            body wheel: rigid(mass: 1.2 kg, inertia: [0.0167, 0.0084, 0.0084] kg*m^2, center: [45 mm, 0, 0]);
            joint turns: revolute(x) from rotor at root to wheel, driven at omega;
            body small: rigid(mass: 0.4 kg, inertia: [0.00234, 0.00121, 0.00121] kg*m^2);
            joint follows: revolute(x) from rotor at tip to small, driven at omega;
            point seat_a: ground; point a: rotor at root; point seat_b: ground at [60, 0, 0] mm; point b: rotor at tip;
            force left: bushing(from: seat_a, to: a, stiffness: [0, 76, 76] GN/m, damping: [0, 7, 7] kN*s/m,
                turning_stiffness: [0, 370, 370] MN*m/rad);
            force right: bushing(from: seat_b, to: b, stiffness: [0, 185, 185] GN/m, damping: [0, 11, 11] kN*s/m); }",
    ));
    let modes = study.clone().input(Input::new(0), 20_000.0).modes().expect("modes").modes;
    let expected = [(-8160.0, 54_175.5), (-7237.0, 89_581.1), (-1886.0, 138_580.0), (-2648.0, 143_203.0)];
    for (re, im) in expected {
        let s = Complex::new(re, im);
        assert!(modes.iter().any(|mode| (mode.s - s).norm() < 1e-5 * s.norm()), "{s}");
    }
    let events = study.events(Input::new(0), 2000.0, 60_000.0, &[1.0]).expect("events");
    let [only] = &events.crossings[..] else { panic!("{:?}", events.crossings.len()) };
    assert!((only.value - 41_747.130_1).abs() < 1e-3, "{}", only.value);
}

/// Along a speed forward modes become faster and backward ones slower: another is among the twelve lowest in the end, and is found.
#[test]
fn others_become_the_lowest_along_a_speed() {
    let study = Study::new(machine(
        "mechanism Members { input omega: rad/s;
            material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
            body rotor: shaft(along: x, up: z, material: steel, sections: [[300 mm, 50 mm], [500 mm, 60 mm], [200 mm, 50 mm]])
                spinning at omega;
            body wheel: disk(mass: 30 kg, radius: 250 mm, axis: x);
            joint turns: revolute(x) from rotor at station 1 to wheel, driven at omega;
            body small: disk(mass: 10 kg, radius: 150 mm, axis: x);
            joint follows: revolute(x) from rotor at tip to small, driven at omega;
            point seat_a: ground; point a: rotor at root; point seat_b: ground at [800, 0, 0] mm; point b: rotor at station 2;
            force left: bushing(from: seat_a, to: a, stiffness: [0, 40, 50] MN/m, damping: [0, 3, 3] kN*s/m);
            force right: bushing(from: seat_b, to: b, stiffness: [0, 40, 50] MN/m, damping: [0, 3, 3] kN*s/m); }",
    ));
    let speeds: Vec<f64> = (0..41).map(|k| 200.0 * f64::from(k)).collect();
    let along =
        study.sweep(Input::new(0), &speeds).expect("a sweep").points.pop().expect("points").modes.expect("modes");
    let alone = study.input(Input::new(0), 8000.0).modes().expect("modes");
    for mode in &alone.modes {
        let near = |other: &eigentol::Mode| (other.s - mode.s).norm() < 1e-9 * mode.s.norm();
        assert!(along.modes.iter().any(near), "{}", mode.s);
    }
}

/// The coefficients of a bearing overshoot between two values that are close to each other: what cannot be resolved there does not hide
/// the critical speeds behind it.
#[test]
#[ignore = "takes half a minute"]
fn what_is_not_resolved_hides_nothing_behind_it() {
    let study = Study::new(machine(
        "mechanism Overshooting { input omega: rad/s;
            material steel: density 7850 kg/m^3, modulus 200164297390.45728 Pa, poisson 0.3;
            body rotor: shaft(along: z, up: y, material: steel, sections: [
                [0.320526443755132 m, 0.05205604722457029 m],
                [0.05220136049481073 m, 0.05251417059987304 m, 0.047498070694920944 m]]) spinning at omega;
            body wheel: rigid(mass: 2.9161897135706685 kg, inertia: [0.004854142300869299, 0.004854142300869299, 0.009413744919383592] kg*m^2);
            joint turns: revolute(z) from rotor at station 1 to wheel, driven at omega;
            body end: rigid(mass: 2.845874976908174 kg, inertia: [0.0013205238499854636, 0.0013205238499854636, 0.0025351155231595193] kg*m^2,
                center: [0, 0, -0.034661004498053476] m);
            joint follows: revolute(z) from rotor at station 2 to end, driven at omega;
            point seat_a: ground; point a: rotor at station 0;
            curve k: [0.0, 18591.74716053292, 25282.746570160107, 25333.383651157026, 54584.52999999999] rpm
                -> [0.6750100800999065, 1.0329954810151585, 1.2596906399565801, 1.2084122139017823, 1.1460772836748938];
            curve c: [0.0, 18591.74716053292, 25282.746570160107, 25333.383651157026, 54584.52999999999] rpm
                -> [0.637167873303928, 1.0490205778299078, 1.2191559058123158, 1.0438625773795107, 1.1132031697225202];
            force left: bushing(from: seat_a, to: a,
                stiffness: k(omega) * ([[72627478.5215903, 0, 0], [0, 46341434.67849449, 0], [0, 0, 0]] N/m),
                damping: c(omega) * ([[4091.3774186587384, 818.2754837317477, 0], [818.2754837317477, 2610.5862856780573, 0], [0, 0, 0]] N*s/m));
            point seat_b: ground at [0, 0, 0.320526443755132] m; point b: rotor at station 1;
            force middle: bushing(from: seat_b, to: b, stiffness: [75222590.36208694, 75222590.36208694, 0] N/m,
                damping: [12491.496126030086, 12491.496126030086, 0] N*s/m);
            point seat_c: ground at [0, 0, 0.37272780424994273] m; point d: rotor at station 2;
            force right: bushing(from: seat_c, to: d,
                stiffness: [[59378587.71162114, 6166768.712809863, 0], [-6166768.712809863, 42901718.769740865, 0], [0, 0, 0]] N/m,
                damping: [[3699.423001624081, 0, 0], [0, 2672.876054189565, 0], [0, 0, 0]] N*s/m); }",
    ));
    let rpm = core::f64::consts::PI / 30.0;
    let events = study.events(Input::new(0), 5450.0 * rpm, 54_530.0 * rpm, &[1.0]).expect("events");
    for expected in [35_213.7, 36_497.6, 49_725.9] {
        let near = |value: f64| (value / rpm - expected).abs() < 0.1;
        assert!(
            events.crossings.iter().any(|crossing| near(crossing.value)),
            "{expected} {:?} {:?}",
            events.crossings.iter().map(|x| x.value / rpm).collect::<Vec<_>>(),
            events.searched
        );
    }
}

/// Pairs of motions without oscillation begin to oscillate within the ranges: which modes are the lowest changes, and critical speeds
/// do not depend on where a range begins. The first ones are those of finite elements in another program.
#[test]
fn critical_speeds_do_not_depend_on_the_range() {
    let study = |damping: &str, stiffness: &str, other: f64| {
        let bearing = |name: &str, place: &str| {
            format!(
                "point {name}_seat: ground at [{place}, 0, 0]; point {name}: rotor at {};
                 force {name}_film: bushing(from: {name}_seat, to: {name}, stiffness: [0, k(speed), {other} * k(speed)],
                     damping: [0, c(speed), c(speed)]);",
                if name == "left" { "root" } else { "tip" }
            )
        };
        Study::new(machine(&format!(
            "mechanism Films {{ input speed: rpm;
                curve c: [1000, 3000, 5000, 7000, 9000] rpm -> [{damping}] kN*s/m;
                curve k: [1000, 3000, 5000, 7000, 9000] rpm -> [{stiffness}] MN/m;
                material steel: density 7850 kg/m^3, modulus 205 GPa, poisson 0.29;
                body rotor: shaft(along: x, up: z, material: steel,
                    sections: [[400 mm, 120 mm], [400 mm, 120 mm], [400 mm, 120 mm], [400 mm, 120 mm]]) spinning at speed;
                body disk: rigid(mass: 150 kg, inertia: [2, 1.2, 1.2] kg*m^2);
                joint turns: revolute(x) from rotor at station 2 to disk, driven at speed; {} {} }}",
            bearing("left", "0 m"),
            bearing("right", "1.6 m")
        )))
    };
    let rpm = std::f64::consts::TAU / 60.0;
    let crossings = |study: &Study<_>, low: f64, high: f64| {
        let found = study.campbell(Input::new(0), &[low * rpm, high * rpm], &[1.0]).expect("a diagram");
        let searched = found.searched.as_ref().expect("a search");
        assert!(searched.unresolved.is_empty(), "{low} to {high}: {:?}", searched.unresolved);
        let all = found.crossings.iter().chain(&found.not_excited);
        let mut all: Vec<f64> = all.map(|own| own.value / rpm).collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let round = study("400, 250, 150, 100, 80", "60, 60, 62, 66, 72", 1.0);
    for (low, high) in [(1000.0, 9000.0), (1500.0, 7000.0), (2000.0, 7000.0), (1200.0, 9000.0), (2500.0, 5000.0)] {
        let all = crossings(&round, low, high);
        assert!(all.len() == 2, "{low} to {high}: {all:?}");
        assert!((all[0] - 3024.86).abs() < 0.01 && (all[1] - 3030.255).abs() < 0.01, "{all:?}");
    }
    // Here some of those that begin cross the line at once, and a state may lie within rounding of where they do.
    let soft = study("250, 147.1, 86.6, 51.0, 30", "40, 40, 40, 40, 40", 1.6);
    let stiff = study("200, 124.467, 77.4597, 48.2057, 30", "60, 60, 60, 60, 60", 1.4);
    for (other, ranges) in [
        (soft, [(3500.0, 9000.0), (5500.0, 7000.0), (2000.0, 6500.0)]),
        (stiff, [(2998.87, 7374.25), (4000.0, 8000.0), (5500.0, 5920.0)]),
    ] {
        let whole = crossings(&other, 1000.0, 9000.0);
        assert!(whole.len() == 6, "{whole:?}");
        for (low, high) in ranges {
            let expected: Vec<f64> = whole.iter().copied().filter(|x| (low..high).contains(x)).collect();
            let all = crossings(&other, low, high);
            assert!(all.len() == expected.len(), "{low} to {high}: {all:?} {expected:?}");
            assert!(all.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-4), "{all:?} {expected:?}");
        }
    }
}
