//! Figures of a rotor over its speed: frequencies, damping ratios, and the neighbourhood of the running speed.

use eigentol::Campbell;
use eigentol::campbell::CampbellMode;
use eigentol::modes::{Sense, Whirl};
use eigentol::tolerance::Spread;

use super::{Band, Curve, Figure, Markers, Point, Shape};
use crate::rotor::{HZ, Happening, RPM, Risk, RotorEvent, RotorQuestion};

/// Palette entry of things that only compare.
const GREY: usize = 4;
/// Palette entry of what happens.
const BLACK: usize = 5;

/// What figures of a rotor are drawn from.
#[derive(Clone, Copy, Debug)]
pub struct Whirling<'a> {
    /// What was asked.
    pub question: &'a RotorQuestion,
    /// The curves.
    pub campbell: &'a Campbell,
    /// The markers.
    pub events: &'a [RotorEvent],
}

/// A quantity of a mode, in the unit of the figure.
type Quantity = fn(&CampbellMode) -> Option<f64>;

fn hertz(mode: &CampbellMode) -> Option<f64> {
    Some(mode.behaviour.frequency()? / HZ)
}

fn percent(mode: &CampbellMode) -> Option<f64> {
    Some(100.0 * mode.damping_ratio.as_ref()?.mean)
}

