//! A common view of results along an input.

use eigentol::branches::SpecialKind;
use eigentol::modes::{Character, Whirl};
use eigentol::sweep::Sweep;
use eigentol::{Campbell, Complex, Description, Equilibrium, Input, Unit};

use crate::caption::{design, in_unit, operating_point};
use crate::figure::{Axis, Figure, Panel};
use crate::style::Style;

/// A result along an input: [`Sweep`] or [`Campbell`].
pub trait Along: sealed::Along {}

impl Along for Sweep {}
impl Along for Campbell {}

/// A mode at one value of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
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
    use super::{Campbell, Description, Equilibrium, Input, Sample, SpecialKind, Sweep, Whirl};

    type State<'a> = (f64, Option<&'a Equilibrium>, Vec<Sample>);

    pub trait Along {
        /// The mechanism, the varied input and the values of all, SI.
        fn about(&self) -> (&Description, Input, &[f64]);
        /// Values, SI, with their equilibria and modes.
        fn points(&self) -> Vec<State<'_>>;
        /// Values, SI, at which stiffness is lost, with the equilibrium if it changes without a jump.
        fn critical(&self) -> Vec<(f64, Option<&Equilibrium>)>;
    }

    impl Along for Sweep {
        fn about(&self) -> (&Description, Input, &[f64]) {
            (&self.description, self.input, &self.inputs)
        }

        fn points(&self) -> Vec<State<'_>> {
            let each = self.points.iter().map(|point| {
                let modes = point.modes.iter().flat_map(|all| &all.modes).map(|mode| {
                    let oscillates = mode.frequency().is_some();
                    Sample { label: mode.label, s: mode.s, oscillates, character: None }
                });
                (point.value, point.equilibrium.as_ref().ok(), modes.collect())
            });
            each.collect()
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

        fn points(&self) -> Vec<State<'_>> {
            let each = self.points.iter().map(|point| {
                let modes = point.modes.iter().flatten().map(|mode| {
                    let oscillates = mode.behaviour.frequency().is_some();
                    Sample { label: mode.label, s: mode.s, oscillates, character: mode.whirl.map(Whirl::character) }
                });
                (point.value, point.equilibrium.as_ref().ok(), modes.collect())
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
            stations.push(Station { value: to_unit(value), modes });
            equilibria.push((to_unit(value), equilibrium));
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

/// A figure of a mechanism with a title: what it shows, unless the user wrote another one.
pub(crate) fn finished(style: &Style, d: &Description, what: &str, caption: Vec<String>, panels: Vec<Panel>) -> Figure {
    Figure::new(style.titled(format!("{}: {what}", d.name)), caption, panels)
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
