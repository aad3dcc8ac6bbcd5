//! Campbell diagrams as text and tables: events, one line per mode, and the points.

use eigentol_results::numbers::{converted, frequency_symbol, given, given_in, number, optional, or_dash, rough};
use eigentol_results::relevance::{EVERYTHING, shown};
use eigentol_results::{Answer, Columns, Findings, Subject, Table, displayed};

use super::{Campbell, CampbellMode, CampbellPoint};
use crate::along::{not_reached, varied};
use crate::modes::{Character, Family, Sense, undamped};
use crate::sweep::{EventTolerance, event_columns, unresolved};
use crate::tolerance::{Spread, spread_of};
use crate::{Description, Error, Input};

/// A row for each mode at each value of the input, or one row without a mode if there are none.
///
/// Parts of a diagram can be written one after the other: all have the same columns.
///
/// ```
/// # use eigentol::{Study, mechanism};
/// # mechanism! {
/// #     mechanism Pendulum {
/// #         input  omega: rad/s;
/// #         design l = 2 m +/- 1 %;
/// #         gravity 9.81 m/s^2 along -z;
/// #         body shaft: massless;
/// #         body bar: rod(mass: 3 kg, length: l, along: -z);
/// #         joint spin:  revolute(z) from ground to shaft, driven at omega;
/// #         joint theta: revolute(y) from shaft to bar;
/// #     }
/// # }
/// use std::ops::ControlFlow;
/// use eigentol::campbell::campbell_table;
///
/// let study = Study::new(Pendulum);
/// let (d, inputs, input) = (study.description(), study.input_values(), Pendulum::omega.any());
/// let mut rows = 0;
/// study.campbell_each(Pendulum::omega, &[0.0, 1.0, 2.0], &[1.0], |point| {
///     rows += campbell_table(d, inputs, input, &[point]).rows();
///     ControlFlow::Continue(())
/// })?;
/// assert_eq!(rows, 3);
/// # Ok::<(), eigentol::Error>(())
/// ```
#[must_use]
pub fn campbell_table(d: &Description, inputs: &[f64], input: Input, points: &[CampbellPoint]) -> Table {
    let mut table = mode_table(d, input, points);
    table.operating_point(d, inputs, Some(input));
    table
}

/// `Campbell diagram`: [`campbell_table`]; then `crossings`, `critical states` and `flutter onsets`, if any.
impl Answer for Campbell {
    const KIND: &'static str = "Campbell diagram";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::along(&self.description, &self.inputs, self.input))
    }

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("Campbell diagram");
        not_reached(&mut said, self.unreached);
        said.data(mode_table(d, self.input, &self.points));
        self.events(&mut said);
        said.note_if_any(self.left_out());
        unresolved(&mut said, d, self.input, self.searched.as_ref());
        let few = self.shown();
        few.by_mode(&mut said);
        few.by_point(&mut said);
        said.note_if_any(self.modes_left_out(&few));
        undamped(&mut said, self.family, d);
        said
    }
}

displayed!(Campbell);

/// A mode at a value of the input, or the reason why there is none.
struct Row<'a> {
    value: f64,
    mode: Result<&'a CampbellMode, &'a Error>,
}

impl<'a> Row<'a> {
    fn all(points: &'a [CampbellPoint]) -> Vec<Self> {
        let mut rows = Vec::new();
        for point in points {
            let value = point.value;
            match &point.modes {
                Ok(modes) => rows.extend(modes.iter().map(|mode| Self { value, mode: Ok(mode) })),
                Err(error) => rows.push(Self { value, mode: Err(error) }),
            }
        }
        rows
    }

    fn mode(&self) -> Option<&'a CampbellMode> {
        self.mode.ok()
    }
}

impl CampbellMode {
    /// The standard deviation of one of its spreads, which a member of a cluster does not have.
    fn sigma(&self, spread: Option<&Spread>) -> Option<f64> {
        spread.filter(|_| !self.clustered).map(|x| x.sigma)
    }
}

