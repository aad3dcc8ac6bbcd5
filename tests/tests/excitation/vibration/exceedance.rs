//! The probability of exceeding a limit of vibration against ten million designs of the closed form.

use eigentol::requirement::Requirement;
use eigentol::response::{Response, Vibration};
use eigentol::{Excitation, Output, Study};
use eigentol_interpreter::Interpreted;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};

pub(super) const ROTOR: &str = "mechanism Rotor {
    input w: rad/s;
    design m = 12 kg +/- 3 %;
    design k = 1.9e6 N/m +/- 6 %;
    design c = 310 N*s/m +/- 30 % uniform;
    design e = 4e-5 m +/- 50 %;
    body hub: massless;
    body disk: disk(mass: m, radius: 20 cm, axis: z);
    joint x: prismatic(x) from ground to hub;
    joint spin: revolute(z) from hub to disk, driven at w;
    every displacement: spring_damper(stiffness: k, damping: c);
    unbalance u: on disk, eccentricity: e;
    output shake = x;
}";

const DESIGNS: usize = 10_000_000;

/// Numbers with a fixed seed.
struct Draw(ChaCha8Rng);

impl Draw {
    /// Between zero and one.
    fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Box and Muller.
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// The share of designs, each within three standard deviations of its tolerance, whose amplitude `m e w^2 / |D|` exceeds
/// the limit.
fn share(w: f64, limit: f64) -> f64 {
    let mut draw = Draw(ChaCha8Rng::seed_from_u64(11));
    let mut above = 0_usize;
    for _ in 0..DESIGNS {
        let m = 12.0 * (1.0 + 0.01 * draw.normal());
        let k = 1.9e6 * (1.0 + 0.02 * draw.normal());
        let c = 310.0 * (1.0 + 0.3 * (2.0 * draw.uniform() - 1.0));
        let e = 4e-5 * (1.0 + draw.normal() / 6.0);
        let amplitude = m * e.abs() * w * w / (k - m * w * w).hypot(c * w);
        above += usize::from(amplitude > limit);
    }
    above as f64 / DESIGNS as f64
}

#[test]
#[ignore = "ten million designs, and some thousand solved anew"]
fn the_probability_of_exceeding_a_limit_is_that_of_ten_million_designs() {
    let machine = Interpreted::from_text(ROTOR).expect("a declaration");
    for (w, limit) in [(380.0, 5e-4), (398.0, 9e-4), (398.0, 1.2e-3), (430.0, 3.4e-4)] {
        let exact = share(w, limit);
        let study = Study::new(machine.clone());
        let speed = study.find_input("w").expect("an input");
        let study = study.input(speed, w).samples(20_000);
        let vibration = Vibration::new::<Interpreted>(Output::new(0), Excitation::new(0));
        let wanted = Requirement::at_most(Response::Vibration(vibration), limit);
        let chances = study.chances(std::slice::from_ref(&wanted)).expect("sampled");
        let error = (exact * (1.0 - exact) / 20_000.0).sqrt();
        let sampled = chances.all.failure();
        println!("{w} {limit}: {exact} sampled {sampled}");
        assert!((sampled - exact).abs() < 4.5 * error, "{w} {limit}: {sampled} {exact}");
        let judged = study.probability(&[wanted]).expect("judged");
        println!("{judged}");
    }
}
