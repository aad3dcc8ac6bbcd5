//! Sampled distributions compared with first order.

use eigentol_figures::Histogram;
use eigentol_tables::Answer as _;

use super::brief::stable_samples;
use super::verdicts::NOTHING_VARIES;
use super::{MODES, beyond, refused};
use crate::Error;
use crate::charts::charts;
use crate::content::Content;
use crate::html::Html;
use crate::tables::table;
use crate::words::capital;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let Some(spread) = &content.spread else {
        html.leaf("p", &[("class", "refused")], NOTHING_VARIES);
        return Ok(());
    };
    let found = match &spread.monte_carlo {
        Ok(monte_carlo) => monte_carlo,
        Err(error) => {
            refused(html, "there are no samples", error);
            return Ok(());
        }
    };
    html.paragraph(&format!(
        "Monte Carlo ({}): in each sample the variables have other values within their tolerances, and it is solved anew. {}",
        found.drawn(),
        stable_samples(found).1
    ));
    if found.samples < found.planned {
        let planned = found.planned;
        html.paragraph(&format!("Not complete: {planned} samples were asked for."));
    }
    let count = found.modes.len();
    let figures = (0..count.min(MODES)).map(|mode| {
        let style = &content.brief_style;
        let style = style.clone().title(capital(&style.mode(mode)));
        let mut histogram = Histogram::new(found, mode);
        if let Ok(summary) = &spread.summary {
            histogram = histogram.first_order(&summary.first);
        }
        histogram.figure(&style)
    });
    charts(html, figures)?;
    beyond(html, count, "distributions of");
    for own in found.tables() {
        if own.name == "outcomes" && found.counts.stable == found.samples {
            continue;
        }
        let caption = match &*own.name {
            "outcomes" => format!("What became of {}", found.drawn()),
            _ => format!("Statistics of {}", found.drawn()),
        };
        let columns: &[&str] = match &*own.name {
            "outcomes" => &["outcome", "samples"],
            _ => &[
                "mode",
                "samples of frequency",
                "mean of frequency",
                "standard error of frequency",
                "sigma of frequency",
                "skewness of frequency",
                "least of frequency",
                "greatest of frequency",
            ],
        };
        table(html, &caption, &own, columns)?;
    }
    Ok(())
}
