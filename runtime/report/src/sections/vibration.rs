//! Forced vibration: amplitudes at the operating point and along the swept input.

use eigentol::forced::{ForcedResponse, Harmonic};
use eigentol::response::{Response, Vibration};
use eigentol::{Any, Excitation};
use eigentol_figures::{bode, orbit, polar};
use eigentol_tables::{Answer as _, Table};

use super::{MODES, refused};
use crate::Error;
use crate::charts::{chart, charts};
use crate::content::Content;
use crate::forced::{Forced, ForcedAlong, harmonics};
use crate::html::Html;
use crate::tables::table;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let Some(forced) = &content.forced else {
        return Ok(());
    };
    at_point(html, content, forced)?;
    match &forced.along {
        Some(along) => along_input(html, content, along),
        None => Ok(()),
    }
}

fn at_point(html: &mut Html, content: &Content, forced: &Forced) -> Result<(), Error> {
    let response = match &forced.response {
        Ok(response) => response,
        Err(error) => {
            refused(html, "there is no steady vibration", error);
            return Ok(());
        }
    };
    html.paragraph("Amplitudes are from 0 to peak, half of peak to peak; a positive phase is ahead of cos(w t).");
    motion(html, content);
    let several = response.harmonics.iter().any(|harmonic| harmonic.shares.len() > 1);
    for listing in response.tables() {
        match &*listing.name {
            "forced response" => {
                let columns = ["excitations", "frequency", "output", "unit", "amplitude", "phase"];
                table(html, "Vibration at the operating point", &listing, &columns)?;
            }
            "shares" if several => table(html, "What each excitation contributes", &listing, &[])?,
            _ => {}
        }
    }
    orbits(html, content, response)?;
    match &forced.spread {
        Some(Ok(spread)) => {
            let columns = ["response", "unit", "nominal", "mean", "sigma", "skewness"];
            for listing in spread.tables() {
                if listing.name == "spreads" {
                    table(html, "How tolerances spread the amplitudes", &listing, &columns)?;
                }
            }
        }
        Some(Err(error)) => refused(html, "amplitudes have no spread", error),
        None => {}
    }
    Ok(())
}

/// The orbits that were asked for, under each harmonic that moves them.
fn orbits(html: &mut Html, content: &Content, forced_response: &ForcedResponse) -> Result<(), Error> {
    for &[x, y] in &content.orbits {
        let moves = |harmonic: &Harmonic| {
            let orbit = harmonic.orbit(x, y);
            orbit.is_none_or(|orbit| orbit.semi_axes()[0] > 0.0)
        };
        let moved = harmonics(&content.description)
            .into_iter()
            .map(Excitation::<Any>::new)
            .filter(|x| forced_response.harmonic(*x).is_some_and(moves));
        let figures = moved.map(|harmonic| orbit(forced_response, [x, y], harmonic, &content.brief_style));
        charts(html, figures)?;
    }
    Ok(())
}

/// States which vibrations are seen in motion, and why others are not.
fn motion(html: &mut Html, content: &Content) {
    let Some(Ok(pictures)) = &content.pictures else {
        return;
    };
    if pictures.vibrations.iter().any(Result::is_ok) {
        html.paragraph("The view of the modes in 3-D shows the vibration of the whole mechanism too, about the equilibrium: what turns with a drive is seen standing still.");
    }
    for error in pictures.vibrations.iter().filter_map(|vibration| vibration.as_ref().err()) {
        refused(html, "a vibration is not shown in motion", error);
    }
}

/// The Bode plot of the first vibration, for the page with the answer.
pub(super) fn first(html: &mut Html, content: &Content) -> Result<(), Error> {
    let along = content.forced.as_ref().and_then(|forced| forced.along.as_ref());
    let (Some(along), Some(&vibration)) = (along, Vibration::all(&content.description).first()) else {
        return Ok(());
    };
    if let Ok(course) = &along.bode {
        let peaks: Vec<_> = along.peaks.iter().filter_map(|peak| peak.1.clone().ok()).collect();
        let name = Response::Vibration(vibration).name(&content.description);
        chart(html, &bode(course, vibration, &peaks, &content.brief_style.clone().title(format!("Vibration {name}"))))?;
    }
    Ok(())
}

fn along_input(html: &mut Html, content: &Content, along: &ForcedAlong) -> Result<(), Error> {
    let course = match &along.bode {
        Ok(bode) => bode,
        Err(error) => {
            refused(html, "vibration along the input is not known", error);
            return Ok(());
        }
    };
    let failed = course.points.iter().filter(|point| point.vibration.is_err()).count();
    if failed > 0 {
        let all = course.points.len();
        let text = format!("At {failed} of {all} values there is no vibration: the table says why.");
        html.leaf("p", &[("class", "refused")], &text);
    }
    let wanted = Vibration::all(&content.description);
    let peaks = along.peaks.iter().filter_map(|peak| peak.1.as_ref().ok());
    let peaks: Vec<_> = peaks.cloned().collect();
    for &vibration in wanted.iter().take(MODES) {
        let name = Response::Vibration(vibration).name(&content.description);
        let style = content.style.clone();
        let style = style.title(format!("Bode plot of {name}"));
        chart(html, &bode(course, vibration, &peaks, &style))?;
        let style = content.brief_style.clone();
        let style = style.title(format!("Polar plot of {name}"));
        chart(html, &polar(course, vibration, &peaks, &style))?;
    }
    if wanted.len() > MODES {
        let more = wanted.len() - MODES;
        html.paragraph(&format!("The other {more} vibrations are in the table."));
    }
    for (_, error) in along.peaks.iter().filter_map(|(x, answer)| Some((x, answer.as_ref().err()?))) {
        refused(html, "peaks are not known", error);
    }
    for listing in course.tables() {
        let caption = match &*listing.name {
            "bands" => "How tolerances spread the amplitudes along the input",
            _ => "Vibration along the input",
        };
        table(html, caption, &listing, &on_a_page(&listing))?;
    }
    Ok(())
}

/// The columns that fit on a page; the rest is available by copying.
fn on_a_page(table: &Table) -> Vec<&str> {
    let left_out = ["Re", "Im", "mean", "99.9 %", "designs solved anew"];
    table.columns.iter().map(|column| &*column.name).filter(|name| !left_out.contains(name)).collect()
}
