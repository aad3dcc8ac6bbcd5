//! The rotor of Nelson and McVaugh with a rigid shaft, on two bearings, against its four equations in complex numbers.
//!
//! With `u, v` the displacements of the axis at the origin and `a, b` its tilts about x and y, a station at the height
//! `z` moves by `u + b z` and `v - a z`. About the origin the rotor has the mass `m`, the first moment `S`, the second
//! moment `J` across the axis and `P` about it, so that `D = K + i W (C + W P G) - W^2 M`.

use eigentol::forced::{ForcedSensitivities, Measure};
use eigentol::{Complex, Output, Study};
use eigentol_interpreter::Interpreted;
use nalgebra::{Matrix4, SVector};

type C = nalgebra::Complex<f64>;
type D = Matrix4<C>;
type Z = SVector<C, 4>;

const I: C = C::new(0.0, 1.0);

/// Length, outer and inner diameter of the sections of the shaft, m.
const SECTIONS: [[f64; 3]; 18] = [
    [0.0127, 0.0102, 0.0],
    [0.0381, 0.0204, 0.0],
    [0.0254, 0.0152, 0.0],
    [0.0127, 0.0406, 0.0],
    [0.0127, 0.0406, 0.0],
    [0.0051, 0.066, 0.0],
    [0.0076, 0.066, 0.0304],
    [0.0127, 0.0508, 0.0356],
    [0.0076, 0.0508, 0.0],
    [0.0305, 0.0254, 0.0],
    [0.0254, 0.0254, 0.0],
    [0.0381, 0.0304, 0.0],
    [0.0381, 0.0304, 0.0],
    [0.0203, 0.0254, 0.0],
    [0.0178, 0.0254, 0.0],
    [0.0102, 0.0762, 0.0],
    [0.0304, 0.0406, 0.0],
    [0.0127, 0.0406, 0.0304],
];
const DENSITY: f64 = 7806.0;
/// Stations of the disk and of the bearings, of the second unbalance, and those that are observed.
const DISK: usize = 4;
const BEARINGS: [usize; 2] = [10, 14];
const UNBALANCES: [usize; 2] = [DISK, 15];
const OBSERVED: [usize; 4] = [0, 4, 10, 14];
const SPEEDS: [f64; 4] = [1000.0, 1700.0, 3000.0, 6000.0];

/// Stiffness `kxx, kxy, kyx, kyy` of each bearing, N/m.
const ISOTROPIC: [f64; 4] = [4.378e7, 0.0, 0.0, 4.378e7];
const ORTHOTROPIC: [f64; 4] = [3.503e7, -8.756e6, -8.756e6, 3.503e7];
/// Damping of each bearing, N s/m.
const DAMPING: f64 = 1752.0;
/// Mass, moments of inertia across and about the axis of the disk, kg and kg m^2.
const OF_DISK: [f64; 3] = [1.401, 0.00136, 0.002];
/// First moments of mass, kg m, and their angles.
const AMOUNTS: [[f64; 2]; 2] = [[6.35e-6, 0.0], [2e-6, 1.2]];

fn station(k: usize) -> f64 {
    SECTIONS[..k].iter().map(|section| section[0]).sum()
}

