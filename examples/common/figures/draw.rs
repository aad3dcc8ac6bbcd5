//! How a figure looks: title, legend in rows of its own so that it hides no data, plot, note.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::clip::clip;
use super::{Band, Curve, Figure, Markers, Shape};

type Svg<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Outcome<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

/// plotters places everything on whole pixels: drawn three times larger and scaled down, curves are smooth.
const SCALE: i32 = 3;
const WIDTH: i32 = 960 * SCALE;
const HEIGHT: i32 = 640 * SCALE;
const FONT: &str = "sans-serif";
const TITLE_HEIGHT: i32 = 52 * SCALE;
const LEGEND_HEIGHT: i32 = 26 * SCALE;
const NOTE_HEIGHT: i32 = 36 * SCALE;
const LEGEND_COLUMNS: usize = 3;
const LEFT: i32 = 92 * SCALE;
const RIGHT: i32 = 24 * SCALE;
const SYMBOL: i32 = 36 * SCALE;
const LINE: u32 = 2 * SCALE as u32;

/// Colours that stay apart for colour-blind readers (Okabe and Ito 2008).
const PALETTE: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(90, 90, 90),
    RGBColor(0, 0, 0),
];

fn colour(index: usize) -> RGBColor {
    PALETTE[index % PALETTE.len()]
}

/// The figure as SVG text.
pub(super) fn svg(figure: &Figure) -> Result<String, Box<dyn std::error::Error>> {
    let mut text = String::new();
    let area =
        SVGBackend::with_string(&mut text, (WIDTH as u32, HEIGHT as u32)).into_drawing_area();
    let drawn = draw(figure, &area).map_err(|error| error.to_string());
    drop(area);
    drawn?;
    let large = format!("width=\"{WIDTH}\" height=\"{HEIGHT}\"");
    let shown = format!("width=\"{}\" height=\"{}\"", WIDTH / SCALE, HEIGHT / SCALE);
    Ok(text.replacen(&large, &shown, 1))
}

fn draw<'a>(figure: &Figure, area: &Svg<'a>) -> Outcome<'a> {
    area.fill(&WHITE)?;
    let entries = named(figure).count() + shaded(figure).count() + figure.markers.len() + 1;
    let legend_height = LEGEND_HEIGHT * entries.div_ceil(LEGEND_COLUMNS) as i32;
    let note_height = if figure.note.is_empty() {
        NOTE_HEIGHT / 4
    } else {
        NOTE_HEIGHT
    };
    let (title, rest) = area.split_vertically(TITLE_HEIGHT);
    let (key, rest) = rest.split_vertically(legend_height);
    let (plot_area, note) =
        rest.split_vertically(HEIGHT - TITLE_HEIGHT - legend_height - note_height);
    let centre = WIDTH / 2;
    write(
        &title,
        &figure.title,
        (centre, TITLE_HEIGHT / 2),
        24,
        HPos::Center,
    )?;
    write(
        &note,
        &figure.note,
        (centre, note_height / 2),
        15,
        HPos::Center,
    )?;
    legend(figure, &key)?;
    plot(figure, &plot_area)?;
    area.present()
}

fn write<'a>(area: &Svg<'a>, text: &str, at: (i32, i32), size: i32, anchor: HPos) -> Outcome<'a> {
    let style = (FONT, size * SCALE)
        .into_font()
        .color(&BLACK)
        .pos(Pos::new(anchor, VPos::Center));
    area.draw(&Text::new(text, at, style))
}

/// The curves of the legend.
fn named(figure: &Figure) -> impl Iterator<Item = &Curve> {
    figure.curves.iter().filter(|curve| !curve.label.is_empty())
}

/// The bands of the legend.
fn shaded(figure: &Figure) -> impl Iterator<Item = &Band> {
    figure.bands.iter().filter(|band| !band.label.is_empty())
}

/// Curves, then bands, markers and the vertical line, filled row by row.
fn legend<'a>(figure: &Figure, area: &Svg<'a>) -> Outcome<'a> {
    let column = (WIDTH - LEFT) / LEGEND_COLUMNS as i32;
    let mut places = (0..).map(|index: usize| {
        let (row, number) = (index / LEGEND_COLUMNS, index % LEGEND_COLUMNS);
        let x = LEFT + column * number as i32;
        (x, LEGEND_HEIGHT * row as i32 + LEGEND_HEIGHT / 2)
    });
    let label = |(x, y): (i32, i32), text: &str| {
        write(area, text, (x + SYMBOL + 8 * SCALE, y), 16, HPos::Left)
    };
    for (curve, (x, y)) in named(figure).zip(&mut places) {
        line(area, curve, vec![(x, y), (x + SYMBOL, y)])?;
        label((x, y), &curve.label)?;
    }
    for (band, (x, y)) in shaded(figure).zip(&mut places) {
        let half = LEGEND_HEIGHT / 4;
        area.draw(&Rectangle::new(
            [(x, y - half), (x + SYMBOL, y + half)],
            shade(band),
        ))?;
        label((x, y), &band.label)?;
    }
    for (markers, (x, y)) in figure.markers.iter().zip(&mut places) {
        area.draw(&marker(markers, (x + SYMBOL / 2, y)))?;
        label((x, y), &markers.label)?;
    }
    if let Some((x, y)) = places.next().filter(|_| !figure.mark.1.is_empty()) {
        area.draw(&PathElement::new([(x, y), (x + SYMBOL, y)], mark()))?;
        label((x, y), &figure.mark.1)?;
    }
    Ok(())
}

