//! Crossings, critical values and flutter onsets, numbered, with their standard deviations.

use eigentol::modes::{Sense, Whirl};
use eigentol::sweep::{Condition, Event, EventTolerance};
use eigentol::{Campbell, Unit};

use super::along::input_unit;
use crate::caption::{in_unit, number, with_unit};
use crate::figure::{Colour, ErrorBar, Panel, Shape};
use crate::style::Style;

/// Maximum number of caption lines; nobody reads more.
const MOST: usize = 14;

/// Events in the order of their numbers: crossings, critical values, flutter onsets, each ascending.
pub(crate) fn events(campbell: &Campbell) -> Vec<&EventTolerance> {
    [&campbell.crossings, &campbell.critical, &campbell.flutter_onsets].into_iter().flatten().collect()
}

/// How an event is drawn.
fn look(event: &Event) -> (&'static str, Shape) {
    match event {
        Event::Crossing { condition: Condition::Line(_), whirl, .. } => match whirl.and_then(Whirl::sense) {
            Some(Sense::Forward) => ("crossing, forward whirl", Shape::Ring),
            Some(Sense::Backward) => ("crossing, backward whirl", Shape::Triangle),
            _ => ("crossing", Shape::Square),
        },
        Event::Crossing { .. } => ("limit of stability", Shape::Cross),
        _ => ("stiffness is lost", Shape::Diamond),
    }
}

/// Draws the events that `height` places, each with a horizontal error bar of as many standard deviations as the
/// tolerances span, and returns a caption line for each.
pub(crate) fn draw(
    panel: &mut Panel,
    campbell: &Campbell,
    style: &Style,
    height: impl Fn(&Event) -> Option<f64>,
) -> Vec<String> {
    let unit = input_unit(&campbell.description, campbell.input);
    let mut lines = Vec::new();
    let mut groups: Vec<(&str, Shape, Vec<ErrorBar>)> = Vec::new();
    for (index, event) in events(campbell).into_iter().enumerate() {
        let Some(height) = height(&event.event) else {
            continue;
        };
        let value = in_unit(event.value, &unit);
        let half = campbell.sigma_level * event.sigma().map(|sigma| in_unit(sigma, &unit)).unwrap_or(0.0);
        let bar = ErrorBar::level([value, height], half);
        let (words, shape) = look(&event.event);
        match groups.iter_mut().find(|group| group.0 == words) {
            Some(group) => group.2.push(bar),
            None => groups.push((words, shape, vec![bar])),
        }
        panel.label([value, height], (index + 1).to_string());
        lines.push(line(index + 1, event, style, &unit));
    }
    for (words, shape, bars) in groups {
        panel.error_bars(words, Colour::Black, shape, bars);
    }
    let more = lines.len().saturating_sub(MOST);
    lines.truncate(MOST);
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    lines
}

fn line(index: usize, event: &EventTolerance, style: &Style, unit: &Unit) -> String {
    let (what, value) = (words(event, style), with_unit(event.value, unit));
    match event.sigma() {
        Some(sigma) => format!("({index}) {what} at {value}, sigma {}", with_unit(sigma, unit)),
        None => format!("({index}) {what} at {value}, without a derivative"),
    }
}

/// What happens, and to which mode.
pub(super) fn words(event: &EventTolerance, style: &Style) -> String {
    match event.event {
        Event::Crossing { mode, condition: Condition::Line(line), whirl, .. } => {
            let name = style.whirling(mode, whirl.map(Whirl::character));
            let order = if line.ratio == 0.0 {
                format!("{} rad/s", number(line.offset))
            } else {
                format!("{} x", number(line.ratio))
            };
            format!("{name} meets {order}")
        }
        Event::Crossing { mode, .. } => format!("{}: limit of stability", style.mode(mode)),
        _ => "stiffness is lost".to_owned(),
    }
}
