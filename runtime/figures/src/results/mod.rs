//! Figures of the results of the library, one file for each kind.

mod along;
mod any;
mod bode;
mod branches;
mod campbell;
mod damping;
mod deflection;
mod eigenvalues;
mod ends;
mod equilibria;
mod event_map;
mod events;
mod frequencies;
mod histogram;
mod orbit;
mod scale;
mod shapes;
mod shares;
mod spreads;
mod tracks;

pub use along::Along;
pub use any::figure_of;
pub use bode::{bode, polar};
pub use branches::branches;
pub use campbell::campbell;
pub use damping::damping_ratios;
pub use deflection::deflections;
pub use eigenvalues::{eigenvalues, root_locus};
pub use equilibria::equilibria;
pub use event_map::event_map;
pub use frequencies::frequencies;
pub use histogram::Histogram;
pub use orbit::orbit;
pub use shapes::{mode_shapes, participation};
pub use shares::{shares, shares_of_all};
pub use spreads::Spreads;
