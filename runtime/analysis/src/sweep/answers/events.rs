use std::slice;

use eigentol_results::numbers::{given, in_unit, number, per, percent, rough, rough_in, with_unit};
use eigentol_results::relevance::{BELOW, names, relevant};
use eigentol_results::shares::mostly;
use eigentol_results::title::title_along;
use eigentol_results::{Answer, Columns, Findings, Listed, Subject, displayed};

use crate::along::{name_of, place, together, value_of, varied};
use crate::modes::{Whirl, undamped};
use crate::sweep::{Change, Condition, Event, EventTolerance, Line, Searched};
use crate::tolerance::Spread;
use crate::{Description, Input};

/// `events`: one row.
impl Answer for EventTolerance {
    const KIND: &'static str = "event";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::along(&self.description, &self.inputs, self.input))
    }

    fn findings(&self) -> Findings {
        let mut said = Findings::titled(self.title());
        if let Ok(spread) = &self.spread {
            self.variables(&mut said, spread);
        }
        undamped(&mut said, self.family, &self.description);
        if let Some(table) = event_columns("events", slice::from_ref(&self)) {
            said.data(table.finish().0);
        }
        said
    }
}

/// `events`: a row for each, with its place along the input and how far tolerances shift it.
impl Listed for EventTolerance {
    const KIND: &'static str = "events";

    fn subject(&self) -> Option<Subject<'_>> {
        Answer::subject(self)
    }

    fn findings(all: &[Self]) -> Findings {
        let rows: Vec<&Self> = all.iter().collect();
        let mut said = together(all, event_columns("events", &rows), "event");
        if let Some(one) = all.first() {
            undamped(&mut said, one.family, &one.description);
        }
        said
    }
}

displayed!(EventTolerance);

impl EventTolerance {
    /// The event without the value: `frequency 1 crosses 2x speed (backward)`.
    pub(crate) fn what_happens(&self) -> String {
        let Some((mode, condition)) = self.meeting() else {
            return "critical".to_owned();
        };
        let name = name_of(&self.description, self.input);
        let kind = self.whirl();
        let kind = kind.map_or_else(String::new, |whirl| format!(" ({whirl})"));
        format!("{}{kind}", meeting(mode, condition, self.change, name))
    }

    fn meeting(&self) -> Option<(usize, Condition)> {
        match self.event {
            Event::Crossing { mode, condition, .. } => Some((mode, condition)),
            Event::Critical => None,
        }
    }

    fn whirl(&self) -> Option<Whirl> {
        match self.event {
            Event::Crossing { whirl, .. } => whirl,
            Event::Critical => None,
        }
    }

    fn title(&self) -> String {
        let d = &self.description;
        let (title, what) = (title_along(d, &self.inputs, self.input), self.what_happens());
        let location = place(d, self.input, self.value);
        match (&self.spread, d.inputs.get(self.input.index())) {
            (Ok(spread), Some(info)) => format!(
                "{title}: {what} at {} = {} +/- {} ({} sigma)",
                info.name,
                in_unit(self.value, &info.unit),
                with_unit(rough_in(spread.band, &info.unit), &info.unit),
                self.sigma_level
            ),
            (Ok(_), None) => format!("{title}: {what} at {location}"),
            (Err(error), _) => format!("{title}: {what} at {location}, without a spread: {error}"),
        }
    }

    /// The variables that shift it, the largest share first.
    fn variables(&self, said: &mut Findings, spread: &Spread) {
        let d = &self.description;
        let scale = d.inputs.get(self.input.index()).map_or(1.0, |info| info.unit.scale);
        let share = |k: usize| spread.variance_shares[k];
        let mut order: Vec<usize> = (0..d.design.len()).collect();
        order.sort_by(|&a, &b| share(b).abs().total_cmp(&share(a).abs()));
        let matters = |k: &usize| relevant(share(*k), 1.0);
        let (shown, left): (Vec<usize>, Vec<usize>) = order.into_iter().partition(matters);
        let mut table = Columns::new("variables", &shown);
        table.cells("derivative by", &|&k| per(&d.design[k].name, &d.design[k].unit));
        table.cells("value", &|&k| rough(spread.by_design[k] * d.design[k].unit.scale / scale));
        table.cells("share of variance", &|&k| percent(share(k)));
        said.text(table.finish().1);
        if !left.is_empty() {
            let left: Vec<&str> = left.iter().map(|&k| &*d.design[k].name).collect();
            let left = names(&left, "variables");
            said.note(format!("Left out, {BELOW} of the variance: {left}"));
        }
    }
}

