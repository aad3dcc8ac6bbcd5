//! The mechanisms used in the figures.

use std::path::{Path, PathBuf};

use eigentol::{Campbell, Study, mechanism};
use eigentol_figures::Figure;

mechanism! {
    /// A bar hinged on a spinning shaft: upright below sqrt(3 g / (2 l)), then it swings out.
    pub(crate) mechanism Pendulum {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

mechanism! {
    /// Two bars in series on a spinning shaft, every dimension on its own.
    pub(crate) mechanism Bars {
        input omega: rad/s;
        design l1 = 1.0 m +/- 3%;
        design l2 = 1.0 m +/- 3%;
        design m1 = 3.0 kg +/- 3%;
        design m2 = 3.0 kg +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
    }
}

mechanism! {
    /// A disk on an elastic shaft between its bearings, damped at rest and in the shaft.
    pub(crate) mechanism Rotor {
        input speed: rpm;
        design stiffness = 600 kN/m +/- 4%;
        design bending = 9 kN*m/rad +/- 4%;
        design lag = 200 us +/- 30%;
        design radius = 250 mm +/- 0.2 mm;
        design seal_x = 190 kN/m +/- 20%;
        design seal_y = 230 kN/m +/- 20%;
        design seal_damping = 80 N*s/m +/- 30%;
        body across: massless;
        body center: massless;
        body carrier: massless;
        body disk: cylinder(density: 7850 kg/m^3, radius: radius, length: 30 mm, axis: z);
        body line: massless;
        joint turn: revolute(z) from ground to line, driven at speed;
        joint x: prismatic(x) from ground to across;
        joint y: prismatic(y) from across to center;
        joint tilt: universal(alpha: x, beta: y) from center to carrier;
        joint spin: revolute(z) from carrier to disk, driven at speed;
        point straight: line;
        point bent: center;
        force shaft: bushing(from: straight, to: bent,
            stiffness: [stiffness, stiffness, 0], damping: [lag * stiffness, lag * stiffness, 0]);
        force bend_x: spring(on: alpha, stiffness: bending);
        force bend_y: spring(on: beta, stiffness: bending);
        force sideways: spring(on: x, stiffness: seal_x);
        force upwards: spring(on: y, stiffness: seal_y);
        force water_x: damper(on: x, damping: seal_damping);
        force water_y: damper(on: y, damping: seal_damping);
    }
}

mechanism! {
    /// A bar that hangs in oil: overdamped where the oil is thick.
    pub(crate) mechanism Door {
        input oil: N*m*s/rad;
        design l = 1.0 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 3 kg, length: l, along: -z);
        joint theta: revolute(y) from ground to bar;
        force drag: damper(on: theta, damping: oil);
    }
}

mechanism! {
    /// A disk with a residual unbalance on springs of different stiffness: it whirls backward between its resonances.
    pub(crate) mechanism Unbalanced {
        input speed: rpm;
        design kx = 40 kN/m +/- 5%;
        design ky = 70 kN/m +/- 5%;
        design c = 30 N*s/m +/- 20%;
        body across: massless;
        body plate: massless;
        body disk: cylinder(mass: 4 kg, radius: 0.1 m, length: 0.02 m, axis: z);
        joint x: prismatic(x) from ground to across;
        joint y: prismatic(y) from across to plate;
        joint spin: revolute(z) from plate to disk, driven at speed;
        force sideways: spring(on: x, stiffness: kx);
        force upwards: spring(on: y, stiffness: ky);
        force damp_x: damper(on: x, damping: c);
        force damp_y: damper(on: y, damping: c);
        unbalance residual: on disk, amount: 20 g*mm;
        output right = x;
        output up = y;
        output turned = x / 1 m;
    }
}

/// Evenly spaced values from `low` to `high`.
pub(crate) fn values(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = (high - low) / (count.max(2) - 1) as f64;
    (0..count).map(|k| low + step * k as f64).collect()
}

pub(crate) fn pendulum() -> Study<Pendulum> {
    Study::new(Pendulum).start(Pendulum::theta, 1.0)
}

pub(crate) fn bars() -> Study<Bars> {
    Study::new(Bars).start(Bars::theta1, 1.0)
}

pub(crate) fn rotor_diagram(count: usize) -> Campbell {
    let speeds = values(0.0, 6000.0 * std::f64::consts::PI / 30.0, count);
    let found = Study::new(Rotor).campbell(Rotor::speed, &speeds, &[1.0, 2.0]);
    found.expect("the rotor runs at every speed")
}

/// Saves a figure for inspection, checks that it is clean, and returns its text. PNG takes seconds without
/// optimisation, so it is written only if the environment variable `PNG` is set.
pub(crate) fn save(figure: &Figure, name: &str) -> String {
    let folder: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join("figures");
    std::fs::create_dir_all(&folder).expect("a folder for figures");
    let path = folder.join(format!("{name}.svg"));
    figure.save(&path).expect("it can be drawn");
    #[cfg(feature = "png")]
    if std::env::var_os("PNG").is_some() {
        let drawn = figure.save(folder.join(format!("{name}.png")));
        drawn.expect("it can be drawn");
    }
    let text = std::fs::read_to_string(path).expect("it was written");
    assert!(!text.contains("NaN") && !text.contains("inf"), "{name}");
    crate::words::assert_readable(&text, name);
    let data = serde_json::to_string(figure).expect("it is data");
    assert!(!data.contains("null"), "{name}: every number is finite");
    text
}
