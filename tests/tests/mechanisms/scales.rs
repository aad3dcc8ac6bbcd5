//! The same machine in other units: every number of a declaration is multiplied by its powers of a length, a mass and a
//! time, which are powers of two. What is free stays the same, and frequencies are those of the other unit of time.

use std::fmt::Write as _;

use eigentol::Study;
use eigentol_interpreter::Interpreted;
use eigentol_statistics::random::RandomNumbers;

/// Powers of two by which length, mass and time are multiplied.
#[derive(Clone, Copy, Debug)]
struct Scale([i32; 3]);

impl Scale {
    fn by(self, powers: [i32; 3]) -> f64 {
        let terms = powers.iter().zip(self.0);
        2.0_f64.powi(terms.map(|(power, exponent)| power * exponent).sum())
    }

    fn random(random: &mut RandomNumbers) -> Self {
        Self([(); 3].map(|()| (random.fraction() * 41.0) as i32 - 20))
    }

    fn length(self, value: f64) -> String {
        format!("({} m)", value * self.by([1, 0, 0]))
    }

    fn mass(self, value: f64) -> String {
        format!("({} kg)", value * self.by([0, 1, 0]))
    }

    fn inertia(self, value: f64) -> String {
        format!("({} kg*m^2)", value * self.by([2, 1, 0]))
    }

    fn stiffness(self, value: f64) -> String {
        format!("({} N/m)", value * self.by([0, 1, -2]))
    }

    fn turning(self, value: f64) -> String {
        format!("({} N*m/rad)", value * self.by([2, 1, -2]))
    }

    fn gravity(self, value: f64) -> String {
        format!("gravity [0, {}, 0] m/s^2;\n", -value * self.by([1, 0, -2]))
    }
}

fn near(random: &mut RandomNumbers, middle: f64) -> f64 {
    middle * 10_f64.powf(random.fraction() - 0.5)
}

/// Three bars and the ground, with springs in the hinges.
fn loop_of_bars(random: &mut RandomNumbers, of: Scale) -> String {
    let mut text = of.gravity(near(random, 3.0));
    let lengths = [(); 3].map(|()| near(random, 0.9));
    let angles = [1.0 + random.fraction(), 0.8 * (random.fraction() - 0.5), -1.0 - random.fraction()];
    let (mut end, mut before) = ([0.0, 0.0], 0.0);
    let mut at = String::new();
    for (k, (length, angle)) in lengths.iter().zip(angles).enumerate() {
        let (mass, spring, turn) = (near(random, 1.0), near(random, 30.0), angle - before);
        let from = k.checked_sub(1).map_or("ground".to_owned(), |k| format!("b{k}"));
        let _ = write!(
            text,
            "body b{k}: rod(mass: {}, length: {}, along: x);
             joint j{k}: revolute(z) from {from} to b{k} {at} rotated(z, {turn} rad);
             force k{k}: spring(on: j{k}, stiffness: {});\n",
            of.mass(mass),
            of.length(*length),
            of.turning(spring),
        );
        at = format!("at [1, 0, 0] * {}", of.length(*length));
        before = angle;
        end = [end[0] + length * angle.cos(), end[1] + length * angle.sin()];
    }
    let [x, y] = end.map(|x| of.length(x));
    text + &format!("joint pin: revolute(z) from b2 to ground {at}, at [{x}, {y}, 0 m] on ground, cut;")
}

/// A body on springs of one stiffness in all directions, which carries another: it may turn about the place where it
/// rests without a change of energy, which there is no motion.
fn carrier(random: &mut RandomNumbers, of: Scale) -> String {
    let mut text = of.gravity(near(random, 3.0));
    let mut number = |middle| near(random, middle);
    let _ = write!(
        text,
        "body base: rigid(mass: {}, inertia: [1, 1, 1.3] * {}, center: [1, 0.5, 0] * {});
         body arm: rod(mass: {}, length: {}, along: x);
         joint table: planar(u: x, v: y, turn: z) from ground to base at [1, 2, 0] * {};
         joint hinge: revolute(z) from base to arm at [0.3, 0.1, 0] * {};
         every angle: spring(stiffness: {});
         every displacement: spring(stiffness: {});",
        of.mass(number(1.0)),
        of.inertia(number(0.1)),
        of.length(number(0.3)),
        of.mass(number(1.0)),
        of.length(number(0.5)),
        of.length(number(100.0)),
        of.length(number(1.0)),
        of.turning(number(50.0)),
        of.stiffness(number(1000.0)),
    );
    text
}

/// Bodies on coordinates of their own, tied by bushings, which nothing holds.
fn row(random: &mut RandomNumbers, of: Scale) -> String {
    let mut text = String::new();
    let mut number = |middle| near(random, middle);
    for k in 0..3 {
        let _ = writeln!(
            text,
            "body b{k}: rigid(mass: {}, inertia: [1, 1, 1] * {});
             joint g{k}: planar(u{k}: x, v{k}: y, t{k}: z) from ground to b{k} at [{k}, 0, 0] * {};
             point l{k}: b{k} at [-0.5, 0, 0] * {};
             point r{k}: b{k} at [0.5, 0, 0] * {};\n",
            of.mass(number(1.0)),
            of.inertia(number(0.1)),
            of.length(1.0),
            of.length(1.0),
            of.length(1.0),
        );
    }
    for (from, to) in [(0, 1), (1, 2)] {
        let _ = write!(
            text,
            "force e{to}: bushing(from: r{from}, to: l{to}, stiffness: [1, 0.7, 0] * {}, turning_stiffness: [0, 0, 1] * {});",
            of.stiffness(number(1000.0)),
            of.turning(number(30.0)),
        );
    }
    text
}

/// The number of free directions, and the modes in the unit of time of the scale: frequency and error.
fn answers(text: &str, of: Scale) -> (usize, Vec<(f64, f64)>) {
    let text = format!("mechanism T {{ {text} }}");
    let machine = match Interpreted::from_text(&text) {
        Ok(machine) => machine,
        Err(error) => panic!("{error}\n{text}"),
    };
    let free = machine.description().free_directions;
    let modes = Study::new(machine).modes();
    let modes = modes.unwrap_or_else(|error| panic!("{of:?}: {error}\n{text}"));
    let time = of.by([0, 0, 1]);
    let mode = |mode: &eigentol::Mode| (mode.s.im * time, mode.error * time);
    (free, modes.modes.iter().map(mode).collect())
}

#[test]
fn units_change_no_answer() {
    let kinds: [fn(&mut RandomNumbers, Scale) -> String; 3] = [loop_of_bars, carrier, row];
    for seed in 0..12 {
        for (kind, machine) in (0..).zip(kinds) {
            let text = |of| machine(&mut RandomNumbers::new(seed, kind), of);
            let plain = Scale([0, 0, 0]);
            let expected = answers(&text(plain), plain);
            let mut random = RandomNumbers::new(seed, 100 + kind);
            for _ in 0..2 {
                let of = Scale::random(&mut random);
                let found = answers(&text(of), of);
                assert_eq!(found.0, expected.0, "{kind} {seed} {of:?}");
                assert_eq!(found.1.len(), expected.1.len(), "{kind} {seed} {of:?}");
                for ((s, error), (known, rounding)) in found.1.iter().zip(&expected.1) {
                    let limit = 1e-9 * known.abs() + error + rounding;
                    assert!((s - known).abs() <= limit, "{kind} {seed} {of:?}: {s} {known}");
                }
            }
        }
    }
}
