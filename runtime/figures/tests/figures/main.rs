//! Figures against the results they show.

mod along;
mod deflected;
mod degenerate;
mod drawing;
mod forced;
mod machines;
mod paper;
mod point;
mod words;