/// The event of mode number `mode` at a value of the input called `name`, where growth changes like this.
pub(crate) fn meeting(mode: usize, condition: Condition, change: Change, name: &str) -> String {
    let mode = mode + 1;
    match condition {
        Condition::Line(line) => format!("frequency {mode} crosses {}", multiple(line, name)),
        Condition::FlutterOnset => match change {
            Change::End => format!("end of flutter of mode {mode}"),
            Change::Touch => format!("mode {mode} keeps its amplitude"),
            Change::ToDivergence => format!("flutter of mode {mode} turns into divergence"),
            Change::ToFlutter => format!("divergence turns into flutter of mode {mode}"),
            _ => format!("onset of flutter of mode {mode}"),
        },
    }
}

impl Searched {
    /// Where events may lie that are not resolved, and where nothing was searched: a sentence for each stretch.
    #[must_use]
    pub fn sentences(&self, d: &Description, input: Input) -> Vec<String> {
        let name = name_of(d, input);
        let ends = |from, to| [from, to].map(|value| value_of(d, input, value));
        let unresolved = self.unresolved.iter().map(|stretch| {
            let [from, to] = ends(stretch.from, stretch.to);
            let what = match stretch.condition {
                None => "vanishing stiffness".to_owned(),
                Some(Condition::FlutterOnset) => "flutter".to_owned(),
                Some(Condition::Line(line)) => format!("a frequency at {}", multiple(line, name)),
            };
            format!("unresolved: {what} between {name} = {from} and {to}")
        });
        let gaps = self.gaps.iter().map(|gap| {
            let [from, to] = ends(gap.from, gap.to);
            format!("not searched: {name} from {from} to {to}: {}", gap.reason)
        });
        unresolved.chain(gaps).collect()
    }
}

/// Says what is not resolved.
pub(crate) fn unresolved(said: &mut Findings, d: &Description, input: Input, searched: Option<&Searched>) {
    let (Some(searched), Some(info)) = (searched, d.inputs.get(input.index())) else {
        return;
    };
    for sentence in searched.sentences(d, input) {
        said.note(sentence);
    }
    if searched.unresolved.is_empty() {
        return;
    }
    let mut table = Columns::new("unresolved", &searched.unresolved);
    table.measured("from", &info.unit, &|row| Some(row.from));
    table.measured("to", &info.unit, &|row| Some(row.to));
    table.words("event", &|row| {
        let word = match row.condition {
            None => "critical",
            Some(Condition::FlutterOnset) => "flutter",
            Some(Condition::Line(_)) => "crossing",
        };
        Some(word.to_owned())
    });
    said.data(table.finish().0);
}

/// `2x speed + 30 rad/s`.
fn multiple(line: Line, name: &str) -> String {
    let times = format!("{}x {name}", given(line.ratio));
    match line.offset {
        0.0 => times,
        offset => format!("{times} + {} rad/s", given(offset)),
    }
}

/// The mode that meets each line: mode number, ratio, offset.
pub(super) fn meetings<R>(table: &mut Columns<'_, R>, of: &dyn Fn(&R) -> Option<(usize, Condition)>) {
    table.whole("mode", &|row| Some(of(row)?.0 + 1));
    let line = |row: &R| match of(row)?.1 {
        Condition::Line(line) => Some(line),
        Condition::FlutterOnset => None,
    };
    table.number("ratio", "", &|row| Some(line(row)?.ratio));
    table.number("offset", "rad/s", &|row| Some(line(row)?.offset));
}

/// A row for each event, its place along the input and how far tolerances shift it; `None` without events.
pub(crate) fn event_columns<'a>(name: &str, all: &'a [&'a EventTolerance]) -> Option<Columns<'a, &'a EventTolerance>> {
    let one = all.first()?;
    let d = &one.description;
    let spread = |event_tolerance: &&'a EventTolerance| event_tolerance.spread.as_ref().ok();
    let error = |event_tolerance: &&EventTolerance| Some(event_tolerance.spread.as_ref().err()?.to_string());
    let mut table = Columns::new(name, all);
    table.cells("what happens", &|row| row.what_happens());
    varied(&mut table, d, one.input, number, &|x| x.value);
    meetings(&mut table, &|x| x.meeting());
    table.words("kind", &|row| Some(row.whirl()?.kind.to_string()));
    table.words("whirl", &|row| Some(row.whirl()?.sense()?.to_string()));
    if let Some(info) = d.inputs.get(one.input.index()) {
        table.measured("sigma", &info.unit, &|row| Some(spread(row)?.sigma));
        let band = table.measured("band", &info.unit, &|row| Some(spread(row)?.band));
        (band.digits(rough)).headed(&format!("{} sigma", one.sigma_level));
        table.shares(d, &|row| Some(&spread(row)?.variance_shares[..]));
    }
    table.number("sigma level", "", &|row| Some(row.sigma_level));
    table.words("error", &error);
    table.cells("mostly from", &|row| {
        error(row).or_else(|| spread(row).map(|x| mostly(d, &x.variance_shares))).unwrap_or_default()
    });
    Some(table)
}
