//! The effect of tolerances: results of first order, second order, sampling and propagation.

mod first_order;
mod monte_carlo;
mod responses;
mod second_order;
mod shared;
mod summary;

pub(crate) use first_order::{FirstOrder, OutputTolerances};
pub(crate) use monte_carlo::MonteCarlo;
pub(crate) use responses::{Influence, Propagation, WorstCase};
pub(crate) use second_order::SecondOrder;
pub(crate) use shared::{counts, judgement};
pub(crate) use summary::Summary;
