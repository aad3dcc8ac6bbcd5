//! Beams whose material spins, and forces all along a beam: momentum, energy and power.

use eigentol::{Complex, Input, Study};
use eigentol_compiler::base::names::written;
use eigentol_interpreter::Interpreted;
use eigentol_oracle::energy;
use eigentol_oracle::model::Model;
use eigentol_oracle::random::Random;

use crate::flexible::judged::{Machine, State, assert_close, judge};
use crate::flexible::moving::rate;

const ROUND: &str = "mass_per_length: 0.6 kg/m, stiffness_y: 9 N*m^2, stiffness_z: 9 N*m^2, torsion_stiffness: 5 N*m^2, \
    inertia_y: 0.02 kg*m, inertia_z: 0.02 kg*m, axial_stiffness: 60 N, shear_stiffness_y: 40 N, shear_stiffness_z: 40 N, \
    bending: 2, torsion: 1";

/// A shaft that floats in space with a pod at its tip, and may turn about the origin.
fn floating(strains: &str) -> Machine {
    Machine::right(&format!(
        "mechanism Floating {{
            body turner: massless;
            body slider: massless;
            body carriage: massless;
            body shaft: beam(length: 1.3 m, along: [1, 2, 2], up: [2, 1, -2], {ROUND}{strains}) spinning at 11 rad/s;
            body pod: box(mass: 0.4 kg, size: [0.1, 0.2, 0.3] m, center: [0.1, 0.03, 0.01] m);
            joint swing: spherical(a: x, b: y, c: z) from ground to turner;
            joint x: prismatic(x) from turner to slider;
            joint y: prismatic(y) from slider to carriage;
            joint z: prismatic(z) from carriage to shaft;
            joint end: universal(d: x, e: z) from shaft at tip to pod;
            force hinge: spring(on: d, stiffness: 8 N*m/rad);
            force other: spring(on: e, stiffness: 3 N*m/rad);
        }}"
    ))
}

/// What the kinetic energy grows by per unit of one speed: it is a polynomial of second degree.
fn momentum(model: &Model, [velocity, q]: [&[f64]; 2], speeds: &[f64], along: usize) -> f64 {
    let kinetic = |more: f64| {
        let mut velocity = velocity.to_vec();
        velocity[along] += more;
        energy::energies(model, [&velocity, q], speeds, &[])[0]
    };
    (kinetic(1.0) - kinetic(-1.0)) / 2.0
}

/// Jacobi's integral `T2 - T0 + V`: the spin is kept by a motor inside, which does work.
fn jacobi(model: &Model, [velocity, q]: [&[f64]; 2], speeds: &[f64]) -> f64 {
    let kinetic = |sign: f64| {
        let velocity: Vec<f64> = velocity.iter().map(|x| sign * x).collect();
        energy::energies(model, [&velocity, q], speeds, &[])
    };
    let [[ahead, potential], [behind, _], [still, _]] = [1.0, -1.0, 0.0].map(kinetic);
    (ahead + behind) / 2.0 - 2.0 * still + potential
}

/// The first turn is about an axis fixed in the ground, so its momentum is angular momentum, which nothing changes.
#[test]
fn a_floating_shaft_keeps_angular_momentum_and_energy() {
    for strains in ["", ", shear: static", ", shear: 2, stretch: 1"] {
        let machine = floating(strains);
        let mut random = Random::new(12);
        for _ in 0..3 {
            let state = machine.state(&mut random);
            judge("floating shaft", &machine, &state);
            let (model, speeds) = machine.model(&state);
            let first = model.free().iter().position(|x| model.step(*x).name == "a");
            let first = first.expect("a turn");
            let size = momentum(&model, [&state.velocity, &state.q], &speeds, first);
            let changes = rate(&machine, &state, &model, |motion| momentum(&model, motion, &speeds, first));
            assert!(changes.abs() < 1e-6 * (1.0 + size.abs()), "momentum changes by {changes}");
            let changes = rate(&machine, &state, &model, |motion| jacobi(&model, motion, &speeds));
            assert!(changes.abs() < 1e-5, "energy changes by {changes}");
        }
    }
}

