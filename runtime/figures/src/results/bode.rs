//! Forced vibration along an input: amplitude and phase, and the path of the complex amplitude.

use eigentol::bode::{Bode, BodePoint};
use eigentol::forced::Extent;
use eigentol::peaks::{HalfPower, Moving, Peak, Peaks};
use eigentol::propagation::ResponseSpread;
use eigentol::response::{Response, Vibration};
use eigentol::{Complex, Unit};

use super::along::{ends, finished, input_axis, input_unit, with_notes};
use crate::Error;
use crate::caption::{in_unit, number, operating_point, with_unit};
use crate::figure::{Axis, Colour, Curve, ErrorBar, Figure, Panel, Point, Shape, Stroke};
use crate::style::Style;

/// Ends of the bands: two standard deviations to either side of a normal distribution.
const BAND: [f64; 2] = [0.02, 0.98];
/// Error of an angle relative to an eighth of a turn.
const ROUNDING: f64 = 1e-9;
/// Factor between the amplitudes beyond which they are drawn on a logarithmic axis.
const WIDE: f64 = 100.0;
/// Number of stretches between the marked values of a polar plot.
const STRETCHES: usize = 8;

/// The Bode plot of a vibration: its amplitude above, with the band of the designs within tolerances if the result has
/// it, and its phase below, without jumps of a full turn.
///
/// Those of the `peaks` that belong to the vibration are numbered; each has a bar of as many standard deviations as the
/// tolerances span, and crosses at its half-power points. Where there is no vibration, the curves have a gap.
///
/// ```
/// use eigentol::response::Vibration;
/// use eigentol::{Study, mechanism};
/// use eigentol_figures::{Style, bode};
///
/// mechanism! {
///     mechanism Rotor {
///         input omega: rad/s;
///         design k = 40 kN/m +/- 5%;
///         body plate: massless;
///         body disk: cylinder(mass: 4 kg, radius: 0.1 m, length: 0.02 m, axis: z);
///         joint x: prismatic(x) from ground to plate;
///         joint spin: revolute(z) from plate to disk, driven at omega;
///         force spring: spring(on: x, stiffness: k);
///         force damper: damper(on: x, damping: 30 N*s/m);
///         unbalance u: on disk, amount: 20 g*mm;
///         output shake = x;
///     }
/// }
///
/// let study = Study::new(Rotor).input(Rotor::omega, 80.0);
/// let found = study.bode(Rotor::omega, &[80.0, 95.0, 100.0, 105.0])?;
/// let figure = bode(&found, Vibration::new(Rotor::shake, Rotor::u), &[], &Style::of(&study))?;
/// assert_eq!(figure.panels[1].y.unit, "deg");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Error::Nothing`] if there is no such vibration at any of the values.
pub fn bode(result: &Bode, vibration: Vibration, peaks: &[Peaks], style: &Style) -> Result<Figure, Error> {
    let course = Course::of(result, vibration, peaks)?;
    let name = "nominal design";
    let mut upper = Panel::new(course.axis(), Axis::new("amplitude", &*course.unit.symbol));
    let moduli = course.curve(|x| Some(in_unit(x.norm(), &course.unit)));
    course.draw(&mut upper, name, &moduli);
    course.bands(&mut upper);
    let lines = course.draw_peaks(&mut upper);
    match style.top() {
        None => upper.logarithmic_beyond(style.ratio().unwrap_or(WIDE)),
        Some(top) => upper.y.range = [0.0, top],
    }
    upper.fit();
    if !upper.y.logarithmic {
        upper.y.range[0] = 0.0;
    }
    let mut lower = Panel::new(course.axis(), Axis::new("phase", "deg"));
    let phases = course.phases();
    lower.y.range = eighths(phases.iter().flatten().map(|x| x[1]));
    course.draw(&mut lower, "", &phases);
    if upper.bands.is_empty() && lines.is_empty() {
        for curve in upper.curves.iter_mut().filter(|curve| curve.label == name) {
            curve.label.clear();
        }
    }
    let mut caption = course.caption();
    if !upper.bands.is_empty() {
        let [low, high] = course.quantiles().unwrap_or(BAND).map(|p| 100.0 * p);
        caption.push(format!("Shaded: from {low:.1} to {high:.1} % of the designs within tolerances."));
    }
    let bars = upper.error_bars.iter().flat_map(|error_bar| &error_bar.bars);
    let wide = bars.into_iter().any(|bar| bar.low != bar.high);
    let sigmas = peaks.iter().find_map(|peak| peak.sigma_level);
    if let Some(sigmas) = sigmas.filter(|_| wide) {
        caption.push(format!("Bars at peaks: {sigmas} standard deviations to either side."));
    }
    let caption = course.finished(caption, lines, style);
    let mut panels = vec![upper, lower];
    panels.truncate(if course.has_phase() { 2 } else { 1 });
    for panel in &mut panels {
        panel.marks.extend(style.marks());
    }
    Ok(finished(style, &result.description, &course.name(), caption, panels))
}

