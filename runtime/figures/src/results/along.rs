//! A common view of results along an input.

use eigentol::branches::SpecialKind;
use eigentol::modes::{Character, Whirl};
use eigentol::sweep::Sweep;
use eigentol::{Campbell, Complex, Description, Equilibrium, Error, Input, Unit};

use crate::caption::{design, in_unit, operating_point};
use crate::figure::Axis;
use crate::style::Style;

/// A result along an input: [`Sweep`] or [`Campbell`].
pub trait Along: sealed::Along {}

impl Along for Sweep {}
impl Along for Campbell {}

/// A mode at one value of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    pub(crate) label: usize,
    pub(crate) s: Complex,
    pub(crate) oscillates: bool,
    pub(crate) character: Option<Character>,
}

/// All modes at one value of the input, in its unit; empty if the point failed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Station {
    pub(crate) value: f64,
    pub(crate) modes: Vec<Sample>,
}

pub(crate) mod sealed {
    use super::{Campbell, Character, Complex, Description, Equilibrium, Error, Input, SpecialKind, Sweep, Whirl};

    type ModeAt = (usize, Complex, Option<f64>, Option<Character>);

    pub trait Along {
        /// The mechanism, the varied input and the values of all, SI.
        fn about(&self) -> (&Description, Input, &[f64]);
        /// Values, SI, with their equilibria and with the labels, eigenvalues, frequencies and kinds of their
        /// modes.
        fn points(&self) -> Vec<(f64, Result<&Equilibrium, &Error>, Vec<ModeAt>)>;
        /// Values, SI, at which stiffness is lost, with the equilibrium if it changes without a jump.
        fn critical(&self) -> Vec<(f64, Option<&Equilibrium>)>;
    }

    impl Along for Sweep {
        fn about(&self) -> (&Description, Input, &[f64]) {
            (&self.description, self.input, &self.inputs)
        }

        fn points(&self) -> Vec<(f64, Result<&Equilibrium, &Error>, Vec<ModeAt>)> {
            self.points
                .iter()
                .map(|point| {
                    let modes = point.modes.iter().flat_map(|mode| &mode.modes);
                    (
                        point.value,
                        point.equilibrium.as_ref(),
                        modes.map(|mode| (mode.label, mode.s, mode.frequency(), None)).collect(),
                    )
                })
                .collect()
        }

        fn critical(&self) -> Vec<(f64, Option<&Equilibrium>)> {
            let soft = SpecialKind::Pitchfork { supercritical: Some(true) };
            self.critical.iter().map(|item| (item.value, (item.kind == soft).then_some(&item.equilibrium))).collect()
        }
    }

    impl Along for Campbell {
        fn about(&self) -> (&Description, Input, &[f64]) {
            (&self.description, self.input, &self.inputs)
        }

        fn points(&self) -> Vec<(f64, Result<&Equilibrium, &Error>, Vec<ModeAt>)> {
            let each = self.points.iter().map(|point| {
                (
                    point.value,
                    point.equilibrium.as_ref(),
                    point
                        .modes
                        .iter()
                        .flatten()
                        .map(|mode| {
                            let kind = mode.whirl.map(Whirl::character);
                            (mode.label, mode.s, mode.behaviour.frequency(), kind)
                        })
                        .collect(),
                )
            });
            each.collect()
        }

        fn critical(&self) -> Vec<(f64, Option<&Equilibrium>)> {
            self.critical.iter().map(|x| (x.value, None)).collect()
        }
    }
}

/// A result in the form that figures along an input need.
pub(crate) struct Course<'a> {
    pub(crate) description: &'a Description,
    pub(crate) input: Input,
    pub(crate) inputs: &'a [f64],
    pub(crate) stations: Vec<Station>,
    pub(crate) equilibria: Vec<(f64, Option<&'a Equilibrium>)>,
    /// Values at which stiffness is lost, in the unit of the input.
    pub(crate) critical: Vec<f64>,
    /// Those of them at which the equilibrium changes without a jump, with that equilibrium.
    pub(crate) soft: Vec<(f64, &'a Equilibrium)>,
}

impl<'a> Course<'a> {
    pub(crate) fn of<R: Along + ?Sized>(result: &'a R) -> Self {
        let (description, input, inputs) = result.about();
        let to_unit = |value: f64| match description.inputs.get(input.index()) {
            Some(info) => in_unit(value, &info.unit),
            None => value,
        };
        let (mut stations, mut equilibria) = (Vec::new(), Vec::new());
        for (value, equilibrium, modes) in result.points() {
            let sample = |(label, s, frequency, character): (usize, Complex, Option<f64>, _)| Sample {
                label,
                s,
                oscillates: frequency.is_some(),
                character,
            };
            stations.push(Station { value: to_unit(value), modes: modes.into_iter().map(sample).collect() });
            equilibria.push((to_unit(value), equilibrium.ok()));
        }
        let critical = result.critical();
        let soft = critical.iter().filter_map(|(value, state)| Some((*value, (*state)?)));
        Self {
            description,
            input,
            inputs,
            stations,
            equilibria,
            critical: critical.iter().map(|(value, _)| to_unit(*value)).collect(),
            soft: soft.map(|(value, state)| (to_unit(value), state)).collect(),
        }
    }
    /// The horizontal axis, from the first to the last value.
    pub(crate) fn axis(&self) -> Axis {
        let mut axis = input_axis(self.description, self.input);
        axis.range = ends(self.stations.iter().map(|station| station.value));
        axis
    }

    /// The first lines of the caption: operating point and design, then the user's notes.
    pub(crate) fn caption(&self, style: &Style) -> Vec<String> {
        let mut lines = vec![operating_point(self.description, self.inputs, Some(self.input))];
        let equilibrium = self.equilibria.iter().find_map(|(_, x)| *x);
        if let Some(equilibrium) = equilibrium {
            lines.push(design(self.description, &equilibrium.design, &[]));
        }
        with_notes(lines, style, self.description)
    }
}

/// Adds the user's notes; a note that lists the design variables replaces the line without tolerances.
pub(crate) fn with_notes(mut lines: Vec<String>, style: &Style, d: &Description) -> Vec<String> {
    let first = d.design.iter().next().map(|info| format!("{} = ", info.name));
    let is_design = |line: &String| {
        let first = first.as_deref();
        first.is_some_and(|first| line.starts_with(first))
    };
    if style.notes().any(|line| is_design(&line)) {
        lines.retain(|line| !is_design(line));
    }
    lines.extend(style.notes());
    lines
}

/// An axis of an input, its range still to be determined.
pub(crate) fn input_axis(d: &Description, input: Input) -> Axis {
    match d.inputs.get(input.index()) {
        Some(info) => Axis::new(&*info.name, &*info.unit.symbol),
        None => Axis::default(),
    }
}

/// The least and the greatest of the finite values.
pub(crate) fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let finite = values.filter(|value| value.is_finite());
    finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

/// The unit of an input; a pure number if the input is unknown.
pub(crate) fn input_unit(d: &Description, input: Input) -> Unit {
    let pure = || Unit { symbol: "".into(), scale: 1.0 };
    d.inputs.get(input.index()).map_or_else(pure, |info| info.unit.clone())
}