impl Whirling<'_> {
    /// The Campbell diagram: frequencies up to `top`, Hz, the orders, where they meet, and the limit of stability.
    pub fn frequencies(&self, name: &str, title: &str, top: f64) -> Figure {
        let mut figure = self.figure((name, title), "frequency [Hz]", (0.0, top));
        figure.curves = self.curves(hertz);
        figure.bands = self.bands(|mode| mode.frequency.as_ref(), 1.0 / HZ);
        figure.note = self.about_bands();
        self.add_orders(&mut figure);
        let at = |event: &&RotorEvent| (event.speed / RPM, event.s.im / HZ);
        let meeting = |forward: bool| {
            let senses = move |event: &&RotorEvent| {
                matches!(event.happening, Happening::Order(_))
                    && forward == (event.whirl.map(Whirl::sense) == Some(Sense::Forward))
            };
            self.events
                .iter()
                .filter(senses)
                .map(|event| at(&event))
                .collect()
        };
        figure.markers = vec![
            markers("order meets forward whirl", Shape::Ring, meeting(true)),
            markers(
                "order meets backward whirl",
                Shape::Triangle,
                meeting(false),
            ),
            markers(
                "limit of stability",
                Shape::Cross,
                self.onsets().map(|event| at(&event)).collect(),
            ),
        ];
        figure
    }

    /// Damping ratios with their bands; the rotor is unstable where one of them is negative.
    pub fn damping_ratios(&self, name: &str, title: &str) -> Figure {
        let mut figure = self.figure((name, title), "damping ratio [%]", (0.0, 0.0));
        figure.curves = self.curves(percent);
        figure.bands = self.bands(|mode| mode.damping_ratio.as_ref(), 100.0);
        figure.note = self.about_bands();
        let edges = figure.bands.iter().flat_map(|band| &band.edges);
        let (low, high) = edges.fold((0.0_f64, 0.0_f64), |(low, high), edge| {
            (low.min(edge.1), high.max(edge.2))
        });
        let room = 0.05 * (high - low).max(1.0);
        figure.range = (low - room, high + room);
        figure.curves.push(Curve {
            label: String::new(),
            colour: BLACK,
            dashed: false,
            pieces: vec![vec![(figure.speeds.0, 0.0), (figure.speeds.1, 0.0)]],
        });
        let below = (figure.speeds.0, 0.0);
        let text = "unstable below this line".to_owned();
        figure.labels.push((below, text));
        for event in self.onsets() {
            if let Ok(spread) = &event.spread {
                let ends = [event.speed - spread.band, event.speed + spread.band];
                figure.bands.push(Band {
                    label: format!("limit of stability, {} sigma", self.campbell.sigma_level),
                    colour: GREY,
                    edges: ends
                        .map(|end| {
                            let speed = (end / RPM).clamp(figure.speeds.0, figure.speeds.1);
                            (speed, figure.range.0, figure.range.1)
                        })
                        .to_vec(),
                });
            }
        }
        let onsets = self.onsets().map(|event| (event.speed / RPM, 0.0));
        figure.markers = vec![markers(
            "limit of stability",
            Shape::Cross,
            onsets.collect(),
        )];
        figure
    }

    /// The neighbourhood of the running speed: frequencies with their bands, the forbidden band, and the samples.
    pub fn margin(&self, name: &str, title: &str, risk: &Risk) -> Figure {
        let running = self.question.running / HZ;
        let mut figure = self.figure((name, title), "frequency [Hz]", (0.0, 0.0));
        figure.range = (0.6 * running, 1.3 * running);
        figure.curves = self.curves(hertz);
        figure.bands = self.bands(|mode| mode.frequency.as_ref(), 1.0 / HZ);
        figure.note = self.about_bands();
        figure.bands.push(Band {
            label: format!("within {} % of the speed", 100.0 * self.question.margin),
            colour: GREY,
            edges: [figure.speeds.0, figure.speeds.1]
                .map(|rpm| {
                    let (speed, margin) = (rpm * RPM / HZ, self.question.margin);
                    (rpm, speed * (1.0 - margin), speed * (1.0 + margin))
                })
                .to_vec(),
        });
        self.add_orders(&mut figure);
        let level = self.campbell.sigma_level;
        let sampled = risk.modes.iter().filter_map(|mode| {
            let own = &mode.sampled_frequency;
            let (mean, sigma) = (own.mean()?, own.sigma()?);
            Some([mean - level * sigma, mean, mean + level * sigma])
        });
        let points = sampled.flatten().map(|value| (figure.mark.0, value / HZ));
        let label = format!("Monte Carlo: mean, {level} sigma");
        figure.markers = vec![markers(&label, Shape::Ring, points.collect())];
        figure.curves.retain(|curve| {
            let mut points = curve.pieces.iter().flatten();
            points.any(|point| (figure.range.0..=figure.range.1).contains(&point.1))
        });
        figure
    }

    fn about_bands(&self) -> String {
        let level = self.campbell.sigma_level;
        format!("Shaded along the curves: {level} standard deviations to either side.")
    }

    fn figure(&self, (name, title): (&str, &str), values: &str, range: (f64, f64)) -> Figure {
        let speeds = self.campbell.points.iter().map(|point| point.value / RPM);
        let ends = speeds.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), speed| {
            (speed.min(low), speed.max(high))
        });
        let ends = if ends.0 < ends.1 { ends } else { (0.0, 1.0) };
        let running = self.question.running / RPM;
        Figure {
            name: name.to_owned(),
            title: title.to_owned(),
            speed: "speed [rpm]".to_owned(),
            values: values.to_owned(),
            speeds: ends,
            range,
            mark: (running, format!("running speed {running:.0} rpm")),
            ..Figure::default()
        }
    }

    fn onsets(&self) -> impl Iterator<Item = &RotorEvent> {
        let events = self.events.iter();
        events.filter(|event| event.happening == Happening::Onset)
    }

    /// The modes, forward and planar ones solid, backward ones dashed.
    fn curves(&self, quantity: Quantity) -> Vec<Curve> {
        let mut curves = Vec::new();
        for label in self.campbell.labels() {
            for (sense, word) in [
                (Sense::Forward, "forward"),
                (Sense::Backward, "backward"),
                (Sense::Planar, "planar"),
            ] {
                let pieces = self.pieces(label, sense, quantity);
                if !pieces.is_empty() {
                    curves.push(Curve {
                        label: format!("mode {}, {word}", label + 1),
                        colour: label % GREY,
                        dashed: sense == Sense::Backward,
                        pieces,
                    });
                }
            }
        }
        curves
    }

    /// The parts of a curve in which the mode whirls in one sense; each step belongs to the sense at its end, or, where
    /// nothing whirls there, at its beginning.
    fn pieces(&self, label: usize, sense: Sense, quantity: Quantity) -> Vec<Vec<Point>> {
        let mut pieces: Vec<Vec<Point>> = vec![Vec::new()];
        for pair in self.campbell.points.windows(2) {
            let [from, to] = [&pair[0], &pair[1]].map(|point| {
                let modes = point.modes.as_deref().unwrap_or_default();
                let mode = modes.iter().find(|mode| mode.label == label)?;
                Some((point.value / RPM, quantity(mode)?, mode.whirl))
            });
            let step = from.zip(to).filter(|(from, to)| {
                let whirl = to.2.or(from.2).map(Whirl::sense);
                whirl.unwrap_or(Sense::Planar) == sense
            });
            let Some((from, to)) = step else {
                pieces.push(Vec::new());
                continue;
            };
            if let Some(piece) = pieces.last_mut() {
                if piece.is_empty() {
                    piece.push((from.0, from.1));
                }
                piece.push((to.0, to.1));
            }
        }
        pieces.retain(|piece| !piece.is_empty());
        pieces
    }

    /// The bands that hold as many standard deviations as the tolerances do.
    fn bands(&self, quantity: fn(&CampbellMode) -> Option<&Spread>, unit: f64) -> Vec<Band> {
        let mut bands = Vec::new();
        for label in self.campbell.labels() {
            let mut edges = Vec::new();
            for point in &self.campbell.points {
                let modes = point.modes.as_deref().unwrap_or_default();
                let mode = modes.iter().find(|mode| mode.label == label);
                let spread = mode.filter(|mode| !mode.clustered).and_then(quantity);
                match spread {
                    Some(own) => edges.push((
                        point.value / RPM,
                        unit * (own.mean - own.band),
                        unit * (own.mean + own.band),
                    )),
                    None => bands.push(band(label, std::mem::take(&mut edges))),
                }
            }
            bands.push(band(label, edges));
        }
        bands.retain(|band| band.edges.len() > 1);
        bands
    }

    fn add_orders(&self, figure: &mut Figure) {
        let ((low, high), top) = (figure.speeds, figure.range.1);
        for &order in &self.question.orders {
            let value = |rpm: f64| order * rpm * RPM / HZ;
            let last = high.min(top * HZ / (order * RPM));
            if last <= low {
                continue;
            }
            figure.curves.push(Curve {
                label: String::new(),
                colour: GREY,
                dashed: true,
                pieces: vec![vec![(low, value(low)), (high, value(high))]],
            });
            let place = low + 0.85 * (last - low);
            figure
                .labels
                .push(((place, value(place)), format!("{order} x speed")));
        }
    }
}

fn band(label: usize, edges: Vec<(f64, f64, f64)>) -> Band {
    Band {
        label: String::new(),
        colour: label % GREY,
        edges,
    }
}

fn markers(label: &str, shape: Shape, points: Vec<Point>) -> Markers {
    Markers {
        label: label.to_owned(),
        colour: BLACK,
        shape,
        points,
    }
}
