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
mod verdicts;
mod vibration;

use crate::Error;
use crate::content::Content;
use crate::html::Html;
use crate::words::sentence;

/// Anchors and headings of the sections, in order.
pub(crate) const HEADINGS: [(&str, &str); 9] = [
    ("brief", "In short"),
    ("mechanism", "Mechanism"),
    ("equilibrium", "Equilibrium"),
    ("modes", "Modes"),
    ("vibration", "Forced vibration"),
    ("verdicts", "Tolerances"),
    ("shares", "Contributions"),
    ("distributions", "Distributions"),
    ("along", "Along an input"),
];

/// Writes a section.
type Section = fn(&mut Html, &Content) -> Result<(), Error>;

const SECTIONS: [Section; 9] = [
    brief::section,
    mechanism::section,
    equilibrium::section,
    modes::section,
    vibration::section,
    verdicts::section,
    shares::section,
    distributions::section,
    along::section,
];

/// Writes all sections.
///
/// # Errors
/// [`Error::Data`].
pub(crate) fn all(html: &mut Html, content: &Content) -> Result<(), Error> {
    for ((id, heading), section) in HEADINGS.into_iter().zip(SECTIONS) {
        let mut written = Ok(());
        html.element("section", &[("id", id)], |html| {
            html.leaf("h2", &[], heading);
            written = section(html, content);
        });
        html.constant("\n");
        written?;
    }
    Ok(())
}

/// Maximum number of modes with figures of their own.
const MODES: usize = 6;

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
