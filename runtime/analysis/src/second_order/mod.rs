//! Second-order theory: the quadratic dependence of frequencies, outputs and critical values on tolerances, and the
//! exact distribution of such a quadratic model.

mod adjoint;
mod critical;
mod curvature;
mod derivatives;
mod distribution;
mod event;
mod forbidden_band;
mod margin;
mod moments;
mod nonlinearity;
mod output;
mod probability;
mod quadratic;
mod spread;

pub use critical::critical_curvature;
pub use curvature::{ModeCurvature, mode_curvature};
pub use derivatives::SecondDerivatives;
pub use event::{EventCurvature, crossing_curvature};
pub use forbidden_band::{Band, ModeMargin, mode_margin};
pub use margin::{Margin, MarginDerivatives, margin};
pub use nonlinearity::Nonlinearity;
pub use output::{OutputCurvature, output_curvature};
pub use probability::Probability;
pub use quadratic::{ModelMoments, Quadratic};
pub(crate) use spread::second_order_watched;
pub use spread::{ModeSecondOrder, SecondOrder, SecondOrderSpread, second_order};
