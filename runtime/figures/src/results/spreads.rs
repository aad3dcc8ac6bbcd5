//! Standard deviation and mean of a frequency along an input: first order against Monte Carlo.

use eigentol::{Description, FirstOrder, Input, MonteCarlo};

use super::along::{finished, input_axis, input_unit, with_notes};
use crate::Error;
use crate::caption::{in_unit, operating_point};
use crate::figure::{Axis, Colour, Curve, ErrorBar, Figure, Panel, Point, Shape, Stroke};
use crate::style::Style;

/// The spread of one frequency along an input, for one or more sets of tolerances.
///
/// ```
/// use eigentol::{Study, mechanism};
/// use eigentol_figures::{Spreads, Style};
///
/// mechanism! {
///     mechanism Pendulum {
///         input omega: rad/s;
///         design l = 1 m +/- 3%;
///         gravity 9.81 m/s^2 along -z;
///         body shaft: massless;
///         body bar: rod(mass: 3 kg, length: l, along: -z);
///         joint spin: revolute(z) from ground to shaft, driven at omega;
///         joint theta: revolute(y) from shaft to bar;
///     }
/// }
///
/// let study = Study::new(Pendulum).start(Pendulum::theta, 1.0).samples(200);
/// let (mut first, mut sampled) = (Vec::new(), Vec::new());
/// for speed in [4.5, 5.0, 6.0] {
///     let study = study.clone().input(Pendulum::omega, speed);
///     first.push(study.first_order()?);
///     sampled.push(study.monte_carlo()?);
/// }
/// let figure = Spreads::new(Pendulum::omega.any(), 0)
///     .under("3 %", &first, &sampled)
///     .figure(&Style::of(&study))?;
/// assert_eq!(figure.panels.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Spreads<'a> {
    input: Input,
    mode: usize,
    series: Vec<Series<'a>>,
}

#[derive(Clone, Debug)]
struct Series<'a> {
    label: String,
    first_order: &'a [FirstOrder],
    sampled: &'a [MonteCarlo],
}

impl<'a> Spreads<'a> {
    /// The spread of the frequency of mode `mode`, from 0, along `input`.
    #[must_use]
    pub fn new(input: Input, mode: usize) -> Self {
        Self { input, mode, series: Vec::new() }
    }

    /// Adds the results for one set of tolerances, labelled `label`.
    ///
    /// First order is a line, samples are points with their standard errors. Either list may be empty; the input values
    /// are taken from the results.
    #[must_use]
    pub fn under(mut self, label: impl Into<String>, first_order: &'a [FirstOrder], sampled: &'a [MonteCarlo]) -> Self {
        self.series.push(Series { label: label.into(), first_order, sampled });
        self
    }

    /// The figure: standard deviations above; below, means minus the nominal frequency, so that several tolerances do
    /// not hide each other.
    ///
    /// # Errors
    /// [`Error::Nothing`] where the mode has no spread anywhere.
    pub fn figure(&self, style: &Style) -> Result<Figure, Error> {
        let about = self.series.iter().flat_map(|x| x.first_order).map(|first| (&first.description, &first.inputs));
        let sampled = self.series.iter().flat_map(|x| x.sampled);
        let mut about = about.chain(sampled.map(|sampled| (&sampled.description, &sampled.inputs)));
        let name = style.mode(self.mode);
        let nothing = || Error::nothing(format!("{name} has no spread"));
        let (d, inputs) = about.next().ok_or_else(nothing)?;
        let (scale, symbol) = style.frequency(d);
        let panel = |what: &str| Panel::new(input_axis(d, self.input), Axis::new(what, &*symbol));
        let mut upper = panel("sigma of the frequency");
        let mut lower = panel("mean less nominal");
        for (k, series) in self.series.iter().enumerate() {
            self.add(series, k, (d, scale), [&mut upper, &mut lower]);
        }
        if upper.is_empty() {
            return Err(nothing());
        }
        let mut caption = vec![operating_point(d, inputs, Some(self.input))];
        let highest = |points: Vec<f64>| points.into_iter().fold(0.0, f64::max);
        let drawn =
            highest(upper.error_bars.iter().flat_map(|error_bar| &error_bar.bars).map(|bar| bar.high[1]).collect());
        upper.fit();
        lower.fit();
        upper.y.range[0] = 0.0;
        if drawn > 0.0 && 1.3 * drawn < upper.y.range[1] {
            upper.y.range[1] = 1.3 * drawn;
            caption.push("First order grows without bound at the critical value and is cut off.".to_owned());
        }
        lower.x.range = upper.x.range;
        if let Some(monte_carlo) = self.series.iter().find_map(|x| x.sampled.first()) {
            let samples = monte_carlo.drawn();
            caption.push(format!("Monte Carlo: {samples}; bars are standard errors."));
        }
        let panels = if lower.is_empty() {
            vec![upper]
        } else {
            lower.level_line(0.0);
            vec![upper, lower]
        };
        Ok(finished(style, d, &format!("spread of {name}"), with_notes(caption, style, d), panels))
    }

    fn add(&self, series: &Series<'_>, k: usize, (d, scale): (&Description, f64), [upper, lower]: [&mut Panel; 2]) {
        let unit = input_unit(d, self.input);
        let value = |inputs: &[f64]| Some(in_unit(*inputs.get(self.input.index())?, &unit));
        let nominal = |inputs: &[f64]| self.nominal(series, inputs);
        let points = series.first_order.iter().map(|item| -> Option<Point> {
            Some([value(&item.inputs)?, scale * item.modes.get(self.mode)?.frequency()?.sigma])
        });
        let curve = Curve::new(format!("first order, {}", series.label), Colour::Series(k), points);
        upper.curve(curve.stroke(Stroke::of(k)));
        let sampled = || {
            series.sampled.iter().filter_map(|item| {
                let statistics = item.modes.get(self.mode)?.as_ref()?;
                Some((value(&item.inputs)?, statistics, nominal(&item.inputs)))
            })
        };
        let sigmas = sampled().filter_map(|(at, item, _)| {
            let half = scale * item.sigma_error.unwrap_or(0.0);
            Some(ErrorBar::upright([at, scale * item.sigma?], half))
        });
        let label = format!("Monte Carlo, {}", series.label);
        upper.error_bars(label.clone(), Colour::Series(k), Shape::of(k), sigmas.collect::<Vec<_>>());
        let means = sampled().filter_map(|(at, item, nominal)| {
            let half = scale * item.standard_error.unwrap_or(0.0);
            Some(ErrorBar::upright([at, scale * (item.mean - nominal?)], half))
        });
        lower.error_bars(label, Colour::Series(k), Shape::of(k), means.collect::<Vec<_>>());
    }

    /// The nominal frequency at these input values.
    fn nominal(&self, series: &Series<'_>, inputs: &[f64]) -> Option<f64> {
        let same = |first_order: &&FirstOrder| first_order.inputs.iter().eq(inputs.iter());
        series.first_order.iter().find(same)?.modes.get(self.mode)?.behaviour.frequency()
    }
}