/// The polar plot of a vibration: the path of its complex amplitude along the input, from a ring to a disc, with values
/// of the input beside it.
///
/// The distance from the origin is the amplitude, the angle from the horizontal axis the phase. Those of the `peaks` that
/// belong to the vibration are numbered.
///
/// # Errors
/// [`Error::Nothing`] if there is no such vibration at any of the values.
pub fn polar(result: &Bode, vibration: Vibration, peaks: &[Peaks], style: &Style) -> Result<Figure, Error> {
    let course = Course::of(result, vibration, peaks)?;
    if !course.has_phase() {
        return Err(Error::nothing("what is made of several amplitudes has no phase, and no polar plot"));
    }
    let symbol = &*course.unit.symbol;
    let mut panel = Panel::new(Axis::new("Re", symbol), Axis::new("Im", symbol));
    panel.equal_scales = true;
    let path: Vec<(f64, Option<Point>)> =
        (course.values.iter()).map(|(value, x)| (*value, x.map(|x| course.point(x)))).collect();
    let points: Vec<Option<Point>> = path.iter().map(|pair| pair.1).collect();
    course.draw(&mut panel, "", &points);
    panel.markers("", Colour::Grey, Shape::Cross, [[0.0, 0.0]]);
    let is_peak = |value: f64| course.places().any(|peak| peak == value);
    let known: Vec<(f64, Point)> = (path.iter())
        .filter_map(|(value, point)| Some((*value, (*point)?)))
        .filter(|(value, _)| !is_peak(*value))
        .collect();
    let axis = input_axis(&result.description, result.input);
    let words =
        |value: f64| if axis.unit.is_empty() { number(value) } else { format!("{} {}", number(value), axis.unit) };
    let marked = spaced(&known);
    for (k, &(value, point)) in marked.iter().enumerate() {
        let (label, shape) = match k {
            0 => (format!("{} = {}", axis.name, words(value)), Shape::Ring),
            _ if k + 1 == marked.len() => (format!("{} = {}", axis.name, words(value)), Shape::Disc),
            _ => (String::new(), Shape::Square),
        };
        if label.is_empty() {
            panel.label(point, number(value));
        }
        panel.markers(label, Colour::Black, shape, [point]);
    }
    let mut lines = Vec::new();
    for (k, peak) in course.peaks.iter().enumerate() {
        let at = course.point(complex(peak.height.value, peak.phase));
        let label = if k == 0 { "peak" } else { "" };
        panel.markers(label, Colour::Series(1), Shape::Diamond, [at]);
        panel.label(at, format!("({})", k + 1));
        lines.push(course.peak(k, peak));
    }
    panel.fit();
    // Without this margin the frame would cut markers at the ends in half.
    let [low, high] = panel.x.range;
    let room = 0.05 * (high - low);
    panel.x.range = [low - room, high + room];
    let mut caption = course.caption();
    caption.push(format!("Beside the path: {}.", axis.heading().replace(" [", " in ").replace(']', "")));
    let caption = course.finished(caption, lines, style);
    let title = format!("{}: polar plot of {}", result.description.name, course.name());
    Ok(Figure::new(style.titled(title), caption, vec![panel]))
}