/// Eigenvalues of a machine at a speed.
fn eigenvalues(text: &str, speed: f64) -> Vec<Complex> {
    let machine = Interpreted::from_text(text).unwrap_or_else(|mistakes| panic!("{text}\n{mistakes:?}"));
    let study = Study::new(machine).input(Input::new(0), speed);
    let modes = study.modes().unwrap_or_else(|error| panic!("{error}\n{text}"));
    modes.modes.iter().map(|mode| mode.s).collect()
}

/// A clamped shaft whose material spins is a beam on a spinning hub, seen from the ground: what circles there at `s` does so
/// at `s + i omega` here, or against the spin at `s - i omega`.
fn spins_like_on_a_hub(strains: &str) {
    let (spin, lag) = (5.0, 0.01);
    let beam = format!("beam(length: 0.9 m, along: z, up: x, {ROUND}{strains}, lag: {lag} s)");
    let spinning = format!(
        "mechanism Spinning {{
            input omega: rad/s;
            body shaft: {beam} spinning at omega;
            joint clamp: fixed from ground to shaft;
        }}"
    );
    let on_hub = format!(
        "mechanism OnHub {{
            input omega: rad/s;
            body hub: massless;
            body shaft: {beam};
            joint spin: revolute(z) from ground to hub, driven at omega;
            joint clamp: fixed from hub to shaft;
        }}"
    );
    let [here, there] = [spinning, on_hub].map(|text| eigenvalues(&text, spin));
    let turned = Complex::new(0.0, spin);
    let all = there.iter().flat_map(|s| [*s, s.conj()]);
    // what twists or stretches does not circle
    let all: Vec<Complex> = all.flat_map(|s| [s - turned, s, s + turned]).collect();
    for s in here {
        let nearest = all.iter().map(|other| (s - other).norm());
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-7 * s.norm(), "{s} is {nearest:e} from any of {all:?}");
    }
}

#[test]
fn a_spinning_shaft_is_a_beam_on_a_spinning_hub() {
    for strains in ["", ", stretch: 1"] {
        spins_like_on_a_hub(strains);
    }
}

/// Strain of shear is fixed in the material like that of bending: where the material spins, its rate has a part from the
/// spin.
#[test]
fn the_shear_of_a_spinning_shaft_lags_with_its_material() {
    for strains in [", shear: 2", ", shear: static"] {
        spins_like_on_a_hub(strains);
        let machine = Machine::right(&format!(
            "mechanism Shaft {{
                body shaft: beam(length: 0.9 m, along: x, up: z, {ROUND}{strains}, lag: 0.05 s) spinning at 7 rad/s;
                joint clamp: fixed from ground to shaft;
            }}"
        ));
        judge("lagging shaft", &machine, &machine.state(&mut Random::new(3)));
    }
}

/// Integrals from 0 of the Legendre polynomials of `[0, 1]`: `I_0 = x`, `I_j = (P_(j+1) - P_(j-1)) / (2 (2 j + 1))`.
fn turns(x: f64) -> [f64; 3] {
    let y = 2.0 * x - 1.0;
    let p = [1.0, y, (3.0 * y * y - 1.0) / 2.0, (5.0 * y * y * y - 3.0 * y) / 2.0];
    [x, (p[2] - p[0]) / 6.0, (p[3] - p[1]) / 10.0]
}

