//! Sampled distributions compared with first order.

use eigentol_figures::Histogram;
use eigentol_tables::Answer as _;

use super::brief::stable_samples;
use super::verdicts::NOTHING_VARIES;
use super::{beyond, foremost, refused};
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
    let monte_carlo = match &spread.monte_carlo {
        None => return Ok(()),
        Some(Ok(monte_carlo)) => monte_carlo,
        Some(Err(error)) => {
            refused(html, "there are no samples", error);
            return Ok(());
        }
    };
    html.paragraph(&format!(
        "Monte Carlo ({}): in each sample the variables have other values within their tolerances, and it is solved anew. {}",
        monte_carlo.drawn(),
        stable_samples(monte_carlo).1
    ));
    if monte_carlo.samples < monte_carlo.planned {
        let planned = monte_carlo.planned;
        html.paragraph(&format!("Not complete: {planned} samples were asked for."));
    }
    let count = monte_carlo.modes.len();
    let figures = foremost(content, count).into_iter().map(|mode| {
        let style = &content.brief_style;
        let style = style.clone().title(capital(&style.mode(mode)));
        let mut histogram = Histogram::new(monte_carlo, mode);
        if let Ok(first) = &spread.first {
            histogram = histogram.first_order(first);
        }
        histogram.figure(&style)
    });
    charts(html, figures)?;
    beyond(html, count, "distributions of");
    for listing in monte_carlo.tables() {
        if listing.name == "outcomes" && monte_carlo.counts.stable == monte_carlo.samples {
            continue;
        }
        let caption = match &*listing.name {
            "outcomes" => format!("What became of {}", monte_carlo.drawn()),
            _ => format!("Statistics of {}", monte_carlo.drawn()),
        };
        let columns: &[&str] = match &*listing.name {
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
        table(html, &caption, &listing, columns)?;
    }
    Ok(())
}
