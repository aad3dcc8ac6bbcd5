//! What is drawn on, and how drawing ends.

use plotters::coord::Shift;
use plotters::prelude::DrawingArea;

pub(super) type Area<B> = DrawingArea<B, Shift>;
pub(super) type Outcome = Result<(), String>;

pub(super) fn words(error: impl std::fmt::Display) -> String {
    error.to_string()
}