/// The whole eighths of a turn about angles, deg, and a little more.
fn eighths(angles: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = ends(angles);
    let [low, high] = [(low / 45.0 + ROUNDING).floor(), (high / 45.0 - ROUNDING).ceil()];
    [45.0 * low - 5.0, 45.0 * high + 5.0]
}

/// First, last, and between them those after each further share of the length of the path.
fn spaced(path: &[(f64, Point)]) -> Vec<(f64, Point)> {
    let steps = path.windows(2).map(|pair| (pair[1].1[0] - pair[0].1[0]).hypot(pair[1].1[1] - pair[0].1[1]));
    let mut gone = 0.0;
    let lengths: Vec<f64> = std::iter::once(0.0)
        .chain(steps.map(|step| {
            gone += step;
            gone
        }))
        .collect();
    let whole = lengths.last().copied().unwrap_or_default();
    let mut next = 0.0;
    let mut kept = Vec::new();
    for (k, (point, length)) in path.iter().zip(&lengths).enumerate() {
        let last = k + 1 == path.len();
        let share = whole / STRETCHES as f64;
        if last || *length >= next && (whole - length > 0.5 * share || kept.is_empty()) {
            kept.push(*point);
            next = length + share;
        }
    }
    kept
}

/// A vibration at the values of an input.
struct Course<'a> {
    result: &'a Bode,
    vibration: Vibration,
    /// The peaks of this vibration.
    peaks: Vec<&'a Peak>,
    /// Of the amplitude.
    unit: Unit,
    /// Values of the input in its unit, those of the peaks among them, with the complex amplitudes, SI.
    values: Vec<(f64, Option<Complex>)>,
    /// Ends of the stretches whose states are unstable, in the unit of the input.
    unstable: Vec<[f64; 2]>,
}

impl<'a> Course<'a> {
    fn of(result: &'a Bode, vibration: Vibration, peaks: &'a [Peaks]) -> Result<Self, Error> {
        let d = &*result.description;
        let unit = input_unit(d, result.input);
        let amplitude = |point: &BodePoint| {
            let response = &point.vibration.as_ref().ok()?.response;
            Some(complex(vibration.of(response)?, vibration.phase(response)))
        };
        let course = result.course();
        let mut values: Vec<(f64, Option<Complex>)> =
            (course.iter()).map(|point| (in_unit(point.value, &unit), amplitude(point))).collect();
        if values.iter().all(|value| value.1.is_none()) {
            return Err(Error::nothing("there is no such vibration at any of the values"));
        }
        let belongs = |peaks: &&Peaks| peaks.vibration == vibration && peaks.range.input == result.input;
        let peaks: Vec<&Peak> = (peaks.iter().filter(belongs)).flat_map(|peak| &peak.peaks).collect();
        for peak in &peaks {
            let amplitude = complex(peak.height.value, peak.phase);
            insert(&mut values, in_unit(peak.place.value, &unit), amplitude);
        }
        let mut unstable: Vec<[f64; 2]> = Vec::new();
        for pair in course.windows(2).filter(|pair| pair.iter().any(|point| !point.stable && point.vibration.is_ok())) {
            let [from, to] = [&pair[0], &pair[1]].map(|point| in_unit(point.value, &unit));
            match unstable.last_mut() {
                Some(last) if last[1] == from => last[1] = to,
                _ => unstable.push([from, to]),
            }
        }
        Ok(Self { result, vibration, peaks, unit: Response::Vibration(vibration).unit(d), values, unstable })
    }

