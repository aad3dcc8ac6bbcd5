//! Random free machines, each declared in several coordinates: modes, derivatives and the number of free directions are
//! properties of the machine.

use std::fmt::Write as _;

use eigentol::sensitivity::Quantity;
use eigentol::{Behaviour, Coordinate, Study};
use eigentol_interpreter::Interpreted;
use eigentol_statistics::random::RandomNumbers;

use super::common::{close, study};

/// One of a few round values, or any.
fn pick(random: &mut RandomNumbers, values: &[f64]) -> f64 {
    let k = (random.fraction() * (values.len() + 1) as f64) as usize;
    let any = 0.3 + random.fraction();
    values.get(k).copied().unwrap_or(any)
}

/// A floating chain of bars in a plane, hinged at their ends, with springs in the hinges and struts between bars.
struct Chain {
    lengths: Vec<f64>,
    masses: Vec<f64>,
    hinges: Vec<(f64, f64)>,
    struts: Vec<(usize, usize, f64)>,
    /// A medium at rest acts on one bar.
    drag: Option<(usize, f64)>,
}

impl Chain {
    fn random(random: &mut RandomNumbers) -> Self {
        let count = 2 + (3.0 * random.fraction()) as usize;
        let mut any = |values: &[f64]| pick(random, values);
        Self {
            lengths: (0..count).map(|_| any(&[1.0, 0.5])).collect(),
            masses: (0..count).map(|_| any(&[1.0, 2.0])).collect(),
            hinges: (1..count).map(|_| (40.0 * any(&[1.0]), any(&[0.0, 0.5]) - 0.3)).collect(),
            struts: (2..count).map(|k| (k - 2, k, 20.0 * any(&[1.0]))).collect(),
            drag: None,
        }
    }

    /// The chain with its place given by bar `root`, from which the others hang in both directions.
    fn text(&self, root: usize) -> String {
        let count = self.lengths.len();
        let mut text = String::from("mechanism Chain {\n");
        for k in 0..count {
            let (l, m) = (self.lengths[k], self.masses[k]);
            let _ = writeln!(text, "design l{k} = {l} m;\ndesign m{k} = {m} kg;");
            let _ = writeln!(text, "body b{k}: rod(mass: m{k}, length: l{k}, along: x);");
            let _ = writeln!(text, "point e{k}: b{k} at [l{k}, 0, 0];");
            let _ = writeln!(text, "point c{k}: b{k} at [l{k} / 2, 0, 0];");
        }
        let _ = writeln!(text, "joint place: planar(px: x, py: y, turn: z) from ground to b{root};");
        for k in 1..count {
            let (stiffness, rest) = self.hinges[k - 1];
            let _ = writeln!(text, "design k{k} = {stiffness} N*m/rad;");
            // The angle of bar k from bar k - 1, whichever carries the other.
            let (joint, spring) = if k > root {
                let before = k - 1;
                (format!("revolute(z) from b{before} to b{k} at [l{before}, 0, 0]"), rest)
            } else {
                let before = k - 1;
                (format!("revolute(z) from b{k} to b{before}, at [l{before}, 0, 0] on b{before}"), -rest)
            };
            let _ = writeln!(text, "joint q{k}: {joint};");
            let _ = writeln!(text, "force s{k}: spring(on: q{k}, stiffness: k{k}, rest: {spring});");
        }
        for (i, (from, to, stiffness)) in self.struts.iter().enumerate() {
            let _ = writeln!(text, "design t{i} = {stiffness} N/m;");
            let _ = writeln!(
                text,
                "force strut{i}: spring_damper(from: c{from}, to: e{to}, stiffness: t{i}, length: 0.4 m);"
            );
        }
        if let Some((bar, drag)) = self.drag {
            let _ = writeln!(text, "design d = {drag} N*s/m;\nforce air: drag(at: c{bar}, damping: d);");
        }
        text.push('}');
        text
    }

    /// The study about bar `root`, with the bars in line at the start, turned anyhow.
    fn study(&self, root: usize) -> Study<Interpreted> {
        let start = [0.3, -1.0, 0.8 - root as f64];
        let study = study(&self.text(root));
        (0..3).fold(study, |study, j| study.guess(Coordinate::new(j), start[j]))
    }
}

/// Real and imaginary part of an eigenvalue, and derivatives by name.
type Derived = (f64, f64, Vec<(String, f64)>);

/// Eigenvalues that are not zero, with the derivatives of the frequency or else of the growth by name.
fn numbers(study: &Study<Interpreted>) -> Vec<Derived> {
    let modes = study.modes().expect("modes");
    let slopes = study.sensitivities().expect("derivatives");
    let design = &study.description().design;
    let each = modes.modes.iter().zip(&slopes.modes);
    let mut ranked: Vec<_> = each
        .filter(|(mode, _)| mode.behaviour != Behaviour::Free)
        .map(|(mode, slopes)| {
            let quantity = match mode.frequency() {
                Some(_) => Quantity::Frequency,
                None => Quantity::Growth,
            };
            let own = slopes.of(quantity).expect("derivatives").by_design;
            let mut derived: Vec<(String, f64)> =
                design.iter().zip(&own).map(|(info, slope)| (info.name.to_string(), *slope)).collect();
            derived.sort_by(|a, b| a.0.cmp(&b.0));
            (mode.s.re, mode.s.im, derived)
        })
        .collect();
    ranked.sort_by(|a, b| (a.1, a.0).partial_cmp(&(b.1, b.0)).expect("numbers"));
    ranked
}

