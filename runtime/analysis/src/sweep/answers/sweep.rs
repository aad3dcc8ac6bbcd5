use eigentol_results::numbers::{frequency_symbol, given, heading, number};
use eigentol_results::relevance::{EVERYTHING, shown};
use eigentol_results::title::title_along;
use eigentol_results::{Answer, Columns, Findings, Subject, Table, displayed};

use super::events::unresolved;
use super::states::critical_columns;
use crate::along::{Moving, not_reached, place, varied};
use crate::modes::undamped;
use crate::sweep::{Sweep, SweepPoint};
use crate::{Description, Equilibrium, Input, Mode, Role};

/// A row for each value of the input: the unknowns, the stability, and the frequency, damping ratio and eigenvalue of
/// each motion.
///
/// The caller gives the number of motions so that parts of a sweep can be written one after the other with the same
/// columns. Motions beyond that number are left out; a mechanism of `n` coordinates and speeds has up to `2 n`, or more
/// where motions are replaced by others.
#[must_use]
pub fn sweep_table(d: &Description, inputs: &[f64], input: Input, points: &[SweepPoint], motions: usize) -> Table {
    let mut table = columns(d, input, points, motions, &moving(d, points)).finish().0;
    table.operating_point(d, inputs, Some(input));
    table
}

/// `sweep`: [`sweep_table`] with all motions; `critical states`, if any.
impl Answer for Sweep {
    const KIND: &'static str = "sweep";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::along(&self.description, &self.inputs, self.input))
    }

    fn findings(&self) -> Findings {
        let (d, points) = (&self.description, &self.points);
        let title = title_along(d, &self.inputs, self.input);
        let mut said = Findings::titled(format!("{title}: sweep"));
        not_reached(&mut said, self.unreached);
        let solved = || points.iter().filter_map(|point| point.modes.as_ref().ok());
        let labels = solved().flat_map(|modes| modes.modes.iter().map(|mode| mode.label + 1));
        let moving = moving(d, points);
        let motions = labels.max().unwrap_or(0);
        said.columns(columns(d, self.input, points, motions, &moving));
        moving.rest(&mut said);
        let (rows, all) = (shown(points.len()).len(), points.len());
        if rows < all {
            said.note(format!("{rows} of {all} points are shown: {EVERYTHING}."));
        }
        for critical in &self.critical {
            let location = place(d, self.input, critical.value);
            said.note(format!("critical at {location} ({})", critical.kind));
        }
        unresolved(&mut said, d, self.input, self.searched.as_ref());
        if let Some(table) = critical_columns(&self.critical) {
            said.data(table.finish().0);
        }
        if let Some(modes) = solved().next() {
            undamped(&mut said, modes.family, d);
        }
        said
    }
}

displayed!(Sweep);

fn state(point: &SweepPoint) -> Option<&Equilibrium> {
    point.equilibrium.as_ref().ok()
}

/// All unknowns that move, reactions too.
fn moving<'a>(d: &'a Description, points: &[SweepPoint]) -> Moving<'a> {
    let roles = [Role::Position, Role::Speed, Role::PositionReaction, Role::VelocityReaction];
    Moving::of(d, points.iter().filter_map(state), &roles)
}

/// The reason why a point has no equilibrium or no modes.
fn error(point: &SweepPoint) -> Option<String> {
    point.solved().err().map(ToString::to_string)
}

fn columns<'a>(
    d: &Description,
    input: Input,
    points: &'a [SweepPoint],
    motions: usize,
    moving: &Moving<'_>,
) -> Columns<'a, SweepPoint> {
    let mut table = Columns::new("sweep", points);
    table.show_rows(shown(points.len()));
    varied(&mut table, d, input, given, &|x| x.value);
    table.unknowns(d, &|row| Some(&state(row)?.coordinates[..]));
    moving.columns(&mut table, &state);
    table.words("stability", &|row| Some(state(row)?.stability_word()));
    for label in 0..motions {
        let number_of = label + 1;
        let mode = |sweep_point: &SweepPoint, pick: fn(&Mode) -> Option<f64>| {
            let modes = &sweep_point.modes.as_ref().ok()?.modes;
            modes.iter().find(|mode| mode.label == label).and_then(pick)
        };
        let name = format!("frequency {number_of}");
        let column = table.number(&name, "rad/s", &|row| mode(row, Mode::frequency));
        let unit = &d.frequency;
        let symbol = format!("{}{number_of}", frequency_symbol(unit));
        column.digits_in(unit, number).headed(&heading(&symbol, unit));
        let name = format!("damping ratio {number_of}");
        table.number(&name, "", &|row| mode(row, Mode::damping_ratio));
        let name = format!("Re s {number_of}");
        table.number(&name, "1/s", &|row| mode(row, |mode| Some(mode.s.re)));
        let name = format!("Im s {number_of}");
        table.number(&name, "1/s", &|row| mode(row, |mode| Some(mode.s.im)));
    }
    table.cells("state", &|row| error(row).or_else(|| state(row).map(Equilibrium::stability_word)).unwrap_or_default());
    table.words("error", &error);
    table
}
