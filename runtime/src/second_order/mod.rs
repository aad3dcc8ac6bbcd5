//! Second order: how frequencies depend on tolerances quadratically, and the exact distribution of such a quadratic model.

mod curvature;
mod distribution;
mod forbidden_band;
mod margin;
mod moments;
mod nonlinearity;
mod probability;
mod quadratic;
mod spread;

pub use curvature::{ModeCurvature, SecondDerivatives, mode_curvature};
pub use forbidden_band::{Band, ModeMargin, mode_margin};
pub use margin::{Margin, MarginDerivatives, margin};
pub use nonlinearity::Nonlinearity;
pub use probability::Probability;
pub use quadratic::{ModelMoments, Quadratic};
pub(crate) use spread::second_order_watched;
pub use spread::{ModeSecondOrder, SecondOrder, SecondOrderSpread, second_order};
