//! Machines of any size, in the language of the macro.

use std::fmt::Write;

use eigentol_interpreter::Interpreted;

/// Masses in a row on springs, as many design variables as coordinates.
pub(crate) fn storeys(n: usize) -> Interpreted {
    let mut text = "mechanism Storeys {".to_owned();
    let mut before = "ground".to_owned();
    for k in 0..n {
        let _ = write!(
            text,
            "design k{k} = 1 MN/m +/- 3%; body b{k}: point(mass: 1 t); \
             joint d{k}: prismatic(x) from {before} to b{k}; \
             force s{k}: spring(on: d{k}, stiffness: k{k});"
        );
        before = format!("b{k}");
    }
    read(&(text + "}"))
}

/// Masses in a row on springs in two directions of a turning frame, with a damper each where `damping` (N s/m) is not
/// zero.
pub(crate) fn turning(n: usize, damping: f64) -> Interpreted {
    let mut text = "mechanism Turning { input speed: rad/s; body shaft: massless; \
                    joint turn: revolute(z) from ground to shaft, driven at speed;"
        .to_owned();
    let mut before = "shaft".to_owned();
    for k in 0..n / 2 {
        let _ = write!(
            text,
            "design k{k} = 1 MN/m +/- 3%; design m{k} = 1 kg +/- 1%; \
             body h{k}: massless; body b{k}: point(mass: m{k}); \
             joint x{k}: prismatic(x) from {before} to h{k}; \
             joint y{k}: prismatic(y) from h{k} to b{k}; \
             force s{k}: spring(on: x{k}, stiffness: k{k}); \
             force t{k}: spring(on: y{k}, stiffness: 1.1 * k{k});"
        );
        if damping != 0.0 {
            let _ = write!(text, "force d{k}: damper(on: x{k}, damping: {damping} N*s/m);");
        }
        before = format!("b{k}");
    }
    read(&(text + "}"))
}

/// A shaft of different sections between two bearings, with a disk in its middle.
pub(crate) fn shaft(n: usize) -> Interpreted {
    let sections: String = (0..n).map(|k| format!("[2 m / {n}, d + {k} um],")).collect();
    read(&format!(
        "mechanism Rotor {{ input speed: rad/s; design d = 0.1 m +/- 0.1 mm; design k = 50 MN/m +/- 10%; \
         material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3; \
         body rotor: shaft(along: x, up: z, material: steel, sections: [{sections}]) spinning at speed; \
         body disk: rigid(mass: 30 kg, inertia: [0.6, 0.3, 0.3] kg*m^2); \
         joint turn: revolute(x) from rotor at station {middle} to disk, driven at speed; \
         point journal[0]: rotor at station {first}; point seat[0]: ground at [0.25 m, 0, 0]; \
         point journal[1]: rotor at station {last}; point seat[1]: ground at [1.75 m, 0, 0]; \
         for i in 0..2 {{ force bearing[i]: bushing(from: seat[i], to: journal[i], stiffness: [0, k, 1.2 * k], \
         damping: [0, 20, 20] kN*s/m); }} }}",
        middle = n / 2,
        first = n / 8,
        last = n - n / 8,
    ))
}

/// The lowest critical speed of a turning machine, rad/s.
pub(crate) fn critical_speed(n: usize) -> f64 {
    2.0e3 * (std::f64::consts::FRAC_PI_2 / (n + 1) as f64).sin()
}

fn read(text: &str) -> Interpreted {
    Interpreted::from_text(text).expect("a declaration")
}
