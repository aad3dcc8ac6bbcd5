//! What modes say.

use core::f64::consts::TAU;

use eigentol_results::columns::Columns;
use eigentol_results::numbers::{number, optional, or_dash, rough};
use eigentol_results::relevance::{COLUMNS, EVERYTHING, largest, names, relevant, unless_rounding};
use eigentol_results::{Answer, Findings, at_point, displayed};

use super::whirl::blades;
use super::{Behaviour, Family};
use crate::{Complex, CoordinateInfo, Description, Mode, Modes, Role};

displayed!(Modes);

/// `modes`: a row for each mode; its shape takes two columns of data per coordinate and speed, real and imaginary part.
impl Answer for Modes {
    const KIND: &'static str = "modes";

    at_point!();

    fn findings(&self) -> Findings {
        let mut said = self.titled("natural modes");
        let shapes = Shapes::of(self);
        let mut table = Columns::new("modes", &self.modes);
        let behaviours: Vec<Behaviour> = self.modes.iter().map(|mode| mode.behaviour).collect();
        let (resolved, left_out) = Behaviour::resolved(&behaviours, &self.description);
        table.show_rows(resolved.into_iter().filter(|k| !self.is_second(*k)).collect());
        table.whole("mode", &|mode| Some(mode.label + 1));
        table.cells("mode", &|mode| self.numbers(mode));
        eigenvalues(&mut table, self.family, &self.description);
        self.kinds(&mut table);
        shapes.columns(&mut table);
        components(&mut table, &self.description);
        said.columns(table);
        shapes.rest(&mut said);
        said.note_if_any(left_out);
        said.note_if_any(self.of_harmonics());
        if !self.description.spans.is_empty() {
            let count = self.modes.len();
            said.note(format!("Only the {count} slowest modes are computed: growth of faster ones is not checked."));
        }
        if self.damping_ignored {
            said.note("Damping and gyroscopic forces (Chat) are not zero here and are ignored: undamped modes.");
        }
        said
    }
}

impl Modes {
    /// Whether a mode is the second of a pair with the same nodal diameters, which the text shows as one.
    fn is_second(&self, mode: usize) -> bool {
        /// Relative difference of equal eigenvalues.
        const EQUAL: f64 = 1e-9;
        let pattern = |mode: usize| self.whirls.get(mode).copied().flatten()?.blades;
        let Some(before) = mode.checked_sub(1) else { return false };
        let (Some(one), Some(other)) = (pattern(before), pattern(mode)) else { return false };
        let alike = one.ring == other.ring && one.nodal_diameters == other.nodal_diameters;
        let difference = (self.modes[mode].s - self.modes[before].s).norm();
        alike
            && one.is_of_pair()
            && other.is_of_pair()
            && difference <= EQUAL * self.modes[mode].s.norm()
            && !self.is_second(before)
    }

    /// What is said of coefficients that stay periodic.
    fn of_harmonics(&self) -> Option<String> {
        let orders: Vec<String> = self.description.harmonics.iter().map(ToString::to_string).collect();
        let error = largest(self.modes.iter().map(|mode| mode.error));
        (!orders.is_empty()).then(|| {
            format!(
                "The coefficients stay periodic, of order {}: these are exponents of Hill's method with that, within {} 1/s.",
                orders.join(" and "),
                rough(error)
            )
        })
    }

    /// The number of a mode, or those of a pair.
    fn numbers(&self, mode: &Mode) -> String {
        let label = mode.label + 1;
        let place = self.modes.iter().position(|other| std::ptr::eq(other, mode));
        match place {
            Some(place) if self.is_second(place + 1) => format!("{label}, {}", self.modes[place + 1].label + 1),
            _ => label.to_string(),
        }
    }

    /// Adds what the modes do to bodies that spin, if that is known.
    fn kinds<'a>(&'a self, table: &mut Columns<'a, Mode>) {
        if self.whirls.is_empty() {
            return;
        }
        let whirl = |mode: &Mode| {
            let place = self.modes.iter().position(|other| std::ptr::eq(other, mode))?;
            *self.whirls.get(place)?
        };
        table.words("kind", &|mode| Some(whirl(mode)?.kind.to_string()));
        table.words("whirl", &|mode| Some(whirl(mode)?.sense()?.to_string()));
        table.number("whirl ratio", "", &|mode| whirl(mode)?.ratio);
        table.cells("kind", &|mode| whirl(mode).map_or_else(|| "-".to_owned(), |whirl| whirl.to_string()));
        if self.description.rings.is_empty() {
            return;
        }
        blades(table, &whirl);
        if self.description.rings.iter().any(|ring| ring.patterns) {
            let of_blade = |mode: &Mode| Some(whirl(mode)?.blades?.of_blade);
            table.frequencies("f in blade", &self.description, number, &of_blade);
        }
    }
}

/// Adds the columns of eigenvalues and what they mean.
fn eigenvalues(table: &mut Columns<'_, Mode>, family: Family, d: &Description) {
    let frequency = table.number("frequency", "rad/s", &Mode::frequency);
    frequency.shown().headed("omega [rad/s]");
    match &*d.frequency.symbol {
        "rad/s" => table.cells("f [Hz]", &|mode| optional(mode.frequency().map(|omega| omega / TAU))),
        _ => table.frequencies("f", d, number, &Mode::frequency),
    }
    table.number("natural frequency", "rad/s", &Mode::natural_frequency);
    table.number("damping ratio", "", &Mode::damping_ratio);
    table.number("log decrement", "", &Mode::log_decrement);
    table.number("Re s", "1/s", &|mode| Some(mode.s.re));
    table.number("Im s", "1/s", &|mode| Some(mode.s.im));
    table.number("lambda", "1/s^2", &|mode| Some(mode.lambda));
    table.number("error of s", "1/s", &|mode| Some(mode.error));
    if family == Family::General {
        table.cells("Re s [1/s]", &|mode| rough(growth(mode)));
        table.cells("damping ratio", &|mode| or_dash(damping(mode), rough));
        if !d.spans.is_empty() {
            let decrement =
                |mode: &Mode| damping(mode).filter(|ratio| *ratio != 0.0).and_then(|_| mode.log_decrement());
            table.cells("log decrement", &|mode| or_dash(decrement(mode), rough));
        }
    }
    table.words("motion", &|mode| Some(mode.behaviour.word().to_owned()));
    table.cells("motion", &|mode| mode.behaviour.to_string());
}

