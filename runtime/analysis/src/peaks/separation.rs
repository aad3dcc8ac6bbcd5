//! How far peaks keep from a range of operation, in the manner of API 617.

use std::slice;

use eigentol_results::numbers::{converted, heading, number, percent, rough};
use eigentol_results::{Answer, Columns, Findings, Listed, Subject, displayed};

use super::{Moving, Peak, Peaks};
use crate::along::varied;
use crate::forced::Measure;

/// Amplification factor below which a peak counts as damped away.
const DAMPED: f64 = 2.5;
/// The most that any amplification factor asks for below a range.
const MOST: f64 = 0.16;

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
    /// of at least 2.5, `17 (1 - 1 / (AF - 1.5))` percent below the range, but 16 at most, and ten more above it. The numbers are
    /// those commonly quoted of the standard, which decides.
    #[must_use]
    pub fn separation(self, operating: [f64; 2]) -> Separation {
        let [low, high] = operating;
        let margins = self.peaks.iter().map(|peak| margin(peak, [low, high]));
        Separation { margins: margins.collect(), operating, peaks: self }
    }
}

fn margin(peak: &Peak, [low, high]: [f64; 2]) -> SeparationMargin {
    let location = &peak.place;
    let (slope, value, extra) = match () {
        () if location.value < low => (-1.0 / low, 1.0 - location.value / low, 0.0),
        () if location.value > high => (1.0 / high, location.value / high - 1.0, 0.10),
        () => (0.0, 0.0, 0.0),
    };
    let required = peak.amplification.as_ref().map(|amplification| {
        let factor = amplification.value;
        if factor < DAMPED { 0.0 } else { extra + f64::min(MOST, 0.17 * (1.0 - 1.0 / (factor - 1.5))) }
    });
    SeparationMargin { actual: location.scaled(slope, value), required }
}

/// `separation margins`: a row for each peak, amplitudes in `unit`.
impl Answer for Separation {
    const KIND: &'static str = "separation margins";

    fn subject(&self) -> Option<Subject<'_>> {
        Answer::subject(&self.peaks)
    }

    fn findings(&self) -> Findings {
        <Self as Listed>::findings(slice::from_ref(self))
    }
}

/// The table of one, with the rows of all vibrations.
impl Listed for Separation {
    const KIND: &'static str = "separation margins of vibrations";

    fn subject(&self) -> Option<Subject<'_>> {
        Answer::subject(self)
    }

    fn findings(all: &[Self]) -> Findings {
        let mut said = match all {
            [] => Findings::titled("no separation margins".to_owned()),
            _ => Findings::default(),
        };
        for margins in all {
            let of = &margins.peaks;
            let what = format_args!("separation margins of {}, in the manner of API 617", of.name());
            said.join(margins.titled(what));
            let rows: Vec<Row<'_>> = margins.rows().collect();
            said.text(margins.columns(&rows).finish().1);
        }
        let rows: Vec<Row<'_>> = all.iter().flat_map(Separation::rows).collect();
        if let Some(first) = all.first() {
            said.data(first.columns(&rows).finish().0);
            said.note("The formulas are those commonly quoted of API 617; the standard decides.");
        }
        said
    }
}

displayed!(Separation);

/// A peak of a vibration and its margin.
type Row<'a> = (&'a Peaks, &'a Peak, &'a SeparationMargin);

impl Separation {
    fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.peaks.peaks.iter().zip(&self.margins).map(|(peak, margin)| (&self.peaks, peak, margin))
    }

    /// The columns about peaks along the same input.
    fn columns<'a>(&self, rows: &'a [Row<'a>]) -> Columns<'a, Row<'a>> {
        let (d, input) = (&self.peaks.description, self.peaks.range.input);
        let mut table = Columns::new("separation margins", rows);
        table.words("vibration", &|row| Some(row.0.name()));
        varied(&mut table, d, input, number, &|row| row.1.place.value);
        let factor = |row: &Row<'_>| Some(row.1.amplification.as_ref()?.value);
        table.number("amplification factor", "", &factor).digits(number);
        let margin = |row: &Row<'_>| Some(row.2.actual.value);
        table.number("separation margin", "", &margin).digits(percent);
        let sigma = |row: &Row<'_>| Some(row.2.actual.spread.as_ref()?.sigma);
        table.number("sigma of margin", "", &sigma).digits(percent);
        let required = |row: &Row<'_>| row.2.required;
        table.number("required margin", "", &required).digits(percent);
        table.flag("sufficient", &|row| row.2.sufficient()).shown();
        if self.peaks.vibration.measure == Measure::Displacement {
            let unit = |row: &Row<'_>| row.0.vibration.unit(&row.0.description);
            table.words("unit", &|row| Some(unit(row)?.symbol.to_string()));
            let doubled = |row: &Row<'_>| Some(converted(2.0 * row.1.height.value, &unit(row)?));
            let column = table.number("peak to peak", "", &doubled).digits(rough);
            if let Some(peak_unit) = self.peaks.vibration.unit(d) {
                column.headed(&heading("peak to peak", &peak_unit));
            }
        }
        table
    }
}