fn mode_table(d: &Description, input: Input, points: &[CampbellPoint]) -> Table {
    let rows = Row::all(points);
    let mut table = Columns::new("Campbell diagram", &rows);
    varied(&mut table, d, input, given, &|row| row.value);
    table.whole("mode", &|row| Some(row.mode()?.label + 1));
    table.number("frequency", "rad/s", &|row| row.mode()?.behaviour.frequency());
    table.number("sigma of frequency", "rad/s", &|row| {
        let mode = row.mode()?;
        mode.sigma(mode.frequency.as_ref())
    });
    table.number("damping ratio", "", &|row| Some(row.mode()?.damping_ratio.as_ref()?.mean));
    table.number("sigma of damping ratio", "", &|row| {
        let mode = row.mode()?;
        mode.sigma(mode.damping_ratio.as_ref())
    });
    table.number("Re s", "1/s", &|row| Some(row.mode()?.s.re));
    table.number("Im s", "1/s", &|row| Some(row.mode()?.s.im));
    table.words("kind", &|row| Some(row.mode()?.whirl?.kind.to_string()));
    table.words("whirl", &|row| Some(row.mode()?.whirl?.sense()?.to_string()));
    table.number("whirl ratio", "", &|row| row.mode()?.whirl?.ratio);
    table.words("motion", &|row| Some(row.mode()?.behaviour.word().to_owned()));
    table.flag("cluster", &|row| Some(row.mode()?.clustered));
    table.words("error", &|row| row.mode.err().map(ToString::to_string));
    table.finish().0
}

/// A mode at each value of the input at which it was found.
struct Motion<'a> {
    label: usize,
    points: Vec<(f64, &'a CampbellMode)>,
}

impl Motion<'_> {
    fn frequency(&self, point: Option<&(f64, &CampbellMode)>) -> Option<f64> {
        point?.1.behaviour.frequency()
    }

    /// Where its frequency spreads most, and how far.
    fn widest(&self) -> Option<(f64, f64)> {
        let single = self.points.iter().filter(|(_, x)| !x.clustered);
        let spreads = single.filter_map(|(value, item)| Some((*value, spread_of(item.frequency.as_ref()?))));
        spreads.filter(|(_, sigma)| *sigma > 0.0).max_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Where its damping ratio is smallest.
    fn least_damped(&self) -> Option<(f64, &CampbellMode, &Spread)> {
        let damped = self.points.iter();
        let damped = damped.filter_map(|(value, item)| Some((*value, *item, item.damping_ratio.as_ref()?)));
        damped.min_by(|(.., a), (.., b)| a.mean.total_cmp(&b.mean))
    }

    /// Its kinds and the senses in which it whirls, in order; planar only if it never circles.
    fn kinds(&self) -> String {
        let mut said: Vec<(Character, String)> = Vec::new();
        for next in self.points.iter().filter_map(|(_, mode)| mode.whirl) {
            let (character, word) = (next.character(), next.to_string());
            match said.last_mut() {
                Some((last, _)) if last.kind == character.kind && character.sense == Some(Sense::Planar) => {}
                Some(last) if last.0.kind == character.kind && last.0.sense == Some(Sense::Planar) => {
                    *last = (character, word);
                }
                Some((_, last)) if *last == word => {}
                _ => said.push((character, word)),
            }
        }
        let words: Vec<String> = said.into_iter().map(|(_, word)| word).collect();
        if words.is_empty() { "-".to_owned() } else { words.join(", then ") }
    }

    /// Its behaviours in order, each once.
    fn behaviours(&self) -> String {
        let mut said: Vec<&str> = self.points.iter().map(|(_, mode)| mode.behaviour.word()).collect();
        said.dedup();
        said.join(", then ")
    }
}

