//! Figures of a page. Their text is HTML; the script draws the rest.

use eigentol_figures::Figure;

use crate::Error;
use crate::html::Html;
use crate::words::sentence;

/// Writes a figure, or a sentence that explains why it is missing.
///
/// # Errors
/// [`Error::Data`].
pub(crate) fn chart(html: &mut Html, figure: &Result<Figure, eigentol_figures::Error>) -> Result<(), Error> {
    let figure = match figure {
        Ok(figure) => figure,
        Err(why) => {
            html.leaf("p", &[("class", "refused")], &sentence(&why.to_string()));
            return Ok(());
        }
    };
    let json = serde_json::to_string(figure)?;
    html.element("figure", &[("class", "chart")], |html| {
        html.leaf("h3", &[], &figure.title);
        html.leaf("div", &[("class", "drawing")], "");
        html.element("figcaption", &[], |html| {
            for line in &figure.caption {
                html.paragraph(line);
            }
        });
        html.data("figure", &json);
    });
    Ok(())
}

/// Writes several figures, side by side where there is room.
///
/// # Errors
/// The errors of [`chart`].
pub(crate) fn charts(
    html: &mut Html,
    figures: impl Iterator<Item = Result<Figure, eigentol_figures::Error>>,
) -> Result<(), Error> {
    html.constant("<div class=\"pair\">\n");
    let mut drawn = figures.map(|figure| chart(html, &figure));
    let done = drawn.find(Result::is_err).unwrap_or(Ok(()));
    drop(drawn);
    html.constant("</div>\n");
    done
}
