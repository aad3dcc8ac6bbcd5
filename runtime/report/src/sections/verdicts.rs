//! What tolerances do to the frequencies, and which numbers can be trusted.

use eigentol::summary::{Advice, Doubt, Sampling, Summary};
use eigentol_tables::tables;

use super::refused;
use crate::Error;
use crate::content::Content;
use crate::html::Html;
use crate::tables::table;
use crate::words::sentence;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let summary = match &content.spread {
        None => {
            html.leaf("p", &[("class", "refused")], NOTHING_VARIES);
            return Ok(());
        }
        Some(spread) => &spread.summary,
    };
    let summary = match summary {
        Ok(summary) => summary,
        Err(error) => {
            refused(html, "the effect of tolerances is not known", error);
            return Ok(());
        }
    };
    html.element("ul", &[("class", "verdicts")], |html| {
        for (good, text) in sentences(summary) {
            html.leaf("li", &[("class", if good { "good" } else { "bad" })], &text);
        }
    });
    let columns = [
        "mode",
        "frequency",
        "sigma, first order",
        "sigma, second order",
        "sigma, sampled",
        "band",
        "trusted",
        "use",
    ];
    let caption = format!(
        "Spread of the frequencies; a band holds {} standard deviations of first order",
        summary.first.sigma_level
    );
    if let Some(own) = tables(summary).first() {
        table(html, &caption, own, &columns)?;
    }
    html.paragraph(&about_samples(&summary.sampling));
    let mixed = summary
        .trust
        .iter()
        .any(|own| summary.cluster_of(own.mode).is_some());
    if mixed {
        for own in tables(&summary.clusters[..]) {
            table(html, "Modes that tolerances mix", &own, &[])?;
        }
    }
    Ok(())
}

/// What is said where no variable has a tolerance.
pub(super) const NOTHING_VARIES: &str = "No variable has a tolerance: nothing spreads.";

/// `Mode 1`, `Modes 1, 2 and 4`.
pub(super) fn named(modes: &[usize]) -> String {
    match modes {
        [] => "No mode".to_owned(),
        [one] => format!("Mode {}", one + 1),
        [others @ .., last] => {
            let others: Vec<String> = others.iter().map(|mode| (mode + 1).to_string()).collect();
            format!("Modes {} and {}", others.join(", "), last + 1)
        }
    }
}

/// Each doubt once, with all the modes that share it, then what to use; and whether it is good news.
pub(super) fn sentences(summary: &Summary) -> Vec<(bool, String)> {
    let mut said: Vec<&Doubt> = Vec::new();
    let mut all = Vec::new();
    for doubt in summary.trust.iter().flat_map(|own| &own.doubts) {
        if said.contains(&doubt) {
            continue;
        }
        said.push(doubt);
        let shares = summary
            .trust
            .iter()
            .filter(|own| own.doubts.contains(doubt));
        let modes: Vec<usize> = shares.map(|own| own.mode).collect();
        all.push((false, sentence(&format!("{}: {doubt}", named(&modes)))));
    }
    for (advice, text) in [
        (
            Advice::FirstOrder,
            "nothing speaks against the first-order sigma.",
        ),
        (
            Advice::SecondOrder,
            "use second order, which agrees with the samples.",
        ),
        (Advice::Sampling, "use Monte Carlo."),
    ] {
        let own = summary.trust.iter().filter(|own| own.advice == advice);
        let modes: Vec<usize> = own.map(|own| own.mode).collect();
        if !modes.is_empty() {
            all.push((
                advice == Advice::FirstOrder,
                format!("{}: {text}", named(&modes)),
            ));
        }
    }
    all
}

fn about_samples(sampling: &Sampling) -> String {
    match sampling {
        Sampling::Done(sampled) => format!(
            "Checked by {} samples, each solved anew at its own equilibrium.",
            sampled.samples
        ),
        Sampling::TooDear { operations, budget } => format!(
            "Not checked by samples: they would cost {operations:.1e} operations of {budget:.1e}. The verdicts rest on distances and second order."
        ),
        _ => "No samples were needed.".to_owned(),
    }
}