fn compare(chain: &Chain, free: usize) {
    let reference = numbers(&chain.study(0));
    for root in 0..chain.lengths.len() {
        let study = chain.study(root);
        assert_eq!(study.description().free_directions, free, "{}", chain.text(root));
        let found = numbers(&study);
        assert_eq!(found.len(), reference.len(), "{}", chain.text(root));
        for ((re, im, slopes), (other_re, other_im, others)) in found.iter().zip(&reference) {
            let what = format!("about bar {root} of\n{}", chain.text(0));
            let size = other_im.hypot(*other_re);
            assert!((re - other_re).hypot(im - other_im) <= 1e-11 * size, "{re} {im} {what}");
            let most = others.iter().fold(0.0_f64, |most, (_, slope)| most.max(slope.abs()));
            for ((name, slope), (_, other)) in slopes.iter().zip(others) {
                assert!(
                    (slope - other).abs() <= 1e-9 * other.abs().max(1e-3 * most),
                    "by {name}: {slope} instead of {other} {what}"
                );
            }
        }
    }
}

#[test]
fn floating_chains_about_any_of_their_bars() {
    let mut random = RandomNumbers::new(1, 0);
    for _ in 0..16 {
        compare(&Chain::random(&mut random), 3);
    }
}

/// The places stay free, but each speed along them dies out: single zeros.
#[test]
fn floating_chains_in_a_medium() {
    let mut random = RandomNumbers::new(2, 0);
    for _ in 0..8 {
        let mut chain = Chain::random(&mut random);
        let bar = (chain.lengths.len() as f64 * random.fraction()) as usize;
        chain.drag = Some((bar, pick(&mut random, &[0.1])));
        compare(&chain, 3);
    }
}

/// Trains of flywheels, shafts and gears on parallel axes, each wheel hung on the ground or on a neighbour.
#[test]
fn drivetrains_in_absolute_relative_and_mixed_coordinates() {
    let mut random = RandomNumbers::new(3, 0);
    for _ in 0..16 {
        let count = 3 + (3.0 * random.fraction()) as usize;
        let inertia: Vec<f64> = (0..count).map(|_| pick(&mut random, &[1.0, 0.1])).collect();
        let parents: Vec<usize> = (1..count).map(|k| (k as f64 * random.fraction()) as usize).collect();
        // A shaft of this stiffness, or a gear of this ratio.
        let links: Vec<(bool, f64)> =
            (1..count).map(|_| (random.fraction() < 0.7, pick(&mut random, &[1.0, -2.0, 0.5]))).collect();
        let shafts = links.iter().filter(|link| link.0).count();
        if shafts == 0 {
            continue;
        }
        let text = |relative: &dyn Fn(usize) -> bool| {
            let mut text = String::from("mechanism Train {\n");
            let mut angle = Vec::new();
            for k in 0..count {
                let j = inertia[k];
                let _ = writeln!(text, "design j{k} = {j} kg*m^2;");
                let _ = writeln!(text, "body w{k}: rigid(mass: 1 kg, inertia: [5 kg*m^2, 5 kg*m^2, j{k}]);");
                let on_shaft = k > 0 && links[k - 1].0 && relative(k);
                let (from, own) = match on_shaft {
                    true => (format!("w{}", parents[k - 1]), format!("({} + p{k})", angle[parents[k - 1]])),
                    false => ("ground".to_owned(), format!("p{k}")),
                };
                let _ = writeln!(text, "joint p{k}: revolute(z) from {from} to w{k};");
                angle.push(own);
            }
            for k in 1..count {
                let (shaft, value) = links[k - 1];
                let (own, other) = (&angle[k], &angle[parents[k - 1]]);
                let _ = match shaft {
                    true => writeln!(
                        text,
                        "design k{k} = {} N*m/rad;\nforce s{k}: potential(energy: k{k} * ({own} - {other})^2 / 2);",
                        100.0 * value.abs()
                    ),
                    false => writeln!(
                        text,
                        "design n{k} = {value};\nconstraint g{k}: equation(zero: {own} - n{k} * {other});"
                    ),
                };
            }
            text.push('}');
            text
        };
        let absolute = numbers(&study(&text(&|_| false)));
        assert_eq!(absolute.len(), shafts);
        for coordinates in [text(&|_| true), text(&|k| k % 2 == 0)] {
            let study = study(&coordinates);
            assert_eq!(study.description().free_directions, 1, "{coordinates}");
            for ((_, im, slopes), (_, other, others)) in numbers(&study).iter().zip(&absolute) {
                close(*im, *other, 1e-11, &coordinates);
                let most = others.iter().fold(0.0_f64, |most, (_, slope)| most.max(slope.abs()));
                for ((name, slope), (_, other)) in slopes.iter().zip(others) {
                    assert!((slope - other).abs() <= 1e-9 * other.abs().max(1e-3 * most), "{name} {coordinates}");
                }
            }
        }
    }
}
