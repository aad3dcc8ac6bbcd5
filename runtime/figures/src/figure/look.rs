//! Colours, strokes and shapes. Elements that differ in colour also differ in stroke or shape, for readers and printers
//! without colour.

use serde::{Serialize, Serializer};

/// A colour; serialised as text, `"#0072b2"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// The colour of series 0, 1, 2, ...: distinguishable for colour-blind readers (Okabe and Ito 2008), and ordered so
    /// that neighbours also differ in grey.
    Series(usize),
    /// For reference data.
    Grey,
    /// For sums, axes and events.
    Black,
}

const SERIES: [[u8; 3]; 6] =
    [[0, 114, 178], [230, 159, 0], [120, 40, 100], [0, 158, 115], [86, 180, 233], [213, 94, 0]];

impl Colour {
    /// Red, green and blue.
    #[must_use]
    pub fn rgb(self) -> [u8; 3] {
        match self {
            Self::Series(number) => SERIES[number % SERIES.len()],
            Self::Grey => [110, 110, 110],
            Self::Black => [0, 0, 0],
        }
    }
}

impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [red, green, blue] = self.rgb();
        serializer.collect_str(&format_args!("#{red:02x}{green:02x}{blue:02x}"))
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stroke {
    /// Solid.
    #[default]
    Solid,
    /// Dashed.
    Dashed,
    /// Dotted.
    Dotted,
    /// Alternating dashes and dots.
    DashDotted,
}

impl Stroke {
    /// The stroke of series 0, 1, 2, ...
    #[must_use]
    pub fn of(series: usize) -> Self {
        [Self::Solid, Self::Dashed, Self::DashDotted, Self::Dotted][series % 4]
    }
}

/// Form of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A ring.
    Ring,
    /// A filled triangle.
    Triangle,
    /// A diagonal cross.
    Cross,
    /// An open square.
    Square,
    /// A filled diamond.
    Diamond,
    /// A filled disc.
    Disc,
}

impl Shape {
    /// The shape of series 0, 1, 2, ...
    #[must_use]
    pub fn of(series: usize) -> Self {
        let all = [Self::Ring, Self::Triangle, Self::Square, Self::Diamond, Self::Cross, Self::Disc];
        all[series % all.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = [[f64; 3]; 3];

    /// Linear RGB as perceived by readers lacking one type of cone: Machado, Oliveira and Fernandes (2009), "A
    /// Physiologically-based Model for Simulation of Color Vision Deficiency", severity 1.
    const BLIND: [(&str, Matrix); 3] = [
        (
            "protanopes",
            [
                [0.152_286, 1.052_583, -0.204_868],
                [0.114_503, 0.786_281, 0.099_216],
                [-0.003_882, -0.048_116, 1.051_998],
            ],
        ),
        (
            "deuteranopes",
            [[0.367_322, 0.860_646, -0.227_968], [0.280_085, 0.672_501, 0.047_413], [-0.011_820, 0.042_940, 0.968_881]],
        ),
        (
            "tritanopes",
            [
                [1.255_528, -0.076_749, -0.178_779],
                [-0.078_411, 0.930_809, 0.147_602],
                [0.004_733, 0.691_367, 0.303_900],
            ],
        ),
    ];
    const UNIT: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// Linear sRGB to CIE XYZ (IEC 61966-2-1); white is at the row sums.
    const XYZ: Matrix = [[0.412_4, 0.357_6, 0.180_5], [0.212_6, 0.715_2, 0.072_2], [0.019_3, 0.119_2, 0.950_5]];

    fn apply(matrix: &Matrix, values: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row.iter().zip(values).map(|(a, b)| a * b).sum())
    }

    /// CIE 1976 L*, a*, b* of a colour as such a reader perceives it.
    fn lab(colour: Colour, reader: &Matrix) -> [f64; 3] {
        let linear = |channel: u8| {
            let intensity = f64::from(channel) / 255.0;
            match intensity <= 0.04045 {
                true => intensity / 12.92,
                false => ((intensity + 0.055) / 1.055).powf(2.4),
            }
        };
        let seen = apply(reader, colour.rgb().map(linear)).map(|x| x.clamp(0.0, 1.0));
        let (tristimulus, white) = (apply(&XYZ, seen), apply(&XYZ, [1.0; 3]));
        let [x, y, z] = core::array::from_fn(|k| {
            let share: f64 = tristimulus[k] / white[k];
            match share > (6.0_f64 / 29.0).powi(3) {
                true => share.cbrt(),
                false => share / (3.0 * (6.0_f64 / 29.0).powi(2)) + 4.0 / 29.0,
            }
        });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// CIE 1976 colour difference: 2.3 is just noticeable side by side.
    fn difference(a: usize, b: usize, reader: &Matrix) -> f64 {
        let [a, b] = [a, b].map(|k| lab(Colour::Series(k), reader));
        let squares = a.iter().zip(b).map(|(a, b)| (a - b).powi(2));
        squares.sum::<f64>().sqrt()
    }

    fn difference_in_grey(a: usize, b: usize) -> f64 {
        let [a, b] = [a, b].map(|k| lab(Colour::Series(k), &UNIT)[0]);
        (a - b).abs()
    }

    #[test]
    fn neighbours_differ_in_grey() {
        for series in 0..SERIES.len() - 1 {
            let apart = difference_in_grey(series, series + 1);
            assert!(apart > 11.0, "{series}: {apart}");
        }
    }

    #[test]
    fn lines_of_one_stroke_differ_in_grey() {
        for (a, b) in (0..SERIES.len()).flat_map(|b| (0..b).map(move |a| (a, b))) {
            let apart = difference_in_grey(a, b);
            assert!(Stroke::of(a) != Stroke::of(b) || apart > 11.0, "{a} {b}: {apart}");
        }
    }

    #[test]
    fn colours_differ_for_every_reader() {
        let all = BLIND.iter().map(|(name, matrix)| (*name, matrix));
        for (name, reader) in all.chain([("others", &UNIT)]) {
            for (a, b) in (0..SERIES.len()).flat_map(|b| (0..b).map(move |a| (a, b))) {
                let apart = difference(a, b, reader);
                assert!(apart > 15.0, "{name}: {a} {b}: {apart}");
            }
        }
    }

    /// Black, white and pure red have known values: L* 0 and 100, and (53.2, 80.1, 67.2).
    #[test]
    fn the_measure_is_that_of_the_textbook() {
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.1);
        assert!(near(lab(Colour::Black, &UNIT), [0.0; 3]));
        // Every reader sees white as white: the rows of the matrix sum to one.
        for (name, matrix) in &BLIND {
            let white = apply(matrix, [1.0; 3]);
            assert!(near(white, [1.0; 3]) && white.iter().all(|own| (own - 1.0).abs() < 1e-5), "{name}");
        }
        let red = [[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]];
        let full = Colour::Series(1).rgb()[0];
        assert_eq!(full, 230);
        let scale = 1.0 / ((f64::from(full) / 255.0 + 0.055) / 1.055).powf(2.4);
        let pure = red.map(|row| row.map(|row| row * scale));
        assert!(near(lab(Colour::Series(1), &pure), [53.2, 80.1, 67.2]));
    }

    #[test]
    fn colours_are_written_as_in_style_sheets() {
        let text = serde_json::to_string(&[Colour::Series(0), Colour::Black]);
        assert_eq!(text.ok().as_deref(), Some("[\"#0072b2\",\"#000000\"]"));
    }
}
