//! Distributions of a frequency.

use eigentol::requirement::SecondOrderFailure;
use eigentol::response::Response;
use eigentol::second_order::{Quadratic, SecondOrder};
use eigentol::tolerance::ModeTolerance;
use eigentol::{FirstOrder, MonteCarlo, Quantity, Tolerances};

use super::along::with_notes;
use crate::Error;
use crate::caption::{number, operating_point};
use crate::figure::{Axis, Colour, Curve, Figure, Mark, Panel, Point, Stroke};
use crate::style::Style;

/// Number of points of a density curve.
const POINTS: usize = 121;
/// Number of intervals whose probabilities form the density of the second-order model.
const INTERVALS: usize = 60;
/// Number of standard deviations that a density extends to either side.
const REACH: f64 = 4.5;
/// Smaller probabilities say more about the model than about the machine.
const NEGLIGIBLE: f64 = 1e-9;

/// The histogram of a sampled frequency, overlaid with its first- and second-order densities.
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
    second_order: Option<(&'a SecondOrder, &'a Tolerances)>,
}

impl<'a> Histogram<'a> {
    /// The histogram of the frequency of mode `mode`, from 0.
    #[must_use]
    pub fn new(sampled: &'a MonteCarlo, mode: usize) -> Self {
        Self { sampled, mode, first_order: None, second_order: None }
    }

    /// Adds the normal density with the first-order mean and standard deviation.
    #[must_use]
    pub fn first_order(mut self, model: &'a FirstOrder) -> Self {
        self.first_order = Some(model);
        self
    }

    /// Adds the density of the second-order model.
    #[must_use]
    pub fn second_order(mut self, model: &'a SecondOrder, tolerances: &'a Tolerances) -> Self {
        self.second_order = Some((model, tolerances));
        self
    }

    /// The figure.
    ///
    /// # Errors
    /// [`Error::UnknownMode`]; [`Error::Nothing`] if no sample oscillates in the mode or all have the same frequency;
    /// [`Error::Solver`] if the second-order model has no probabilities.
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
        let (scale, symbol) = style.frequency(None);
        let mut panel = density_panel(&name, symbol);
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
        let second = self.second_order.map(|(x, tolerances)| (x.modes.get(mode), tolerances));
        if let Some((Some(Ok(expansion)), tolerances)) = second {
            let (model, moments) = (&expansion.frequency.model, &expansion.frequency.moments);
            let points = quadratic(model, tolerances, (moments.mean, moments.sigma), scale)?;
            let curve = Curve::new("second-order model", Colour::Series(5), points);
            panel.curve(curve.stroke(Stroke::Dashed));
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
        let title = style.titled(format!("{}: distribution of {name}", d.name));
        Ok(Figure::new(title, with_notes(lines, style, d), vec![panel]))
    }
}

/// The bands in which a requirement fails and the first-order density, with the probability that tolerances bring the
/// response into them.
///
/// # Errors
/// [`Error::Nothing`] if no tolerance moves the response.
pub fn second_order_failure(result: &SecondOrderFailure, style: &Style) -> Result<Figure, Error> {
    let (d, margin) = (&*result.description, &result.margin);
    let Some(response) = result.wanted.response() else {
        return Err(Error::nothing("stability is not a number"));
    };
    let name = match response {
        Response::Mode { mode, quantity } => format!("{quantity} of {}", style.mode(mode)),
        response => response.name(d),
    };
    if margin.sigma <= 0.0 || !margin.sigma.is_finite() {
        return Err(Error::nothing(format!("no tolerance moves {name}")));
    }
    let unit = response.unit(d);
    let (scale, symbol) = match response {
        Response::Mode { quantity: Quantity::Frequency | Quantity::NaturalFrequency, .. } => style.frequency(None),
        _ => (unit.scale.recip(), &*unit.symbol),
    };
    let mut panel = density_panel(&name, symbol);
    panel.x.name.clone_from(&name);
    let (value, sigma) = (scale * margin.value, scale * margin.sigma);
    let points = normal(value, sigma);
    panel.curve(Curve::new("normal, sigma of first order", Colour::Series(0), points));
    panel.fit();
    panel.y.range[0] = 0.0;
    let bands = result.bands.iter();
    let bands: Vec<[f64; 2]> = bands.map(|band| [scale * band.0, scale * band.1]).collect();
    let near = |end: &&f64| end.is_finite() && (*end - value).abs() < 40.0 * sigma;
    for end in bands.as_flattened().iter().filter(near) {
        panel.x.range = [panel.x.range[0].min(end - sigma), panel.x.range[1].max(end + sigma)];
    }
    let [left, right] = panel.x.range;
    let top = panel.y.range[1];
    let bands = bands.iter().map(|ends| ends.map(|end| end.clamp(left, right)));
    let bands: Vec<[f64; 2]> = bands.collect();
    for ends in &bands {
        panel.band("fails", Colour::Series(5), ends.map(|end| [end, 0.0, top]));
    }
    panel.marks.push(Mark { label: "nominal value".to_owned(), at: value });
    let chance = |value: f64| match value < NEGLIGIBLE {
        true => format!("below {} %", number(100.0 * NEGLIGIBLE)),
        false => format!("{} %", number(100.0 * value)),
    };
    let text = format!(
        "probability of failure: {} at first order, {} by the second-order model",
        chance(margin.first_order),
        chance(margin.corrected.value)
    );
    if let Some([low, high]) = bands.first() {
        let text = format!("probability {}", chance(margin.corrected.value));
        panel.label([0.5 * (low + high), 0.9 * top], text);
    }
    let distance = match margin.distance.is_finite() {
        true => format!("; {} sigma away", number(margin.distance)),
        false => String::new(),
    };
    let lines = vec![operating_point(d, &result.inputs, None), format!("{text}{distance}.")];
    let title = style.titled(format!("{}: {}", d.name, result.wanted.text(d)));
    Ok(Figure::new(title, with_notes(lines, style, d), vec![panel]))
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

/// The mean density of each interval, at its midpoint.
fn quadratic(
    model: &Quadratic,
    tolerances: &Tolerances,
    (mean, sigma): (f64, f64),
    scale: f64,
) -> Result<Vec<Option<Point>>, Error> {
    if sigma <= 0.0 || !sigma.is_finite() {
        return Ok(Vec::new());
    }
    let width = 2.0 * REACH * sigma / INTERVALS as f64;
    let mut points = Vec::with_capacity(INTERVALS);
    for k in 0..INTERVALS {
        let low = mean - REACH * sigma + width * k as f64;
        let probability = model.probability(tolerances, (low, low + width))?;
        let density = probability.value / (scale * width);
        points.push(Some([scale * (low + 0.5 * width), density]));
    }
    Ok(points)
}
