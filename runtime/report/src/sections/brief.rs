//! The main findings, in sentences.

use eigentol::peaks::Peaks;
use eigentol::response::{Response, Vibration};
use eigentol::sweep::{Condition, Event, EventTolerance};
use eigentol::tolerance::{FirstOrder, MonteCarlo, Outcome};
use eigentol::{Behaviour, Campbell, Description, Modes};
use eigentol_figures::{self as figures, Style};

use super::verdicts::NOTHING_VARIES;
use super::vibration;
use crate::Error;
use crate::charts::chart;
use crate::content::{Along, Content, Spreads};
use crate::html::Html;
use crate::words::{digits, is_rounding, number, sentence, with_unit};

/// Maximum number of modes described individually.
const MODES: usize = 6;
/// Maximum number of events described individually.
const EVENTS: usize = 8;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    html.element("ul", &[("class", "verdicts")], |html| {
        for (good, text) in all(content) {
            let class = match good {
                Some(true) => "good",
                Some(false) => "bad",
                None => "fact",
            };
            html.leaf("li", &[("class", class)], &text);
        }
    });
    if super::modes::stand_with_the_answer(content) {
        super::modes::shapes(html, content)?;
    }
    html.constant("<div class=\"pair\">\n");
    if let Some(Ok(campbell)) = content.along.as_ref().map(|along| &along.campbell) {
        chart(html, &figures::campbell(campbell, &content.brief_style.clone().title("Campbell diagram")))?;
    }
    vibration::first(html, content)?;
    html.constant("</div>\n");
    Ok(())
}

/// Good news, bad news or neither.
type Line = (Option<bool>, String);

fn all(content: &Content) -> Vec<Line> {
    let mut lines = vec![equilibrium(content)];
    if let Ok(modes) = &content.modes {
        lines.extend(frequencies(content, modes));
    }
    lines.extend(vibrations(content));
    match &content.spread {
        None => lines.push((None, NOTHING_VARIES.to_owned())),
        Some(spread) => {
            let foremost = super::foremost(content, usize::MAX);
            lines.extend(tolerances(spread, &foremost, &content.brief_style));
        }
    }
    lines.extend(content.along.as_ref().map(|x| along(x, &content.brief_style)).unwrap_or_default());
    lines
}

fn equilibrium(content: &Content) -> Line {
    match &content.equilibrium {
        Err(error) => (Some(false), sentence(&format!("no equilibrium: {error}"))),
        Ok(state) if state.constraints.singular => {
            (Some(false), "The configuration is singular: stability is not decided.".to_owned())
        }
        Ok(state) => {
            let text = sentence(&format!("the equilibrium is {}", state.stability.predicate()));
            (Some(state.stability.holds()), text)
        }
    }
}

/// Each mode with its spread and the main source of that spread.
fn frequencies(content: &Content, modes: &Modes) -> Vec<Line> {
    let first = content.spread.as_ref().and_then(|spread| spread.first.as_ref().ok());
    let style = &content.brief_style;
    let (scale, unit) = style.frequency(&modes.description);
    let each = modes.foremost(MODES).into_iter().map(|r| (r, &modes.modes[r]));
    let mut lines: Vec<Line> = each
        .map(|(r, mode)| {
            let name = style.mode(r);
            let text = match mode.frequency() {
                Some(omega) => {
                    let spread = first.map_or_else(String::new, |first| spread_of(first, r, scale));
                    format!("{name} at {} {unit}{spread}: it {}", number(scale * omega), mode.behaviour)
                }
                None => format!("{name} does not oscillate: it {}", moves(mode.behaviour)),
            };
            let news = mode.behaviour.grows().then_some(false);
            (news, sentence(&text))
        })
        .collect();
    if modes.modes.len() > MODES {
        let more = modes.modes.len() - MODES;
        let still = modes.modes.iter().filter(|mode| mode.frequency().is_none()).count();
        let still = if still > 0 { format!(", {still} of all do not oscillate") } else { String::new() };
        lines.push((None, format!("{more} more modes are in the table of modes{still}.")));
    }
    lines
}

