//! Distributions of a frequency.

use eigentol::tolerance::ModeTolerance;
use eigentol::{FirstOrder, MonteCarlo};

use super::along::{finished, with_notes};
use crate::Error;
use crate::caption::{number, operating_point};
use crate::figure::{Axis, Colour, Curve, Figure, Panel, Point};
use crate::style::Style;

/// Number of points of a density curve.
const POINTS: usize = 121;
/// Number of standard deviations that a density extends to either side.
const REACH: f64 = 4.5;

/// The histogram of a sampled frequency, overlaid with its first-order density.
///
/// ```
/// use eigentol::{Study, mechanism};
/// use eigentol_figures::{Histogram, Style};
///
/// mechanism! {
///     mechanism Pendulum {
///         design l = 1 m +/- 3%;
///         gravity 9.81 m/s^2 along -z;
///         body bar: rod(mass: 3 kg, length: l, along: -z);
///         joint theta: revolute(y) from ground to bar;
///     }
/// }
///
/// let study = Study::new(Pendulum).samples(2000).seed(7);
/// let sampled = study.monte_carlo()?;
/// let figure = Histogram::new(&sampled, 0)
///     .first_order(&study.first_order()?)
///     .figure(&Style::of(&study))?;
/// assert!(figure.caption.iter().any(|line| line.contains("2000 samples, seed 7")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Histogram<'a> {
    sampled: &'a MonteCarlo,
    mode: usize,
    first_order: Option<&'a FirstOrder>,
}

impl<'a> Histogram<'a> {
    /// The histogram of the frequency of mode `mode`, from 0.
    #[must_use]
    pub fn new(sampled: &'a MonteCarlo, mode: usize) -> Self {
        Self { sampled, mode, first_order: None }
    }

    /// Adds the normal density with the first-order mean and standard deviation.
    #[must_use]
    pub fn first_order(mut self, model: &'a FirstOrder) -> Self {
        self.first_order = Some(model);
        self
    }

    /// The figure.
    ///
    /// # Errors
    /// [`Error::UnknownMode`]; [`Error::Nothing`] if no sample oscillates in the mode or all have the same frequency.
    pub fn figure(&self, style: &Style) -> Result<Figure, Error> {
        let (mode, modes) = (self.mode, self.sampled.modes.len());
        let mode_statistics = self.sampled.modes.get(mode);
        let mode_statistics = mode_statistics.ok_or(Error::UnknownMode { mode, modes })?;
        let name = style.mode(mode);
        let d = &*self.sampled.description;
        let statistics = mode_statistics.as_ref();
        let sketch = statistics.and_then(|statistic| statistic.sketch());
        let bins = |count: u64| ((2.0 * (count as f64).cbrt()) as usize).clamp(8, 60);
        let histogram = statistics.zip(sketch).and_then(|(statistic, sketch)| {
            let histogram = sketch.histogram(bins(statistic.count)).ok()?;
            (statistic.min < statistic.max).then_some(histogram)
        });
        let (Some(statistics), Some(histogram)) = (statistics, histogram) else {
            let why = format!("the samples of {name} have no two different frequencies");
            return Err(Error::nothing(why));
        };
        let (scale, symbol) = style.frequency(d);
        let mut panel = density_panel(&name, &symbol);
        let bars = histogram.edges.windows(2).zip(&histogram.shares);
        let bars = bars.map(|(edge, share)| {
            let (left, right) = (scale * edge[0], scale * edge[1]);
            [left, right, 0.0, share / (right - left)]
        });
        let label = format!("Monte Carlo, {} samples", statistics.count);
        panel.bars(label, Colour::Grey, bars.collect::<Vec<_>>());
        let first = self.first_order.and_then(|first_order| first_order.modes.get(mode));
        if let Some(spread) = first.and_then(ModeTolerance::frequency) {
            let points = normal(scale * spread.mean, scale * spread.sigma);
            let curve = Curve::new("normal, mean and sigma of first order", Colour::Series(0), points);
            panel.curve(curve);
        }
        let mut lines = vec![operating_point(d, &self.sampled.inputs, None), {
            let (mean, sigma) = (scale * statistics.mean, statistics.sigma.map(|sigma| scale * sigma));
            let sigma = sigma.map_or_else(String::new, |sigma| format!(", sigma {} {symbol}", number(sigma)));
            {
                let samples = self.sampled.drawn();
                format!("Monte Carlo, {samples}: mean {} {symbol}{sigma}.", number(mean))
            }
        }];
        let counts = &self.sampled.counts;
        let lost = counts.total() - counts.stable;
        if lost > 0 {
            lines.push(format!("{lost} of {} samples are not stable and not shown.", counts.total()));
        }
        panel.fit();
        panel.y.range[0] = 0.0;
        panel.marks.extend(style.marks());
        Ok(finished(style, d, &format!("distribution of {name}"), with_notes(lines, style, d), vec![panel]))
    }
}

fn density_panel(name: &str, symbol: &str) -> Panel {
    let per = match symbol {
        "rad/s" => "s/rad".to_owned(),
        "" => String::new(),
        other => format!("1/{}", other.trim_start_matches("1/")),
    };
    Panel::new(Axis::new(format!("frequency of {name}"), symbol), Axis::new("density", per))
}

fn normal(mean: f64, sigma: f64) -> Vec<Option<Point>> {
    let abscissa = |k: usize| REACH * (2.0 * k as f64 / (POINTS - 1) as f64 - 1.0);
    let height = |z: f64| (-0.5 * z * z).exp() / (sigma * std::f64::consts::TAU.sqrt());
    let point = |z: f64| (sigma > 0.0).then(|| [mean + z * sigma, height(z)]);
    (0..POINTS).map(|k| point(abscissa(k))).collect()
}
