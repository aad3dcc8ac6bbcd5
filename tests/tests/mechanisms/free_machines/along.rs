//! Free machines along an input.

use eigentol::{Behaviour, Coordinate, Input};

use super::common::{close, study};

/// Two masses that nothing holds along the axis of a turning base, and are held across it: the free motion takes part in
/// no critical state, and `omega = sqrt(k / m)` has its derivatives.
#[test]
fn critical_speeds_beside_a_free_motion() {
    let study = study(
        "mechanism Carousel {
            input speed: rad/s; design m = 2 kg +/- 1%;
            body base: massless; joint turn: revolute(x) from ground to base, driven at speed;
            body s: massless; body t: massless; body a: point(mass: m); body b: point(mass: m);
            joint ax: prismatic(x) from base to s; joint ay: prismatic(y) from s to a;
            joint bx: prismatic(x) from base to t; joint by: prismatic(y) from t to b;
            force c: generalized(on: ax, value: (300 N/m) * (bx - ax));
            force d: generalized(on: bx, value: (300 N/m) * (ax - bx));
            force e: spring(on: ay, stiffness: 2000 N/m); force f: spring(on: by, stiffness: 1000 N/m);
        }",
    );
    let found = study.campbell(Input::new(0), &[0.0, 40.0], &[] as &[f64]).expect("a diagram");
    assert_eq!(found.critical.len(), 2);
    for (event, k) in found.critical.iter().zip([1000.0_f64, 2000.0]) {
        let speed = (k / 2.0).sqrt();
        close(event.value, speed, 1e-11, "critical speed");
        let spread = event.spread.as_ref().expect("a derivative");
        close(spread.by_design[0], -speed / 4.0, 1e-9, "its derivative");
    }
    let branches = study.branches(Input::new(0), 0.0, 40.0).expect("branches");
    assert_eq!(branches.special().len(), 2);
}

/// A ball on a turning table goes round at 2/7 of the table's rate, wherever it is; its orientation is free.
#[test]
fn a_ball_on_a_turning_table() {
    let ball = |travel: &str, table: &str| {
        let text = format!(
            "mechanism Table {{
                input omega: rad/s; gravity 9.81 m/s^2 along -z;
                body table: disk(mass: 3 kg, radius: 1 m, axis: z); body base: massless; body mast: massless;
                body ball: sphere(mass: 1 kg, radius: 5 cm);
                joint turn: revolute(z) from ground to table, {table};
                joint travel: planar(px: x, py: y, yaw: z) from ground to base, {travel} yaw driven at 0 rad/s;
                joint height: prismatic(z) from base to mast at [0, 0, 5 cm];
                joint roll: universal(alpha: x, beta: y) from mast to ball;
                point center: ball; point plate: table;
                constraint contact: rolling(wheel: center, radius: 5 cm, on: plate); }}"
        );
        study(&text)
    };
    for travel in ["", "px coasting, py coasting,"] {
        let study = ball(travel, "driven at omega").input(Input::new(0), 3.0);
        let modes = study.modes().expect("modes").modes;
        let free = modes.iter().filter(|mode| mode.behaviour == Behaviour::Free);
        assert_eq!((free.count(), modes.len()), (2, 3));
        close(modes[2].frequency().expect("it goes round"), 6.0 / 7.0, 1e-12, "rate");
        let slopes = study.sensitivities().expect("derivatives");
        let by_speed = slopes.modes[2].frequency().expect("of the rate").by_input[0];
        close(by_speed, 2.0 / 7.0, 1e-10, "by the table's rate");
    }
}

/// On a table that coasts, the ball is free along it while the table rests; of the motions in which the table turns it
/// is not.
#[test]
fn a_ball_on_a_coasting_table() {
    let study = study(
        "mechanism Table {
            gravity 9.81 m/s^2 along -z;
            body table: disk(mass: 3 kg, radius: 1 m, axis: z); body base: massless; body mast: massless;
            body ball: sphere(mass: 1 kg, radius: 5 cm);
            joint turn: revolute(z) from ground to table, coasting;
            joint travel: planar(px: x, py: y, yaw: z) from ground to base, yaw driven at 0 rad/s;
            joint height: prismatic(z) from base to mast at [0, 0, 5 cm];
            joint roll: universal(alpha: x, beta: y) from mast to ball;
            point center: ball; point plate: table;
            constraint contact: rolling(wheel: center, radius: 5 cm, on: plate); }",
    );
    let speed = study.description().coordinates.iter().position(|coordinate| coordinate.name == *"turn");
    let study = study.start(Coordinate::new(speed.expect("a speed")), 3.0);
    let modes = study.modes().expect("modes").modes;
    let round: Vec<f64> = modes.iter().filter_map(|mode| mode.frequency()).collect();
    assert_eq!(round.len(), 1);
    close(round[0], 6.0 / 7.0, 1e-12, "rate");
}

