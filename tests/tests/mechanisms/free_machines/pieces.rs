//! Free bodies of many pieces, each on coordinates of its own, tied to each other by stiffnesses over six decades: the
//! compiler counts the motions of the whole, and frequencies are those of matrices put together by hand.

use eigentol_statistics::random::RandomNumbers;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::common::machine;
use eigentol::Study;

/// The text of a machine in a plane, its masses and its stiffness.
struct Pieces {
    text: String,
    masses: Vec<f64>,
    stiffness: DMatrix<f64>,
}

/// The displacement of a piece's point and its rotation, by coordinate of the whole.
type Point = [DVector<f64>; 3];

impl Pieces {
    /// Pieces in a row, tied by bushings or by plain springs, each to one before it; each third of them stands on one
    /// before it, if asked.
    fn new(random: &mut RandomNumbers, count: usize, (springs, decades): (bool, f64), mixed: bool) -> Self {
        let mut number = |middle: f64| middle * 10_f64.powf(decades * (random.fraction() - 0.5));
        let mut pieces =
            Self { text: String::new(), masses: Vec::new(), stiffness: DMatrix::zeros(3 * count, 3 * count) };
        for k in 0..count {
            let (mass, inertia) = (number(1.0), number(0.01));
            pieces.masses.extend([mass, mass, inertia]);
            let (from, at) = match mixed && k % 3 == 2 {
                true => (format!("b{}", k - 1), 1),
                false => ("ground".to_owned(), k),
            };
            pieces.text += &format!(
                "body b{k}: rigid(mass: {mass} kg, inertia: [1, 1, 1] * ({inertia} kg*m^2));
                 joint g{k}: planar(u{k}: x, v{k}: y, t{k}: z) from {from} to b{k} at [{at}, 0, 0] m;\n"
            );
        }
        for k in 1..count {
            let before = if k % 5 == 4 { k - 2 } else { k - 1 };
            if !springs {
                let stiffness = [number(1e6), number(1e6), number(1e3)];
                pieces.bushing([before, k], stiffness);
                continue;
            }
            for (from, to) in [(0.2, 0.2), (0.2, -0.2), (-0.2, 0.2), (-0.2, -0.2)] {
                let stiffness = number(1e6);
                pieces.spring([before, k], [from, to], stiffness);
            }
        }
        pieces
    }

    fn point(&self, piece: usize, [x, y]: [f64; 2]) -> Point {
        let unit = |k: usize| DVector::from_fn(self.masses.len(), |i, _| f64::from(u8::from(i == 3 * piece + k)));
        [unit(0) - unit(2) * y, unit(1) + unit(2) * x, unit(2)]
    }

    fn add(&mut self, stiffness: f64, change: &DVector<f64>) {
        self.stiffness += change * change.transpose() * stiffness;
    }

    /// Half-way between two pieces, along the row, across it and against turning.
    fn bushing(&mut self, pieces: [usize; 2], stiffness: [f64; 3]) {
        let [a, b] = pieces;
        let half = 0.5 * (b - a) as f64;
        let ends = [self.point(a, [half, 0.0]), self.point(b, [-half, 0.0])];
        for (k, stiffness) in stiffness.into_iter().enumerate() {
            self.add(stiffness, &(&ends[1][k] - &ends[0][k]));
        }
        let [along, across, turning] = stiffness;
        self.text += &format!(
            "point r{b}: b{a} at [{half}, 0, 0] m; point l{b}: b{b} at [-{half}, 0, 0] m;
             force e{b}: bushing(from: r{b}, to: l{b}, stiffness: [{along}, {across}, 0] N/m, turning_stiffness: [0, 0, {turning}] N*m/rad);\n"
        );
    }

