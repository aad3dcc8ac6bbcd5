//! The sections of a report, one per question.

mod along;
mod brief;
mod distributions;
mod equilibrium;
mod laws;
mod mechanism;
mod modes;
mod parts;
mod shares;
mod variables;
pub(crate) use modes::player;
mod verdicts;
mod vibration;

use crate::Error;
use crate::content::Content;
use crate::html::Html;
use crate::part::{self, Part};
use crate::words::sentence;

/// The section that is the answer.
const ANSWER: &str = "brief";

/// A question: anchor, heading, and what writes the answer.
pub(crate) struct Section {
    pub(crate) id: &'static str,
    pub(crate) heading: &'static str,
    /// The part that asks it, besides all.
    part: Part,
    write: Write,
}

type Write = fn(&mut Html, &Content) -> Result<(), Error>;

/// The sections, in order. What nothing excites has none about forced vibration.
pub(crate) fn of(content: &Content) -> Vec<Section> {
    let all: [(_, _, _, Write); 9] = [
        (ANSWER, "In short", Part::AtPoint, brief::section),
        ("mechanism", "Mechanism", Part::AtPoint, mechanism::section),
        ("equilibrium", "Equilibrium", Part::AtPoint, equilibrium::section),
        ("modes", "Modes", Part::AtPoint, modes::section),
        ("vibration", "Forced vibration", Part::Along, vibration::section),
        ("verdicts", "Tolerances", Part::Along, verdicts::section),
        ("shares", "Contributions", Part::AtPoint, shares::section),
        ("distributions", "Distributions", Part::All, distributions::section),
        ("along", "Along an input", Part::Along, along::section),
    ];
    all.into_iter()
        .map(|(id, heading, part, write)| Section { id, heading, part, write })
        .filter(|item| item.id != "vibration" || content.forced.is_some())
        .collect()
}

/// The sections of a part.
///
/// # Errors
/// [`Error::Data`].
pub(crate) fn each(content: &Content, part: Part) -> Result<Vec<part::Section>, Error> {
    let wanted = of(content).into_iter().filter(|own| part == Part::All || own.part == part);
    let written = wanted.map(|Section { id, heading, write, .. }| {
        let mut html = Html::default();
        write(&mut html, content)?;
        Ok(part::Section { id, heading, html: html.finish() })
    });
    written.collect()
}

/// Writes all sections.
///
/// # Errors
/// [`Error::Data`].
pub(crate) fn all(html: &mut Html, content: &Content) -> Result<(), Error> {
    for Section { id, heading, write, .. } in of(content) {
        let mut written = Ok(());
        // The answer is on one page; the details unfold.
        if id == ANSWER {
            html.element("section", &[("id", id)], |html| {
                html.leaf("h2", &[], heading);
                written = write(html, content);
            });
        } else {
            html.element("details", &[("id", id), ("class", "section")], |html| {
                html.element("summary", &[], |html| html.leaf("h2", &[], heading));
                written = write(html, content);
            });
        }
        html.constant("\n");
        written?;
    }
    Ok(())
}

/// Maximum number of modes with figures of their own.
const MODES: usize = 6;

/// The modes with figures of their own: the first, those that oscillate before others.
fn foremost(content: &Content, count: usize) -> Vec<usize> {
    match &content.modes {
        Ok(modes) => modes.foremost(MODES),
        Err(_) => (0..count.min(MODES)).collect(),
    }
}

/// Notes how many modes have no figures.
fn beyond(html: &mut Html, modes: usize, what: &str) {
    if modes > MODES {
        let more = modes - MODES;
        html.paragraph(&format!("The {what} {more} more modes are in the table."));
    }
}

/// States why something is missing.
fn refused(html: &mut Html, what: &str, why: &eigentol::Error) {
    let text = sentence(&format!("{what}: {why}"));
    html.leaf("p", &[("class", "refused")], &text);
}
