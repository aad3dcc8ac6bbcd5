#![doc = include_str!("../README.md")]

mod caption;
#[cfg(feature = "draw")]
mod draw;
mod error;
pub mod figure;
mod results;
mod style;

#[cfg(feature = "draw")]
pub use draw::Form;
pub use error::Error;
pub use figure::Figure;
pub use results::{
    Along, Histogram, Spreads, bode, branches, campbell, damping_ratios, deflections, eigenvalues, equilibria,
    event_map, figure_of, frequencies, mode_shapes, orbit, participation, polar, root_locus, shares, shares_of_all,
};
pub use style::Style;