/// A coin that rolls in circles, faster and faster: sweeps, diagrams and branches follow the members that the
/// declaration or the user holds, each the one that is found alone.
#[test]
fn members_of_a_family_along_an_input() {
    let coin = |held: &str| {
        let text = format!(
            "mechanism Coin {{
                input rate: rad/s; design r = 50 cm +/- 1%; gravity 9.81 m/s^2 along -z;
                body base: massless; body mast: massless; body fork: massless;
                body wheel: disk(mass: 1 kg, radius: r, axis: y);
                joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
                joint height: prismatic(z) from base to mast; joint lean: revolute(x) from mast to fork;
                joint spin: revolute(y) from fork to wheel, coasting;
                point hub: wheel; point road: ground;
                constraint contact: rolling(wheel: hub, axis: y, radius: r, on: road);
                {held} steady yaw = -rate; }}"
        );
        let study = study(&text);
        let place = |name: &str| {
            let all = &study.description().coordinates;
            Coordinate::new(all.iter().position(|x| x.name == *name).expect("a name"))
        };
        let (height, lean) = (place("height"), place("lean"));
        (study.guess(height, 0.5), lean)
    };
    let (declared, _) = coin("steady lean = 20 deg;");
    let (asked, lean) = coin("");
    let asked = asked.hold(lean, 20_f64.to_radians());
    let rates = [1.0, 1.3, 1.6, 2.0];
    for study in [declared, asked] {
        let found = study.sweep(Input::new(0), &rates).expect("a sweep");
        assert!(found.critical.is_empty() && found.flutter_onsets.is_empty());
        for (point, &rate) in found.points.iter().zip(&rates) {
            let alone = study.clone().input(Input::new(0), rate);
            let state = point.equilibrium.as_ref().expect("a state");
            let modes = point.modes.as_ref().expect("modes");
            let expected = alone.equilibrium().expect("a state");
            for (a, b) in state.coordinates.iter().zip(&expected.coordinates) {
                close(*a, *b, 1e-9, "a coordinate");
            }
            let [own, other] = [modes, &alone.modes().expect("modes")].map(|modes| {
                let all = modes.modes.iter().filter_map(|mode| mode.frequency());
                all.fold(0.0, f64::max)
            });
            close(own, other, 1e-10, "the frequency");
        }
        let diagram = study.campbell(Input::new(0), &[1.0, 2.0], &[1.0]).expect("a diagram");
        for crossing in &diagram.crossings {
            let there = study.clone().input(Input::new(0), crossing.value);
            let modes = there.modes().expect("modes").modes;
            let all = modes.iter().filter_map(|mode| mode.frequency());
            let nearest = all.map(|x| (x - crossing.value).abs());
            assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-9);
        }
        let branches = study.branches(Input::new(0), 1.0, 2.0).expect("branches");
        let branch = &branches.branches[0];
        let last = branch.points.last().expect("a point");
        close(last.value, 2.0, 1e-12, "the end of the branch");
        let expected = study.clone().input(Input::new(0), 2.0).equilibrium().expect("a state");
        for (a, b) in last.equilibrium.coordinates.iter().zip(&expected.coordinates) {
            close(*a, *b, 1e-9, "a coordinate at the end");
        }
    }
}

/// A pendulum kept upright by its start stays there along an input.
#[test]
fn an_upright_pendulum_along_an_input() {
    let study = study(
        "mechanism Up {
            input speed: rad/s; gravity 9.81 m/s^2 along -z;
            body shaft: massless; joint turn: revolute(z) from ground to shaft, driven at speed;
            body bar: rod(mass: 3 kg, length: 1 m, along: -z); joint q: revolute(y) from shaft to bar; }",
    );
    let upright = study.start(Coordinate::new(0), std::f64::consts::PI);
    let found = upright.sweep(Input::new(0), &[0.0, 1.0, 3.0]).expect("a sweep");
    for point in &found.points {
        let state = point.equilibrium.as_ref().expect("a state");
        let modes = point.modes.as_ref().expect("modes");
        close(state.coordinates[0], std::f64::consts::PI, 1e-12, "upright");
        let growth = (1.5 * 9.81 + point.value * point.value).sqrt();
        assert!(modes.modes.iter().any(|own| (own.s.re - growth).abs() < 1e-10));
    }
}