fn declaration([kxx, kxy, kyx, kyy]: [f64; 4]) -> String {
    let section = |(k, [length, diameter, hole]): (usize, &[f64; 3])| {
        let (outer, inner) = (0.5 * diameter, 0.5 * hole);
        let middle = station(k) + 0.5 * length;
        let shape = match inner {
            0.0 => "cylinder(radius:".to_owned(),
            _ => format!("tube(inner: {inner:?} m, outer:"),
        };
        format!(
            "{shape} {outer:?} m, density: {DENSITY:?} kg/m^3, length: {length:?} m, axis: z) at [0, 0, {middle:?}] m"
        )
    };
    let shaft: Vec<String> = SECTIONS.iter().enumerate().map(section).collect();
    let mut text = format!(
        "mechanism Rotor {{
        input omega: rad/s;
        design mass = {:?} kg;
        design across = {:?} kg*m^2;
        design about = {:?} kg*m^2;
        design kxx = {kxx:?} N/m;
        design kxy = {kxy:?} N/m;
        design kyx = {kyx:?} N/m;
        design kyy = {kyy:?} N/m;
        design c = {DAMPING:?} N*s/m;
        design amount0 = {:?} kg*m;
        design amount1 = {:?} kg*m;
        design angle1 = {:?} rad;
        body seat: massless;
        body rotor: rigid(mass: mass, inertia: [across, across, about]) at [0, 0, {:?}] m + {};
        joint lie: free(u: x, v: y, w: z, a: x, b: y, c0: z) from ground to seat, w driven at 0, c0 driven at 0;
        joint spin: revolute(z) from seat to rotor, driven at omega;
        unbalance first: on rotor, amount: amount0, at [0, 0, {:?}] m;
        unbalance second: on rotor, amount: amount1, angle: angle1, at [0, 0, {:?}] m;\n",
        OF_DISK[0],
        OF_DISK[1],
        OF_DISK[2],
        AMOUNTS[0][0],
        AMOUNTS[1][0],
        AMOUNTS[1][1],
        station(DISK),
        shaft.join(" + "),
        station(UNBALANCES[0]),
        station(UNBALANCES[1]),
    );
    for k in BEARINGS {
        let z = station(k);
        text += &format!(
            "point foot{k}: ground at [0, 0, {z:?}] m;
             point journal{k}: seat at [0, 0, {z:?}] m;
             force film{k}: bushing(from: foot{k}, to: journal{k},
                stiffness: [[kxx, kxy, 0], [kyx, kyy, 0], [0, 0, 0]], damping: [c, c, 0]);\n"
        );
    }
    for k in OBSERVED {
        let z = station(k);
        text += &format!(
            "point station{k}: seat at [0, 0, {z:?}] m;
             output x{k} = position(station{k}).x;
             output y{k} = position(station{k}).y;\n"
        );
    }
    text + "}"
}

fn real(rows: [[f64; 4]; 4]) -> D {
    D::from_fn(|i, j| C::from(rows[i][j]))
}

/// Inertia of a body of mass `m`, with its centre at the height `z` and the moment `j` across the axis about it.
fn inertia(m: f64, z: f64, j: f64) -> D {
    let (s, j) = (m * z, j + m * z * z);
    real([[m, 0.0, 0.0, s], [0.0, m, -s, 0.0], [0.0, -s, j, 0.0], [s, 0.0, 0.0, j]])
}

/// Gyroscopic matrix of a unit of `P W`.
fn gyroscopic() -> D {
    let mut matrix = D::zeros();
    matrix[(2, 3)] = C::from(1.0);
    matrix[(3, 2)] = C::from(-1.0);
    matrix
}

/// The displacements x and y of the axis at the height `z`.
fn seen(z: f64) -> [Z; 2] {
    let row = |entries: [f64; 4]| Z::from_fn(|i, _| C::from(entries[i]));
    [row([1.0, 0.0, 0.0, z]), row([0.0, 1.0, -z, 0.0])]
}

/// What both bearings exert with coefficients `xx, xy, yx, yy`.
fn bearings([xx, xy, yx, yy]: [f64; 4]) -> D {
    let mut sum = D::zeros();
    for k in BEARINGS {
        let [x, y] = seen(station(k));
        for (row, column, coefficient) in [(x, x, xx), (x, y, xy), (y, x, yx), (y, y, yy)] {
            sum += row * column.transpose() * C::from(coefficient);
        }
    }
    sum
}

/// The force `(1, -i) W^2 e^{i angle}` of a unit of unbalance.
fn unbalance(z: f64, angle: f64, w: f64) -> Z {
    let [x, y] = seen(z);
    (x - y * I) * (C::from(w * w) * C::from_polar(1.0, angle))
}