/// The rate of growth, or zero if it is rounding, 1/s.
fn growth(mode: &Mode) -> f64 {
    if mode.s.re.abs() <= mode.error { 0.0 } else { unless_rounding(mode.s.re, mode.s.norm()) }
}

/// The damping ratio of an oscillation, zero if its growth is rounding.
fn damping(mode: &Mode) -> Option<f64> {
    let ratio = mode.frequency().and(mode.damping_ratio())?;
    Some(if growth(mode) == 0.0 { 0.0 } else { ratio })
}

/// Adds the components of shapes to the data.
fn components(table: &mut Columns<'_, Mode>, description: &Description) {
    for (i, info) in motions(description) {
        let of = |mode: &Mode, part: fn(&Complex) -> f64| mode.shape.get(i).map(part);
        let name = format!("Re shape {}", info.name);
        table.number(&name, "", &|mode| of(mode, |value| value.re));
        let name = format!("Im shape {}", info.name);
        table.number(&name, "", &|mode| of(mode, |value| value.im));
    }
}

/// The unknowns that a shape consists of, with their positions: reactions come last and are none of it.
fn motions(description: &Description) -> impl Iterator<Item = (usize, &CoordinateInfo)> {
    description.coordinates.iter().enumerate().filter(|(_, info)| matches!(info.role, Role::Position | Role::Speed))
}

/// Shapes as columns: one column for each coordinate or speed that moves in any mode, or a single one with the largest
/// components.
struct Shapes<'a> {
    /// Index and description of the unknown, and its largest motion in any mode.
    moving: Vec<(usize, &'a CoordinateInfo, f64)>,
    still: Vec<&'a str>,
}

/// Number of components named in a single column.
const NAMED: usize = 4;

impl<'a> Shapes<'a> {
    fn of(modes: &'a Modes) -> Self {
        let most = |i: usize| largest(modes.modes.iter().map(|mode| mode.shape[i].norm()));
        let all = motions(&modes.description).map(|(i, info)| (i, info, most(i)));
        let all: Vec<_> = all.collect();
        let greatest = largest(all.iter().map(|(_, _, most)| *most));
        let (moving, still): (Vec<_>, Vec<_>) =
            (all.into_iter()).partition(|(_, _, most)| unless_rounding(*most, greatest) != 0.0);
        Self { moving, still: still.into_iter().map(|(_, info, _)| &*info.name).collect() }
    }

    fn side_by_side(&self) -> bool {
        self.moving.len() <= COLUMNS
    }

    /// Adds the columns to a text.
    fn columns(&self, table: &mut Columns<'_, Mode>) {
        if !self.side_by_side() {
            table.cells("shape, largest components", &|mode| self.largest(mode));
            return;
        }
        for moving in &self.moving {
            table.cells(&moving.1.name, &|mode| component(shown(mode, moving)));
        }
    }

    /// The largest components of a shape by name.
    fn largest(&self, mode: &Mode) -> String {
        let components = self.moving.iter();
        let components = components.map(|moving| (moving.1, shown(mode, moving), moving.2));
        let mut components: Vec<_> = components.collect();
        components.retain(|(_, value, most)| relevant(value.norm(), *most));
        components.sort_by(|(_, a, _), (_, b, _)| b.norm().total_cmp(&a.norm()));
        let named = components.iter().take(NAMED);
        let named = named.map(|(info, value, _)| format!("{} {}", info.name, component(*value)));
        let mut text: Vec<String> = named.collect();
        if components.len() > NAMED {
            text.push(format!("{} more", components.len() - NAMED));
        }
        text.join(", ")
    }

    /// Lists what does not move, and says what has no column.
    fn rest(&self, said: &mut Findings) {
        if !self.still.is_empty() {
            let (still, verb) = (names(&self.still, "coordinates"), self.still.len());
            let verb = if verb == 1 { "does" } else { "do" };
            said.note(format!("In no mode {verb} {still} move."));
        }
        if !self.side_by_side() {
            said.note(format!("Only the {NAMED} largest components are shown: {EVERYTHING}."));
        }
    }
}

/// A component, or zero if it is rounding compared to the motion of the coordinate in other modes.
fn shown(mode: &Mode, (i, _, most): &(usize, &CoordinateInfo, f64)) -> Complex {
    let value = mode.shape[*i];
    match unless_rounding(value.norm(), *most) {
        0.0 => Complex::ZERO,
        _ => value,
    }
}

/// A component of a shape: real, or amplitude and phase in degrees.
fn component(value: Complex) -> String {
    let phase = value.arg().to_degrees();
    // A phase of less than half a degree counts as zero.
    if value.im == 0.0 || phase.abs() < 0.5 {
        rough(value.re)
    } else if phase.abs() >= 179.5 {
        rough(-value.norm())
    } else {
        format!("{} @ {phase:.0} deg", rough(value.norm()))
    }
}