    /// Draws points that belong to the values, dotted where no machine stays because the state is unstable.
    fn draw(&self, panel: &mut Panel, label: &str, points: &[Option<Point>]) {
        let inside = |value: f64, [from, to]: &[f64; 2]| (value - from) * (value - to) <= 0.0;
        let at = |k: usize| self.values[k].0;
        let lost = |k: usize| self.unstable.iter().any(|ends| inside(at(k), ends));
        // A stretch takes the points at its ends with it.
        let between = |k: usize| self.unstable.iter().any(|ends| inside(at(k), ends) && !ends.contains(&at(k)));
        let stable = (0..points.len()).map(|k| points[k].filter(|_| !between(k)));
        let unstable = (0..points.len()).map(|k| points[k].filter(|_| lost(k)));
        panel.curve(Curve::new(label, Colour::Series(0), stable));
        panel.curve(Curve::new("unstable", Colour::Series(0), unstable).stroke(Stroke::Dotted));
    }

    fn has_phase(&self) -> bool {
        self.vibration.extent == Extent::Amplitude
    }

    fn name(&self) -> String {
        Response::Vibration(self.vibration).name(&self.result.description)
    }

    fn axis(&self) -> Axis {
        let mut axis = input_axis(&self.result.description, self.result.input);
        axis.range = ends(self.values.iter().map(|value| value.0));
        axis
    }

    fn point(&self, amplitude: Complex) -> Point {
        [amplitude.re, amplitude.im].map(|x| in_unit(x, &self.unit))
    }

    fn curve(&self, height: impl Fn(Complex) -> Option<f64>) -> Vec<Option<Point>> {
        self.values.iter().map(|(value, x)| Some([*value, height((*x)?)?])).collect()
    }

    /// Phases, deg, each within half a turn of the one before; a vibration that vanishes has none.
    fn phases(&self) -> Vec<Option<Point>> {
        let mut phases = self.curve(|item| (item != Complex::ZERO).then(|| item.arg().to_degrees()));
        let mut last: Option<f64> = None;
        for [_, phase] in phases.iter_mut().flatten() {
            if let Some(last) = last {
                *phase += 360.0 * ((last - *phase) / 360.0).round();
            }
            last = Some(*phase);
        }
        phases
    }

