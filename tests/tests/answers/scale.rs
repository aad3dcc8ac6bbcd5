//! Long mechanisms are read at a cost that grows with the square of their size, and what is determined is judged as
//! surely as in short ones.

use std::fmt::Write as _;

use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::{Compilation, Mistakes, compile_text};

fn compiled(text: &str) -> Result<Compilation, Mistakes> {
    compile_text(text, Limits::default())
}

/// A chain of rods that hangs from a turning shaft by universal joints.
fn spinning(n: usize) -> String {
    let mut text = String::from(
        "mechanism Spinning { input omega: rad/s; gravity 9.81 m/s^2 along -z; body b0: massless;
         joint spin: revolute(z) from ground to b0, driven at omega;",
    );
    for k in 1..=n {
        let before = k - 1;
        let place = if k == 1 { "" } else { "at [0, 0, -0.5 m]" };
        let _ = write!(
            text,
            "body b{k}: rod(mass: 1 kg, length: 0.5 m, along: -z);
             joint j{k}: universal(x{k}: x, y{k}: y) from b{before} to b{k} {place};"
        );
    }
    text + "}"
}

/// A lift of crossed bars.
fn scissors(stages: usize) -> String {
    let mut text = String::from(
        "mechanism Scissors { gravity 9.81 m/s^2 along -y; body base: massless; joint root: fixed from ground to base;
         body foot: point(mass: 1 kg); joint slide: prismatic(x) from ground to foot at [0.7 m, 0, 0];
         force hold: spring(on: slide, stiffness: 1 kN/m);",
    );
    let (mut left, mut right, mut end) = ("base".to_owned(), "foot".to_owned(), "[0, 0, 0]");
    for k in 0..stages {
        let _ = write!(
            text,
            "body a{k}: rod(mass: 1 kg, length: 1 m, along: x, center: [0, 0, 0]);
             body b{k}: rod(mass: 1 kg, length: 1 m, along: x, center: [0, 0, 0]);
             joint qa{k}: revolute(z) from {left} to a{k} at {end}, at [-0.5 m, 0, 0] on a{k};
             joint qb{k}: revolute(z) from {right} to b{k} at {end}, at [-0.5 m, 0, 0] on b{k};
             joint pin{k}: revolute(z) from a{k} to b{k}, cut;"
        );
        (left, right, end) = (format!("b{k}"), format!("a{k}"), "[0.5 m, 0, 0]");
    }
    text + "}"
}

/// The hinges of a chain.
#[derive(Clone, Copy, Debug)]
enum Axes {
    Parallel,
    Alternating,
    /// In joint frames that are turned as well.
    Skew,
}

const ALL: [Axes; 3] = [Axes::Parallel, Axes::Alternating, Axes::Skew];

/// A chain of rods whose frames are at their centres of mass.
struct Chain {
    length: usize,
    axes: Axes,
    /// A rod of almost no mass.
    light: Option<usize>,
    /// A rod with a hinge that turns nothing.
    idle: Option<usize>,
    /// A rod that hangs from two hinges about one line.
    twin: Option<usize>,
}

impl Chain {
    fn new(length: usize, axes: Axes) -> Self {
        Self { length, axes, light: None, idle: None, twin: None }
    }

