//! Colours, strokes and shapes. What differs in colour differs in stroke or shape as well, for readers and printers that see no colours.

use serde::{Serialize, Serializer};

/// A colour; serialised as text, `"#0072b2"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// That of series number 0, 1, 2, ...: colours that stay apart for colour-blind readers (Okabe and Ito 2008), ordered so that
    /// neighbours differ in grey, too.
    Series(usize),
    /// What only compares.
    Grey,
    /// Sums, axes and events.
    Black,
}

const SERIES: [[u8; 3]; 6] = [
    [0, 114, 178],
    [230, 159, 0],
    [120, 40, 100],
    [0, 158, 115],
    [86, 180, 233],
    [213, 94, 0],
];

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
    /// Without a gap.
    #[default]
    Solid,
    /// In dashes.
    Dashed,
    /// In dots.
    Dotted,
    /// In dashes with dots between them.
    DashDotted,
}

impl Stroke {
    /// That of series number 0, 1, 2, ...
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
    /// A square without filling.
    Square,
    /// A filled diamond.
    Diamond,
    /// A filled disc.
    Disc,
}

impl Shape {
    /// That of series number 0, 1, 2, ...
    #[must_use]
    pub fn of(series: usize) -> Self {
        let all = [
            Self::Ring,
            Self::Triangle,
            Self::Square,
            Self::Diamond,
            Self::Cross,
            Self::Disc,
        ];
        all[series % all.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE 1976 lightness, 0 to 100.
    fn lightness(colour: Colour) -> f64 {
        let linear = |channel: u8| {
            let own = f64::from(channel) / 255.0;
            match own <= 0.04045 {
                true => own / 12.92,
                false => ((own + 0.055) / 1.055).powf(2.4),
            }
        };
        let [red, green, blue] = colour.rgb().map(linear);
        116.0 * (0.2126 * red + 0.7152 * green + 0.0722 * blue).cbrt() - 16.0
    }

    #[test]
    fn neighbours_differ_in_grey() {
        for series in 0..SERIES.len() - 1 {
            let [own, next] = [series, series + 1].map(|k| lightness(Colour::Series(k)));
            assert!((own - next).abs() > 11.0, "{series}: {own} {next}");
        }
    }

    #[test]
    fn colours_are_written_as_in_style_sheets() {
        let text = serde_json::to_string(&[Colour::Series(0), Colour::Black]);
        assert_eq!(text.ok().as_deref(), Some("[\"#0072b2\",\"#000000\"]"));
    }
}