/// The amplitudes of the outputs at the operating point, and the highest peak of each along the input.
fn vibrations(content: &Content) -> Vec<Line> {
    let Some(forced) = &content.forced else {
        return Vec::new();
    };
    let d = &content.description;
    let at_point = |vibration: Vibration| -> Option<Line> {
        let amplitude = vibration.of(forced.response.as_ref().ok()?)?;
        let response = Response::Vibration(vibration);
        let height = with_unit(amplitude, &response.unit(d));
        Some((None, sentence(&format!("{} is {height} from 0 to peak", response.name(d)))))
    };
    let at_peak = |(vibration, peaks): &(Vibration, Result<Peaks, eigentol::Error>)| -> Option<Line> {
        let peaks = peaks.as_ref().ok()?;
        let highest = peaks.peaks.iter().max_by(|a, b| a.height.value.total_cmp(&b.height.value))?;
        let response = Response::Vibration(*vibration);
        let info = d.inputs.get(peaks.range.input.index())?;
        let [height, place] =
            [with_unit(highest.height.value, &response.unit(d)), with_unit(highest.place.value, &info.unit)];
        let unstable = if highest.stable { "" } else { ", at an unstable equilibrium" };
        Some((None, sentence(&format!("the highest peak of {} is {height}, at {place}{unstable}", response.name(d)))))
    };
    let wanted = Vibration::all(d).into_iter().filter(|_| forced.along.is_none());
    let peaks = forced.along.iter().flat_map(|along| &along.peaks);
    wanted.filter_map(at_point).take(MODES).chain(peaks.filter_map(at_peak).take(MODES)).collect()
}

/// What a mode without a frequency does, after "it".
fn moves(behaviour: Behaviour) -> String {
    match behaviour {
        Behaviour::Free => "is a motion that nothing resists, wherever the mechanism stands".to_owned(),
        Behaviour::Neutral => "is not resisted here: its stiffness vanishes at this operating point".to_owned(),
        other => other.to_string(),
    }
}

/// ` +- 0.2 (3 sigma), mostly by l (97 %)`.
fn spread_of(first: &FirstOrder, mode: usize, scale: f64) -> String {
    let Some(this_mode) = first.modes.get(mode).filter(|mode| !mode.clustered) else {
        return String::new();
    };
    let Some(spread) = this_mode.frequency().filter(|x| !is_rounding(x.sigma, x.mean)) else {
        return String::new();
    };
    let greatest = spread.variance_shares.iter().zip(first.description.design.iter()).max_by(|a, b| a.0.total_cmp(b.0));
    let cause = greatest
        .map_or_else(String::new, |(share, info)| format!(", mostly from {} ({:.0} %)", info.name, 100.0 * share));
    // The band lies about the mean, which unequal limits move away from the nominal frequency.
    let nominal = first.modes[mode].behaviour.frequency();
    let moved = nominal.is_some_and(|nominal| (spread.mean - nominal).abs() > 0.03 * spread.band);
    let about = if moved { format!(" about a mean of {}", number(scale * spread.mean)) } else { String::new() };
    format!(" \u{b1} {}{about} ({} sigma){cause}", digits(scale * spread.band, 3), first.sigma_level)
}