    fn spring(&mut self, [a, b]: [usize; 2], [from, to]: [f64; 2], stiffness: f64) {
        let ends = [self.point(a, [0.0, from]), self.point(b, [0.0, to])];
        let reach = [(b - a) as f64, to - from];
        let length = reach[0].hypot(reach[1]);
        let change = |k: usize| (&ends[1][k] - &ends[0][k]) * (reach[k] / length);
        self.add(stiffness, &(change(0) + change(1)));
        let number = self.text.len();
        self.text += &format!(
            "point p{number}: b{a} at [0, {from}, 0] m; point q{number}: b{b} at [0, {to}, 0] m;
             force s{number}: spring_damper(from: p{number}, to: q{number}, stiffness: {stiffness} N/m, length: {length} m);\n"
        );
    }

    /// The frequencies above zero, and what rounding adds to their squares.
    fn frequencies(&self, free: usize) -> (Vec<f64>, f64) {
        let n = self.masses.len();
        let scaled = DMatrix::from_fn(n, n, |i, j| self.stiffness[(i, j)] / (self.masses[i] * self.masses[j]).sqrt());
        let mut squares: Vec<f64> = SymmetricEigen::new(scaled).eigenvalues.iter().copied().collect();
        squares.sort_by(f64::total_cmp);
        let rounding = 1e-14 * n as f64 * squares[n - 1];
        (squares.drain(free..).map(|square| square.max(0.0).sqrt()).collect(), rounding)
    }

    fn text(&self) -> String {
        format!("mechanism Pieces {{ {} }}", self.text)
    }

    /// Asserts that the whole has these free directions, and its frequencies.
    fn check(&self, free: usize) {
        let text = self.text();
        let machine = machine(&text);
        assert_eq!(machine.description().free_directions, free, "{text}");
        let modes = Study::new(machine).modes();
        let modes = modes.unwrap_or_else(|error| panic!("{error}\n{text}"));
        let (expected, rounding) = self.frequencies(free);
        assert_eq!(modes.modes.len(), free + expected.len(), "{text}");
        for (mode, expected) in modes.modes.iter().skip(free).zip(expected) {
            let found = mode.frequency().unwrap_or(0.0);
            let error = (found * found - expected * expected).abs();
            assert!(error <= 1e-9 * expected * expected + rounding, "{found} {expected}\n{text}");
        }
    }
}

#[test]
fn rows_of_pieces_that_nothing_holds() {
    let mut random = RandomNumbers::new(58, 1);
    for k in 0..12 {
        let count = 2 + (random.fraction() * 16.0) as usize;
        let decades = [0.0, 2.0, 6.0][k % 3];
        Pieces::new(&mut random, count, (k % 2 == 1, decades), k % 4 == 3).check(3);
    }
}

/// The row of which the fault was reported: 1e3 N*m/rad beside 1e9 N/m, equal from end to end.
#[test]
fn long_rows_of_equal_pieces() {
    let mut random = RandomNumbers::new(58, 2);
    for count in [5, 11, 40] {
        let mut row = Pieces::new(&mut random, count, (false, 0.0), false);
        row.text = row.text.split("point").next().unwrap_or_default().to_owned();
        row.stiffness.fill(0.0);
        for k in 1..count {
            row.bushing([k - 1, k], [1e9, 1e6, 1e3]);
        }
        row.check(3);
    }
}

/// Springs that are too short or too long: a row that does not rest where it is drawn.
#[test]
fn loads_inside_a_row_are_no_loads_on_the_whole() {
    let mut random = RandomNumbers::new(58, 3);
    for count in [6, 9, 12] {
        let mut row = Pieces::new(&mut random, count, (true, 2.0), false);
        row.text = row.text.replace(" m);\n", " * (1 m + 1 cm));\n");
        let machine = machine(&row.text());
        assert_eq!(machine.description().free_directions, 3, "{}", row.text());
    }
}

/// A load on one piece of many is refused, with the motion in words.
#[test]
fn a_load_on_one_piece_moves_the_whole() {
    let mut random = RandomNumbers::new(58, 4);
    let mut row = Pieces::new(&mut random, 12, (false, 2.0), false);
    row.text += "force push: load(at: r3, force: [0, 2, 0] N);";
    let mistakes = eigentol_interpreter::Interpreted::from_text(&row.text()).err();
    let message = mistakes.expect("a refusal").to_string();
    assert!(message.contains("`push` acts along translation of the whole along y, which nothing holds"), "{message}");
}
