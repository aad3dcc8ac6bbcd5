//! The page: head, sections in order, scripts.
//!
//! # A report is words, tables and data for a small program
//!
//! `runtime/report` asks a study each question once (`content.rs`); from there on nothing is generic. Words and tables
//! are HTML, so a page without scripts still says everything. Figures and the scene are JSON beside them, and
//! `assets/*.js` draw them: charts as SVG, the mechanism on a canvas from back to front. Text enters the page through
//! one type that escapes it (`html.rs`), and in the scripts only as text; a content security policy forbids the page to
//! load anything. The tests drive Chromium over the DevTools protocol, a WebSocket and JSON, because crates for this
//! generate and build the whole protocol.

use crate::content::Content;
use crate::html::Html;
use crate::scene::View;
use crate::words::operating_point;
use crate::{Error, sections};

/// Scripts in dependency order, joined into one module so that none of their names is global.
const SCRIPTS: [&str; 10] = [
    include_str!("../assets/svg.js"),
    include_str!("../assets/axes.js"),
    include_str!("../assets/chart.js"),
    include_str!("../assets/tables.js"),
    include_str!("../assets/vectors.js"),
    include_str!("../assets/solids.js"),
    include_str!("../assets/stations.js"),
    include_str!("../assets/view3d.js"),
    include_str!("../assets/player.js"),
    include_str!("../assets/page.js"),
];

/// Forbids loading anything, whatever text the page contains.
const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'";

/// The text of the HTML file.
///
/// # Errors
/// [`Error::Data`].
pub(crate) fn html(content: &Content) -> Result<String, Error> {
    let mut html = Html::default();
    begin(&mut html, &content.title);
    header(&mut html, content);
    html.constant("<main>\n");
    sections::all(&mut html, content)?;
    html.constant("</main>\n");
    footer(&mut html);
    Ok(end(html, ""))
}

/// A page with nothing but the mechanism in motion.
///
/// # Errors
/// [`Error::Data`].
pub(crate) fn motion(title: &str, view: &View<'_>) -> Result<String, Error> {
    let mut html = Html::default();
    begin(&mut html, title);
    html.constant("<main>\n");
    html.leaf("h1", &[], title);
    sections::player(&mut html, view)?;
    html.constant("</main>\n");
    Ok(end(html, ""))
}

/// An empty page in the style of a report, with a style sheet and a module of its own behind those of a report, that may ask
/// where it comes from. The module draws what it adds to the page with `enliven(element)`.
#[must_use]
pub fn frame(title: &str, style: &'static str, module: &'static str) -> String {
    let mut html = Html::default();
    head(&mut html, title, &format!("{POLICY}; connect-src 'self'"), style);
    html.constant("<main></main>\n");
    end(html, module)
}

/// The head of a page, up to its body.
fn begin(html: &mut Html, title: &str) {
    head(html, title, POLICY, "");
}

fn head(html: &mut Html, title: &str, policy: &str, style: &'static str) {
    html.constant("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    html.open("meta", &[("http-equiv", "Content-Security-Policy"), ("content", policy)]);
    html.constant("\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    html.leaf("title", &[], title);
    html.constant("\n<style>\n");
    html.constant(include_str!("../assets/report.css"));
    html.constant(style);
    html.constant("</style>\n</head>\n<body>\n");
}

/// The scripts that bring a page to life, and its end.
fn end(mut html: Html, module: &'static str) -> String {
    html.constant("<script type=\"module\">\n");
    for script in SCRIPTS {
        html.constant(script);
    }
    // In a block, so that its names are its own.
    for script in ["{\n", module, "}\n"] {
        html.constant(script);
    }
    html.constant("</script>\n</body>\n</html>\n");
    html.finish()
}

fn header(html: &mut Html, content: &Content) {
    let d = &content.description;
    html.element("header", &[], |html| {
        html.leaf("h1", &[], &content.title);
        let point = operating_point(d, &content.setup.inputs);
        let name = if point.is_empty() { d.name.to_string() } else { format!("{} at {point}", d.name) };
        html.leaf("p", &[("class", "subject")], &name);
        html.constant(
            "<noscript><p class=\"refused\">Charts, the view in 3-D and the copy buttons need JavaScript. Words and tables are here without it.</p></noscript>",
        );
        html.element("nav", &[("aria-label", "Sections")], |html| {
            for section in sections::of(content) {
                html.leaf("a", &[("href", &format!("#{}", section.id))], section.heading);
            }
        });
    });
}

fn footer(html: &mut Html) {
    html.element("footer", &[], |html| {
        html.paragraph(concat!(
            "Written by eigentol ",
            env!("CARGO_PKG_VERSION"),
            ". Values are in declared units. A tolerance and a band hold the number of standard deviations that is said beside them."
        ));
    });
}