/// A beam in one plane on a cart, with its points of quadrature as outputs.
fn cart(places: &[f64], loads: &str) -> Machine {
    let gauges = places.iter().enumerate().map(|(k, place)| {
        format!(
            "point g{k}: blade at {place:?} length;
            output x{k} = position(g{k}).x; output z{k} = position(g{k}).z;"
        )
    });
    Machine::right(&format!(
        "mechanism Cart {{
            body cart: point(mass: 2 kg);
            body blade: beam(length: 1.1 m, along: x, up: z, mass_per_length: 0.6 kg/m, stiffness_y: 9 N*m^2,
                bending_y: 3, shear: 2, shear_stiffness_z: 50 N);
            joint rail: prismatic([1, 0, 1]) from ground to cart;
            joint clamp: revolute(y) from cart to blade;
            force rails: spring(on: rail, stiffness: 30 N/m);
            force hold: spring(on: clamp, stiffness: 30 N*m/rad);
            {loads}
            {}
        }}",
        gauges.collect::<String>()
    ))
}

/// The equations of motion times the speeds are power: of forces all along a beam, `integral f . v` at the points of
/// quadrature.
#[test]
fn forces_along_a_beam_do_the_work_of_force_times_velocity() {
    let sections = cart(&[], "").compiled.mechanism.beams[0].sections.clone();
    let places: Vec<f64> = sections.iter().map(|(place, ..)| *place).collect();
    let free = cart(&places, "");
    let loads = [
        ("force: [2, 0, -3] N/m", [2.0, -3.0], [0.0, 0.0], 0.0),
        ("follower: [1, 0, 4] N/m", [0.0, 0.0], [1.0, 4.0], 0.0),
        ("damping: 0.7 N*s/m^2", [0.0, 0.0], [0.0, 0.0], 0.7),
    ];
    let mut random = Random::new(8);
    for (law, fixed, follower, damping) in loads {
        let loaded = cart(&places, &format!("force load: distributed(on: blade, {law});"));
        let state = free.state(&mut random);
        judge(law, &loaded, &state);
        let residual = |machine: &Machine| {
            let State { acceleration, velocity, q, u, b } = &state;
            machine.evaluate("motion_residual", &[acceleration, velocity, q, u, b]).remove(0)
        };
        let (with, without) = (residual(&loaded), residual(&free));
        let all = with.iter().zip(&without).zip(&state.velocity);
        let found: f64 = all.map(|((with, without), speed)| (without - with) * speed).sum();

        let at = |h: f64| {
            let moved = state.q.iter().zip(&state.velocity).map(|(q, v)| q + h * v);
            free.evaluate("outputs", &[&moved.collect::<Vec<_>>(), &state.u, &state.b]).concat()
        };
        let central = |h: f64| -> Vec<f64> {
            at(h).iter().zip(at(-h)).map(|(ahead, behind)| (ahead - behind) / (2.0 * h)).collect()
        };
        let velocities = central(1e-3).into_iter().zip(central(2e-3));
        let velocities: Vec<f64> = velocities.map(|(fine, coarse)| (4.0 * fine - coarse) / 3.0).collect();
        let names: Vec<String> =
            free.compiled.functions.unknowns.iter().map(|unknown| written(&unknown.name).into_owned()).collect();
        let value = |name: &str| {
            let place = names.iter().position(|x| x == name);
            state.q[place.unwrap_or_else(|| panic!("{name} is not in {names:?}"))]
        };
        let bends = [0, 1, 2].map(|j| value(&format!("blade.bend_y[{j}]")));
        let mut expected = 0.0;
        for (k, (place, weight, _)) in sections.iter().enumerate() {
            let (vx, vz) = (velocities[2 * k], velocities[2 * k + 1]);
            let turned: f64 = bends.iter().zip(turns(*place)).map(|(q, shape)| q * shape).sum();
            // a turn about y moves x towards -z
            let (sine, cosine) = (turned + value("clamp")).sin_cos();
            let [along, up] = follower;
            let fx = fixed[0] + cosine * along + sine * up - damping * vx;
            let fz = fixed[1] - sine * along + cosine * up - damping * vz;
            expected += 1.1 * weight * (fx * vx + fz * vz);
        }
        assert_close(law, &[found], &[expected], 1e-9, 1.0 + expected.abs());
    }
}