fn plot<'a>(figure: &Figure, area: &Svg<'a>) -> Outcome<'a> {
    let ((low, high), (bottom, top)) = (figure.speeds, figure.range);
    let mut chart = ChartBuilder::on(area)
        .margin_left(20 * SCALE)
        .margin_right(RIGHT)
        .margin_top(10 * SCALE)
        .x_label_area_size(56 * SCALE)
        .y_label_area_size(LEFT - 20 * SCALE)
        .build_cartesian_2d(low..high, bottom..top)?;
    chart
        .configure_mesh()
        .x_desc(figure.speed.as_str())
        .y_desc(figure.values.as_str())
        .axis_desc_style((FONT, 19 * SCALE))
        .label_style((FONT, 17 * SCALE))
        .axis_style(BLACK.stroke_width(SCALE as u32))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12).stroke_width(SCALE as u32))
        .set_all_tick_mark_size(5 * SCALE)
        .x_labels(9)
        .y_labels(8)
        .x_label_formatter(&|value| tick(*value))
        .y_label_formatter(&|value| tick(*value))
        .draw()?;
    // All else is drawn in pixels of the same area, where a dash and a marker have their true size.
    let origin = area.get_base_pixel();
    let pixel = |point: &(f64, f64)| {
        let (x, y) = chart.backend_coord(point);
        (x - origin.0, y - origin.1)
    };
    for band in &figure.bands {
        let lower = band.edges.iter().map(|&(speed, lower, _)| (speed, lower));
        let upper = band
            .edges
            .iter()
            .rev()
            .map(|&(speed, _, upper)| (speed, upper));
        let outline = lower.chain(upper);
        let outline = outline.map(|(speed, value)| pixel(&(speed, value.clamp(bottom, top))));
        area.draw(&Polygon::new(outline.collect::<Vec<_>>(), shade(band)))?;
    }
    let position = figure.mark.0;
    if (low..=high).contains(&position) {
        let ends = [(position, bottom), (position, top)].map(|point| pixel(&point));
        area.draw(&PathElement::new(ends, mark()))?;
    }
    for curve in &figure.curves {
        for part in curve
            .pieces
            .iter()
            .flat_map(|piece| clip(piece, bottom, top))
        {
            line(area, curve, part.iter().map(pixel).collect())?;
        }
    }
    for markers in &figure.markers {
        let shown = |point: &&(f64, f64)| (bottom..=top).contains(&point.1);
        for point in markers.points.iter().filter(shown) {
            area.draw(&marker(markers, pixel(point)))?;
        }
    }
    for (point, text) in &figure.labels {
        let (x, y) = pixel(point);
        write(area, text, (x + 6 * SCALE, y + 12 * SCALE), 15, HPos::Left)?;
    }
    Ok(())
}

/// The number beside a tick, without needless decimals.
fn tick(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_owned()
}

/// The thin vertical line.
fn mark() -> ShapeStyle {
    BLACK.mix(0.5).stroke_width(SCALE as u32)
}

/// The filling of a band.
fn shade(band: &Band) -> ShapeStyle {
    colour(band.colour).mix(0.2).filled()
}

fn line<'a>(area: &Svg<'a>, curve: &Curve, points: Vec<(i32, i32)>) -> Outcome<'a> {
    let style = colour(curve.colour).stroke_width(LINE);
    if curve.dashed {
        area.draw(&DashedPathElement::new(points, 7 * SCALE, 5 * SCALE, style))
    } else {
        area.draw(&PathElement::new(points, style))
    }
}

fn marker<'a>(
    markers: &Markers,
    at: (i32, i32),
) -> DynElement<'static, SVGBackend<'a>, (i32, i32)> {
    let colour = colour(markers.colour);
    let thin = colour.stroke_width(4 * SCALE as u32 / 3);
    match markers.shape {
        Shape::Ring => Circle::new(at, 4 * SCALE, thin).into_dyn(),
        Shape::Triangle => TriangleMarker::new(at, 5 * SCALE, colour.filled()).into_dyn(),
        Shape::Cross => Cross::new(at, 4 * SCALE, thin).into_dyn(),
    }
}
