//! The picture kernel.

use super::Kernels;
use crate::mechanism::{PictureInfo, Shared};

/// The visible geometry of a mechanism.
pub trait PictureKernels: Kernels {
    /// [`Mechanism::PICTURE`](eigentol_contract::Mechanism::PICTURE).
    fn picture_info(&self) -> Shared<PictureInfo>;

    /// [`Mechanism::picture`](eigentol_contract::Mechanism::picture): one number for each position in
    /// [`PictureInfo::computed`].
    fn picture_into(&self, q: &[f64], u: &[f64], b: &[f64], computed: &mut [f64]);
}