impl Campbell {
    /// Critical values, onsets of flutter and crossings: together in the text, apart in the data.
    fn events(&self, said: &mut Findings) {
        let events = self.critical.iter().chain(&self.flutter_onsets);
        let all: Vec<&EventTolerance> = events.chain(&self.crossings).collect();
        if let Some(table) = event_columns("events", &all) {
            said.text(table.finish().1);
        }
        for (name, events) in [
            ("crossings", &self.crossings),
            ("critical states", &self.critical),
            ("flutter onsets", &self.flutter_onsets),
        ] {
            let rows: Vec<&EventTolerance> = events.iter().collect();
            if let Some(table) = event_columns(name, &rows) {
                said.data(table.finish().0);
            }
        }
    }

    /// Each mode over the whole range: its largest spread and its smallest damping.
    fn by_mode(&self, said: &mut Findings) {
        let Some(info) = self.description.inputs.get(self.input.index()) else {
            return;
        };
        let formatted = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| given_in(value, &info.unit));
        let labels = self.labels().into_iter();
        let motions: Vec<Motion<'_>> =
            labels.map(|label| Motion { label, points: self.branch(label).collect() }).collect();
        let mut table = Columns::new("modes", &motions);
        table.cells("mode", &|row| (row.label + 1).to_string());
        let d = &*self.description;
        table.frequencies(frequency_symbol(&d.frequency), d, number, &|row| row.frequency(row.points.first()));
        let in_unit = |omega: f64| converted(omega, &d.frequency);
        table.cells("to", &|row| optional(row.frequency(row.points.last()).map(in_unit)));
        table.cells("most sigma", &|row| or_dash(row.widest().map(|pair| in_unit(pair.1)), rough));
        let at = format!("at {}", info.name);
        table.cells(&at, &|row| formatted(row.widest().map(|pair| pair.0)));
        let damped = |row: &Motion<'_>| row.least_damped().is_some_and(|(.., x)| x.mean != 0.0);
        if self.family == Family::General && motions.iter().any(damped) {
            table.cells("least damping ratio", &|row| or_dash(row.least_damped().map(|(.., x)| x.mean), rough));
            table.cells("sigma", &|row| {
                or_dash(row.least_damped().filter(|(_, mode, _)| !mode.clustered).map(|(.., x)| spread_of(x)), rough)
            });
            table.cells(&at, &|row| formatted(row.least_damped().map(|pair| pair.0)));
        }
        if motions.iter().any(|motion| motion.kinds() != "-") {
            table.cells("kind", &Motion::kinds);
        }
        table.cells("motion", &Motion::behaviours);
        said.text(table.finish().1);
    }

    /// The frequencies at some of the input values.
    fn by_point(&self, said: &mut Findings) {
        let mut table = Columns::new("points", &self.points);
        let rows = shown(self.points.len());
        let (count, all) = (rows.len(), self.points.len());
        table.show_rows(rows);
        varied(&mut table, &self.description, self.input, given, &|x| x.value);
        for label in self.labels() {
            let frequency = |campbell_point: &CampbellPoint| {
                campbell_point.modes.as_ref().ok()?.iter().find(|mode| mode.label == label)?.behaviour.frequency()
            };
            if self.points.iter().any(|point| frequency(point).is_some()) {
                let name = format!("{}{}", frequency_symbol(&self.description.frequency), label + 1);
                table.frequencies(&name, &self.description, number, &|row| frequency(row));
            }
        }
        let failed = self.points.iter().filter(|point| point.modes.is_err()).count();
        if failed > 0 {
            table.cells("error", &|row| row.modes.as_ref().err().map_or_else(|| "-".to_owned(), ToString::to_string));
        }
        said.text(table.finish().1);
        if failed > 0 {
            said.note(format!("{failed} of {all} points have no modes."));
        }
        if count < all {
            said.note(format!("{count} of {all} points are shown: {EVERYTHING}, with sigma, damping and kind."));
        }
    }
}
