//! Figures against the results they show.

mod along;
mod degenerate;
mod drawing;
mod machines;
mod paper;
mod point;
mod words;
