//! How a figure looks: title, legend in rows of its own so that it hides no data, plot, note.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::clip::clip;
use super::{Curve, Figure, Markers, Shape};

type Svg<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Outcome<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

const SIZE: (u32, u32) = (960, 640);
const FONT: &str = "sans-serif";
const TITLE_HEIGHT: i32 = 52;
const LEGEND_HEIGHT: i32 = 26;
const NOTE_HEIGHT: i32 = 34;
const LEGEND_COLUMNS: usize = 3;
const LEFT: i32 = 84;
const SYMBOL: i32 = 36;

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
    let drawn = {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(figure, &area).map_err(|error| error.to_string())
    };
    drawn?;
    Ok(text)
}

fn draw<'a>(figure: &Figure, area: &Svg<'a>) -> Outcome<'a> {
    area.fill(&WHITE)?;
    let entries = figure.curves.len() + figure.markers.len();
    let legend_height = LEGEND_HEIGHT * entries.div_ceil(LEGEND_COLUMNS) as i32;
    let (title, rest) = area.split_vertically(TITLE_HEIGHT);
    let (key, rest) = rest.split_vertically(legend_height);
    let note_height = if figure.note.is_empty() { 8 } else { NOTE_HEIGHT };
    let plot_height = SIZE.1 as i32 - TITLE_HEIGHT - legend_height - note_height;
    let (plot_area, note) = rest.split_vertically(plot_height);
    let centre = SIZE.0 as i32 / 2;
    write(&title, &figure.title, (centre, TITLE_HEIGHT / 2), 24, HPos::Center)?;
    write(&note, &figure.note, (centre, note_height / 2), 15, HPos::Center)?;
    legend(figure, &key)?;
    plot(figure, &plot_area)?;
    area.present()
}

fn write<'a>(area: &Svg<'a>, text: &str, at: (i32, i32), size: i32, anchor: HPos) -> Outcome<'a> {
    let style = (FONT, size)
        .into_font()
        .color(&BLACK)
        .pos(Pos::new(anchor, VPos::Center));
    area.draw(&Text::new(text, at, style))
}

fn legend<'a>(figure: &Figure, area: &Svg<'a>) -> Outcome<'a> {
    let column = (SIZE.0 as i32 - LEFT) / LEGEND_COLUMNS as i32;
    let place = |index: usize| {
        let (row, number) = (index / LEGEND_COLUMNS, index % LEGEND_COLUMNS);
        (
            LEFT + column * number as i32,
            LEGEND_HEIGHT * row as i32 + LEGEND_HEIGHT / 2,
        )
    };
    for (index, curve) in figure.curves.iter().enumerate() {
        let (x, y) = place(index);
        line(area, curve, vec![(x, y), (x + SYMBOL, y)])?;
        write(area, &curve.label, (x + SYMBOL + 8, y), 16, HPos::Left)?;
    }
    for (index, markers) in figure.markers.iter().enumerate() {
        let (x, y) = place(figure.curves.len() + index);
        area.draw(&marker(markers, (x + SYMBOL / 2, y)))?;
        write(area, &markers.label, (x + SYMBOL + 8, y), 16, HPos::Left)?;
    }
    Ok(())
}

fn plot<'a>(figure: &Figure, area: &Svg<'a>) -> Outcome<'a> {
    let (low, high) = figure.speeds;
    let mut chart = ChartBuilder::on(area)
        .margin_right(24)
        .margin_top(10)
        .x_label_area_size(56)
        .y_label_area_size(LEFT)
        .build_cartesian_2d(low..high, 0.0..figure.top)?;
    chart
        .configure_mesh()
        .x_desc("drive speed [rad/s]")
        .y_desc(figure.values.as_str())
        .axis_desc_style((FONT, 19))
        .label_style((FONT, 17))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .x_labels(9)
        .y_labels(8)
        .draw()?;
    // All else is drawn in pixels of the same area, where a dash and a marker have their true size.
    let place = |point: &(f64, f64)| chart.backend_coord(point);
    let origin = area.get_base_pixel();
    let pixel = |point: &(f64, f64)| {
        let (x, y) = place(point);
        (x - origin.0, y - origin.1)
    };
    let (mark, name) = &figure.mark;
    if (low..=high).contains(mark) {
        let ends = vec![pixel(&(*mark, 0.0)), pixel(&(*mark, figure.top))];
        let (x, y) = ends[1];
        area.draw(&PathElement::new(ends, BLACK.mix(0.5)))?;
        write(area, name, (x + 6, y + 12), 15, HPos::Left)?;
    }
    for curve in &figure.curves {
        for piece in &curve.pieces {
            for part in clip(piece, 0.0, figure.top) {
                line(area, curve, part.iter().map(pixel).collect())?;
            }
        }
    }
    for markers in &figure.markers {
        let shown = markers.points.iter().filter(|point| point.1 <= figure.top);
        for point in shown {
            area.draw(&marker(markers, pixel(point)))?;
        }
    }
    Ok(())
}

fn line<'a>(area: &Svg<'a>, curve: &Curve, points: Vec<(i32, i32)>) -> Outcome<'a> {
    let style = colour(curve.colour).stroke_width(2);
    if curve.dashed {
        area.draw(&DashedPathElement::new(points, 7, 5, style))
    } else {
        area.draw(&PathElement::new(points, style))
    }
}

fn marker<'a>(markers: &Markers, at: (i32, i32)) -> DynElement<'static, SVGBackend<'a>, (i32, i32)> {
    let colour = colour(markers.colour);
    match markers.shape {
        Shape::Ring => Circle::new(at, 4, colour.stroke_width(1)).into_dyn(),
        Shape::Triangle => TriangleMarker::new(at, 5, colour.filled()).into_dyn(),
        Shape::Cross => Cross::new(at, 4, colour.stroke_width(1)).into_dyn(),
    }
}