    fn text(&self) -> String {
        let mut numbers = Numbers(self.length as u64);
        let mut text = String::from(
            "mechanism Centred { every angle: spring(stiffness: 1 kN*m/rad); body b0: massless;
             joint root: fixed from ground to b0 at [-0.5 m, 0, 0];",
        );
        for k in 1..=self.length {
            let mass = if self.light == Some(k) { "1e-12 kg" } else { "5 kg" };
            let (axis, turned) = match self.axes {
                Axes::Parallel => ("z".to_owned(), String::new()),
                Axes::Alternating => (["z", "y"][k % 2].to_owned(), String::new()),
                Axes::Skew => {
                    let (axis, about, angle) = (numbers.vector(), numbers.vector(), numbers.next());
                    (axis, format!("rotated({about}, {angle:.3} rev)"))
                }
            };
            let _ = write!(text, "body b{k}: rod(mass: {mass}, length: 1 m, along: x, center: [0, 0, 0]);");
            let mut before = format!("b{}", k - 1);
            let mut place = format!("at [0.5 m, 0, 0] {turned}");
            if self.twin == Some(k) {
                let _ =
                    write!(text, "body ring: massless; joint twin: revolute({axis}) from {before} to ring {place};");
                (before, place) = ("ring".to_owned(), "at [0, 0, 0]".to_owned());
            }
            let _ =
                write!(text, "joint q{k}: revolute({axis}) from {before} to b{k} {place}, at [-0.5 m, 0, 0] on b{k};");
            if self.idle == Some(k) {
                let _ = write!(text, "body stub: point(mass: 1 kg); joint idle: revolute(z) from b{k} to stub;");
            }
        }
        text + "}"
    }
}

/// Numbers between -1 and 1 that look arbitrary and are always the same.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / f64::from(1 << 23) - 1.0
    }

    fn vector(&mut self) -> String {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|_| self.next());
        format!("[{x:.3}, {y:.3}, {z:.3}]")
    }
}

/// Operations asked for and nodes kept, as powers of the size.
#[test]
fn the_work_of_reading_grows_with_the_square() {
    let work = |text: &str| {
        let graph = compiled(text).expect("a mechanism").functions.graph;
        [graph.requests() as f64, graph.len() as f64]
    };
    let centred = |n| Chain::new(2 * n, Axes::Skew).text();
    let families: [&dyn Fn(usize) -> String; 3] = [&spinning, &centred, &scissors];
    for family in families {
        let [small, large] = [12, 24].map(|n| work(&family(n)));
        for (small, large) in small.into_iter().zip(large) {
            let exponent = (large / small).log2();
            assert!(exponent < 2.1, "{exponent}");
        }
    }
}

#[test]
fn long_chains_are_determined() {
    let chains = ALL.map(|axes| Chain::new(30, axes).text());
    let others = [spinning(12), scissors(10), scissors(20)];
    for text in chains.iter().chain(&others) {
        assert!(compiled(text).is_ok());
    }
}

#[test]
#[ignore = "minutes without optimisation"]
fn very_long_chains_are_determined() {
    let chains = ALL.map(|axes| Chain::new(400, axes).text());
    let others = [spinning(64), spinning(100), scissors(100)];
    for text in chains.iter().chain(&others) {
        assert!(compiled(text).is_ok());
    }
}

/// A small mass is a mass, at any place.
#[test]
fn tiny_masses_count() {
    for axes in ALL {
        for light in [1, 9, 20] {
            let chain = Chain { light: Some(light), ..Chain::new(20, axes) };
            assert!(compiled(&chain.text()).is_ok(), "{axes:?} {light}");
        }
    }
}

/// Motions that move no mass are found at any place of a long chain, and named.
#[test]
fn hidden_massless_motions_are_named() {
    let expect = |chain: Chain, message: &str| {
        let mistakes = compiled(&chain.text()).expect_err("it is undetermined");
        let texts: Vec<String> = mistakes.iter().map(|one| one.message.clone()).collect();
        let matches = matches!(&texts[..], [only] if only.starts_with(message));
        assert!(matches, "{:?}: {message}: {texts:?}", chain.axes);
    };
    for axes in ALL {
        for place in [1, 2, 9, 20] {
            let chain = Chain::new(20, axes);
            let idle = Some(place);
            expect(Chain { idle, ..chain }, "no mass moves when only `idle` changes");
            let chain = Chain::new(20, axes);
            let twin = Some(place);
            let both = format!("no mass moves when `twin` and `q{place}` change together");
            expect(Chain { twin, ..chain }, &both);
        }
    }
}
