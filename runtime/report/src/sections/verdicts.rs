//! The effect of tolerances on the frequencies, and which numbers can be trusted.

use eigentol::summary::News;
use eigentol_tables::Answer as _;

use super::refused;
use crate::Error;
use crate::content::Content;
use crate::html::Html;
use crate::tables::table;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let summary = match content.spread.as_ref().map(|spread| &spread.summary) {
        None => {
            html.leaf("p", &[("class", "refused")], NOTHING_VARIES);
            return Ok(());
        }
        Some(None) => return Ok(()),
        Some(Some(Ok(summary))) => summary,
        Some(Some(Err(error))) => {
            refused(html, "the effect of tolerances is not known", error);
            return Ok(());
        }
    };
    html.element("ul", &[("class", "verdicts")], |html| {
        for sentence in summary.sentences() {
            let class = match sentence.news {
                News::Good => "good",
                News::Bad => "bad",
                _ => "fact",
            };
            html.leaf("li", &[("class", class)], &sentence.text);
        }
    });
    let columns =
        ["mode", "frequency", "sigma, first order", "sigma, second order", "sigma, sampled", "band", "trusted", "use"];
    let caption = format!(
        "Spread of the frequencies; a band holds {} standard deviations of first order",
        summary.first.sigma_level
    );
    if let Some(listing) = summary.tables().first() {
        table(html, &caption, listing, &columns)?;
    }
    let mixed = summary.trust.iter().any(|x| summary.cluster_of(x.mode).is_some());
    if mixed {
        let captions = [
            "Modes that tolerances mix, and the mean of each group",
            "The same modes by size: lowest, highest, and what lies between",
        ];
        for (listing, caption) in summary.clusters.tables().iter().zip(captions) {
            table(html, caption, listing, &[])?;
        }
    }
    Ok(())
}

/// Shown if no variable has a tolerance.
pub(super) const NOTHING_VARIES: &str = "No variable has a tolerance: nothing spreads.";