/// The motion, and its derivatives by name.
fn solved(stiffness: [f64; 4], w: f64) -> (Z, Vec<(&'static str, Z, f64)>) {
    let [mass, across, about] = OF_DISK;
    let mut m = inertia(mass, station(DISK), across);
    let mut polar = about;
    for (k, [length, outer, inner]) in SECTIONS.iter().enumerate() {
        let [outer, inner] = [outer, inner].map(|diameter| 0.25 * diameter * diameter);
        let own = DENSITY * std::f64::consts::PI * (outer - inner) * length;
        let squares = outer + inner;
        m += inertia(own, station(k) + 0.5 * length, own * (3.0 * squares + length * length) / 12.0);
        polar += 0.5 * own * squares;
    }
    let (of_speed, square) = (I * w, C::from(-w * w));
    let c = bearings([DAMPING, 0.0, 0.0, DAMPING]);
    let turning = gyroscopic() * C::from(polar);
    let stiff = bearings(stiffness) + (c + turning * C::from(w)) * of_speed + m * square;
    let forces = [0, 1].map(|k| unbalance(station(UNBALANCES[k]), AMOUNTS[k][1], w));
    let [one, other] = [0, 1].map(|k| forces[k] * C::from(AMOUNTS[k][0]));
    let factors = stiff.lu();
    let solve = |force: Z| factors.solve(&force).expect("no resonance");
    let z = solve(one + other);
    let softer = |of: D| solve(-(of * z));
    let unit = |k: usize| {
        let mut entries = [0.0; 4];
        entries[k] = 1.0;
        softer(bearings(entries))
    };
    let by_speed = c * I + turning * (I * 2.0 * w) - m * C::from(2.0 * w);
    let slopes = vec![
        ("mass", softer(inertia(1.0, station(DISK), 0.0) * square), mass),
        ("across", softer(inertia(0.0, 0.0, 1.0) * square), across),
        ("about", softer(gyroscopic() * C::from(w) * of_speed), about),
        ("kxx", unit(0), stiffness[0]),
        ("kxy", unit(1), 1e6),
        ("kyx", unit(2), 1e6),
        ("kyy", unit(3), stiffness[3]),
        ("c", softer(bearings([1.0, 0.0, 0.0, 1.0]) * of_speed), DAMPING),
        ("amount0", solve(forces[0]), AMOUNTS[0][0]),
        ("amount1", solve(forces[1]), AMOUNTS[1][0]),
        ("angle1", solve(other * I), AMOUNTS[1][1]),
        ("omega", solve((one + other) * C::from(2.0 / w) - by_speed * z), w),
    ];
    (z, slopes)
}

fn compare(study: &Study<Interpreted>, forced_sensitivities: &ForcedSensitivities, expected: (Z, Vec<(&str, Z, f64)>)) {
    let (z, slopes) = expected;
    let measure = Measure::Displacement;
    let rows = OBSERVED.iter().flat_map(|&k| seen(station(k)));
    for (o, row) in rows.enumerate() {
        let output = Output::new(o);
        let distance = |complex: Complex, exact: C| (complex.re - exact.re).hypot(complex.im - exact.im);
        let y = forced_sensitivities.response.harmonics[0].amplitude(output, measure).expect("an output");
        let exact = row.dot(&z);
        let error = distance(y, exact) / exact.norm();
        assert!(error < 1e-12, "{o}: {y} {exact} {error:e}");
        let own = forced_sensitivities.complex(0, output, measure).expect("slopes");
        for (name, slope, size) in &slopes {
            let slope = row.dot(slope);
            let dy = match study.find_input(name) {
                Ok(input) => own.by_input[input.index()],
                Err(_) => own.by_design[study.find_design(name).expect("a variable").index()],
            };
            let error = distance(dy, slope) / slope.norm().max(1e-3 * exact.norm() / size);
            assert!(error < 1e-10, "{o} by {name}: {dy} {slope} {error:e}");
        }
    }
}

#[test]
fn a_rigid_rotor_on_two_bearings_vibrates_as_its_four_equations() {
    for stiffness in [ISOTROPIC, ORTHOTROPIC] {
        let text = declaration(stiffness);
        let machine = Interpreted::from_text(&text).unwrap_or_else(|error| panic!("{error}"));
        for w in SPEEDS {
            let study = Study::new(machine.clone());
            let input = study.find_input("omega").expect("an input");
            let study = study.input(input, w);
            let found = study.forced_sensitivities().expect("vibrates");
            compare(&study, &found, solved(stiffness, w));
        }
    }
}