fn tolerances(spread: &Spreads, foremost: &[usize], style: &Style) -> Vec<Line> {
    let mut lines = Vec::new();
    match &spread.summary {
        None => {
            let error = spread.first.as_ref().err();
            lines.extend(error.map(|error| (Some(false), sentence(&format!("no spread: {error}")))));
        }
        Some(Ok(summary)) if summary.trusted() => {
            lines.push((Some(true), "The first-order spread of every mode can be trusted.".to_owned()));
        }
        Some(Ok(summary)) => {
            let told = |mode: usize| foremost.contains(&mode);
            let doubted = summary.trust.iter().filter(|x| !x.trusted() && told(x.mode));
            let doubted: Vec<String> = doubted.map(|doubted| style.mode(doubted.mode)).collect();
            lines.push(if doubted.is_empty() {
                (
                    Some(true),
                    "The first-order spread of these modes can be trusted, that of some others cannot.".to_owned(),
                )
            } else {
                let names = doubted.join(", ");
                (Some(false), format!("The first-order spread of {names} is not to be trusted. See Tolerances."))
            });
        }
        Some(Err(error)) => lines.push((Some(false), sentence(&format!("no spread: {error}")))),
    }
    if let Some(Ok(monte_carlo)) = &spread.monte_carlo {
        lines.push(stable_samples(monte_carlo));
    }
    lines
}

pub(super) fn stable_samples(monte_carlo: &MonteCarlo) -> Line {
    let (stable, all) = (monte_carlo.counts.stable, monte_carlo.samples);
    if stable == all {
        return (Some(true), format!("All {all} samples are stable."));
    }
    let others = Outcome::ALL.into_iter().filter(|x| *x != Outcome::Stable);
    let others = others.filter_map(|outcome| match monte_carlo.counts.of(outcome) {
        0 => None,
        count => Some(format!("{count} {}", word(outcome))),
    });
    let others: Vec<String> = others.collect();
    (Some(false), format!("{stable} of {all} samples are stable; {}.", others.join(", ")))
}

fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Stable => "stable",
        Outcome::Divergent => "diverge",
        Outcome::Flutter => "flutter",
        Outcome::Undecided => "are not decided",
        Outcome::NoEquilibrium => "have no equilibrium",
        Outcome::NotAssembled => "cannot be assembled",
        Outcome::Unphysical => "have bodies that cannot exist",
        _ => "have no modes",
    }
}

fn along(along: &Along, style: &Style) -> Vec<Line> {
    let Ok(campbell) = &along.campbell else {
        return Vec::new();
    };
    let bad = campbell.critical.iter().chain(&campbell.flutter_onsets);
    let bad: Vec<Line> = bad.map(|event| (Some(false), happening(campbell, event, style))).collect();
    let (d, input) = (&campbell.description, campbell.input);
    let unresolved = campbell.searched.iter().flat_map(|x| x.sentences(d, input));
    let unresolved = unresolved.map(|sentence| (None, format!("{sentence}.")));
    let met = campbell.crossings.iter().map(|event| (None, happening(campbell, event, style)));
    let mut lines: Vec<Line> = bad.into_iter().chain(unresolved).chain(met).collect();
    let more = lines.len().saturating_sub(EVENTS);
    lines.truncate(EVENTS);
    if more > 0 {
        lines.push((None, format!("{more} more events are in the tables along the input.")));
    }
    lines
}

/// `Mode 2 crosses 1x speed at 2045 rpm +- 27 (3 sigma).`
fn happening(campbell: &Campbell, event: &EventTolerance, style: &Style) -> String {
    let d: &Description = &campbell.description;
    let Some(info) = d.inputs.get(event.input.index()) else {
        return String::new();
    };
    let what = match event.event {
        Event::Crossing { mode, condition: Condition::Line(line), .. } => {
            format!("{} crosses {}x {}", style.mode(mode), line.ratio, info.name)
        }
        Event::Crossing { mode, .. } => format!("{} begins or ceases to grow", style.mode(mode)),
        _ => "the equilibrium loses its stiffness".to_owned(),
    };
    let spread = match &event.spread {
        Ok(spread) if spread.sigma > 0.0 => {
            format!(" \u{b1} {} ({} sigma)", digits(info.unit.from_si(spread.band), 3), event.sigma_level)
        }
        _ => String::new(),
    };
    let value = with_unit(event.value, &info.unit);
    let at = match event.event {
        Event::Crossing { condition: Condition::Line(_), .. } => value,
        _ => format!("{} = {value}", info.name),
    };
    sentence(&format!("{what} at {at}{spread}"))
}