    /// The spread of the vibration at each value, in the unit of the input.
    fn spreads(&self) -> Vec<(f64, Option<&'a ResponseSpread>)> {
        let banded = &self.result.banded;
        let index = banded.iter().position(|x| *x == self.vibration);
        let spread = |point: &'a BodePoint| {
            let all = &point.bands.as_ref()?.spread.spreads;
            all.get(index?)?.as_ref()
        };
        let unit = input_unit(&self.result.description, self.result.input);
        // A point between the values may have none.
        (self.result.course().into_iter())
            .filter(|point| point.bands.is_some() || self.result.points.contains(point))
            .map(|point| (in_unit(point.value, &unit), spread(point)))
            .collect()
    }

    /// The probabilities at the ends of the bands.
    fn quantiles(&self) -> Option<[f64; 2]> {
        let spread = self.spreads().iter().find_map(|spread| spread.1)?;
        let [low, high] = outer(spread)?.map(|quantile| quantile.probability);
        Some([low, high])
    }

    /// The median, and the band of most designs about it.
    fn bands(&self, panel: &mut Panel) {
        let spreads = self.spreads();
        let in_unit = |value: f64| in_unit(value, &self.unit);
        let median = spreads.iter().map(|(value, spread)| {
            let all = &(*spread)?.quantiles;
            Some([*value, in_unit(all.iter().find(|x| x.probability == 0.5)?.value)])
        });
        let median = Curve::new("median", Colour::Black, median).stroke(Stroke::Dashed);
        panel.curve(median);
        let label = "within tolerances";
        let mut edges = Vec::new();
        for (value, spread) in &spreads {
            match spread.and_then(outer) {
                Some(ends) => {
                    let [low, high] = ends.map(|end| in_unit(end.value));
                    edges.push([*value, low, high]);
                }
                None => panel.band(label, Colour::Series(0), std::mem::take(&mut edges)),
            }
        }
        panel.band(label, Colour::Series(0), edges);
    }

    /// Where the peaks are, in the unit of the input.
    fn places(&self) -> impl Iterator<Item = f64> {
        let unit = input_unit(&self.result.description, self.result.input);
        self.peaks.iter().map(move |peak| in_unit(peak.place.value, &unit))
    }

    /// Draws the peaks, and returns a caption line for each.
    fn draw_peaks(&self, panel: &mut Panel) -> Vec<String> {
        let unit = input_unit(&self.result.description, self.result.input);
        let height = |peak: &Peak| in_unit(peak.height.value, &self.unit);
        let abscissa = |moving: &Moving| in_unit(moving.value, &unit);
        let bars = self.peaks.iter().map(|peak| {
            let spread = peak.place.spread.as_ref();
            let half = spread.map_or(0.0, |spread| in_unit(spread.band, &unit));
            ErrorBar::level([abscissa(&peak.place), height(peak)], half)
        });
        panel.error_bars("peak", Colour::Series(1), Shape::Diamond, bars);
        let sides = self.peaks.iter().flat_map(|peak| {
            peak.half_power
                .iter()
                .filter_map(HalfPower::place)
                .map(|item| [abscissa(item), height(peak) / std::f64::consts::SQRT_2])
        });
        panel.markers("half power", Colour::Series(1), Shape::Cross, sides);
        self.peaks
            .iter()
            .enumerate()
            .map(|(k, peak)| {
                let at = [abscissa(&peak.place), height(peak)];
                panel.label(at, format!("({})", k + 1));
                self.peak(k, peak)
            })
            .collect()
    }

    /// `(1) peak of 0.12 mm at 1480 rpm, sigma 12 rpm, amplification factor 8.2`.
    fn peak(&self, k: usize, peak: &Peak) -> String {
        let unit = input_unit(&self.result.description, self.result.input);
        let mut line = format!(
            "({}) peak of {} at {}",
            k + 1,
            with_unit(peak.height.value, &self.unit),
            with_unit(peak.place.value, &unit),
        );
        if let Some(spread) = &peak.place.spread {
            line += &format!(", sigma {}", with_unit(spread.sigma, &unit));
        }
        if let Some(factor) = &peak.amplification {
            line += &format!(", amplification factor {}", number(factor.value));
        }
        line
    }

    fn caption(&self) -> Vec<String> {
        vec![
            operating_point(&self.result.description, &self.result.inputs, Some(self.result.input)),
            if self.has_phase() {
                format!("{}: amplitude from 0 to peak; a positive phase is ahead of cos(w t).", self.name())
            } else {
                format!("{}.", self.name())
            },
        ]
    }

    fn finished(&self, caption: Vec<String>, lines: Vec<String>, style: &Style) -> Vec<String> {
        let mut caption = with_notes(caption, style, &self.result.description);
        caption.extend(lines);
        caption
    }
}

/// The complex amplitude with a phase, which what is made of several amplitudes does not have.
fn complex(amplitude: f64, phase: Option<f64>) -> Complex {
    phase.map_or(Complex::from(amplitude), |phase| Complex::from_polar(amplitude, phase))
}

/// Inserts a known amplitude between two values that both have one.
fn insert(values: &mut Vec<(f64, Option<Complex>)>, value: f64, amplitude: Complex) {
    let between = |pair: &[(f64, Option<Complex>)]| {
        let [(a, before), (b, after)] = pair else {
            return false;
        };
        (value - a) * (value - b) < 0.0 && before.is_some() && after.is_some()
    };
    if let Some(index) = values.windows(2).position(between) {
        values.insert(index + 1, (value, Some(amplitude)));
    }
}

/// The quantiles at the ends of the band.
fn outer(spread: &ResponseSpread) -> Option<[&eigentol::propagation::Quantile; 2]> {
    let inner = |quantile: &&eigentol::propagation::Quantile| (BAND[0]..=BAND[1]).contains(&quantile.probability);
    let mut all = spread.quantiles.iter().filter(inner);
    let first = all.next()?;
    Some([first, all.next_back()?])
}
