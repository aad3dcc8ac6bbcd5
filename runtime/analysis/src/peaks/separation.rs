//! How far peaks keep from a range of operation, in the manner of API 617.

use eigentol_results::numbers::{number, percent, rough};
use eigentol_results::title::title_along;
use eigentol_results::{Answer, Columns, Findings, Subject, displayed};

use super::{Moving, Peak, Peaks};
use crate::along::varied;
use crate::forced::Measure;

/// Amplification factor below which a peak counts as damped away.
const DAMPED: f64 = 2.5;

/// The distances of peaks from a range of operation.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Separation {
    /// The peaks.
    pub peaks: Peaks,
    /// Lowest and highest value of the input in operation, SI.
    pub operating: [f64; 2],
    /// One for each peak.
    pub margins: Vec<SeparationMargin>,
}

/// The distance of one peak from the range of operation.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SeparationMargin {
    /// Distance from the nearest end of the range, relative to that end; zero within the range.
    pub actual: Moving,
    /// The margin that the amplification factor asks for, relative; zero for a peak that is damped away, `None` without
    /// an amplification factor.
    pub required: Option<f64>,
}

impl SeparationMargin {
    /// Whether the peak keeps away far enough; `None` if what is required is not known.
    #[must_use]
    pub fn sufficient(&self) -> Option<bool> {
        Some(self.actual.value >= self.required?)
    }
}

impl Peaks {
    /// The separation margins from a range of operation, SI, in the manner of API 617: with an amplification factor `AF`
    /// of at least 2.5, `17 (1 - 1 / (AF - 1.5))` percent below the range and ten more above it. The numbers are those
    /// commonly quoted of the standard, which decides.
    #[must_use]
    pub fn separation(self, operating: [f64; 2]) -> Separation {
        let [low, high] = operating;
        let margins = self.peaks.iter().map(|peak| margin(peak, [low, high]));
        Separation {
            margins: margins.collect(),
            operating,
            peaks: self,
        }
    }
}

fn margin(peak: &Peak, [low, high]: [f64; 2]) -> SeparationMargin {
    let place = &peak.place;
    let (slope, value, extra) = match () {
        () if place.value < low => (-1.0 / low, 1.0 - place.value / low, 0.0),
        () if place.value > high => (1.0 / high, place.value / high - 1.0, 0.10),
        () => (0.0, 0.0, 0.0),
    };
    let required = peak.amplification.as_ref().map(|own| {
        let factor = own.value;
        match factor < DAMPED {
            true => 0.0,
            false => extra + 0.17 * (1.0 - 1.0 / (factor - 1.5)),
        }
    });
    SeparationMargin {
        actual: place.scaled(slope, value),
        required,
    }
}

/// `separation margins`: a row for each peak.
impl Answer for Separation {
    const KIND: &'static str = "separation margins";

    fn subject(&self) -> Option<Subject<'_>> {
        self.peaks.subject()
    }

    fn findings(&self) -> Findings {
        let (d, input) = (&self.peaks.description, self.peaks.range.input);
        let title = title_along(d, &self.peaks.inputs, input);
        let mut said = Findings::titled(format!(
            "{title}: separation margins, in the manner of API 617"
        ));
        let rows: Vec<(&Peak, &SeparationMargin)> =
            self.peaks.peaks.iter().zip(&self.margins).collect();
        let mut table = Columns::new("separation margins", &rows);
        varied(&mut table, d, input, number, &|row| row.0.place.value);
        table
            .number("amplification factor", "", &|row| {
                Some(row.0.amplification.as_ref()?.value)
            })
            .digits(number);
        table
            .number("separation margin", "", &|row| Some(row.1.actual.value))
            .digits(percent);
        table
            .number("sigma of margin", "", &|row| {
                Some(row.1.actual.spread.as_ref()?.sigma)
            })
            .digits(percent);
        table
            .number("required margin", "", &|row| row.1.required)
            .digits(percent);
        table.flag("sufficient", &|row| row.1.sufficient()).shown();
        if self.peaks.vibration.measure == Measure::Displacement {
            table
                .number("peak to peak", "", &|row| Some(2.0 * row.0.height.value))
                .digits(rough);
        }
        said.columns(table);
        said.note("The formulas are those commonly quoted of API 617; the standard decides.");
        said
    }
}

displayed!(Separation);
