//! Inputs that deviate from their set values: tolerances of inputs become tolerances of additional design variables.
//!
//! # Inputs that deviate are design variables
//!
//! A wandering speed adds a design variable, the deviation, which `kernels/deviating_inputs` presents as another table
//! of kernels: no question knows of it, and each treats inputs like the design. Two questions compare a mode with an
//! input that itself deviates: engine orders (`sweep/event_sensitivity.rs`) and bands around a speed
//! (`requirement/second_order.rs` of `runtime/uncertainty`); the table tells them which input a design variable is the
//! deviation of.

mod batch;
mod deviations;
mod single;

use self::deviations::Deviations;
use super::Kernels;
use crate::algebra::Vector;
use crate::arguments::check_input;
use crate::mechanism::{Description, DesignInfo, Input, InputInfo, Shared, ToleranceInfo};
use crate::{DesignVariable, Error};

/// A mechanism whose inputs deviate from their set values, such as a speed that varies or a load that is not known
/// exactly.
///
/// Its design variables are those of the mechanism, followed by a deviation of each chosen input, nominally zero. The
/// mechanism receives the sum of the set value and the deviation as its input. Derivatives with respect to a deviation
/// therefore equal those with respect to its input, and every analysis of tolerances of design variables covers
/// tolerances of inputs as well, even while the input itself is swept. Values located along an input are set values.
///
/// A deviation has the name, the unit and the declared tolerance of its input, unless that tolerance is a fraction of
/// the value, which is unknown here: the deviation then has no tolerance, and `Tolerances` must be
/// given.
///
/// It provides every kind of kernel table that `K` provides, even if `K` is itself such a table: `dyn BatchKernels`.
#[derive(Debug)]
pub struct DeviatingInputs<'a, K: ?Sized> {
    kernels: &'a K,
    deviations: Deviations,
    description: Shared<Description>,
}

impl<'a, K: Kernels + ?Sized> DeviatingInputs<'a, K> {
    /// A mechanism in which each of these inputs has its own deviation. If an input is named more than once, its
    /// deviations add up.
    ///
    /// # Errors
    /// [`Error::UnknownHandle`] for an input that the mechanism does not have.
    pub fn new(kernels: &'a K, inputs: &[Input]) -> Result<Self, Error> {
        let original = kernels.description();
        inputs.iter().try_for_each(|input| check_input(*input, &original))?;
        let inputs: Vec<usize> = inputs.iter().map(|input| input.index()).collect();
        let deviations = inputs.iter().map(|&input| deviation_of(&original.inputs[input]));
        let design: Vec<DesignInfo> = original.design.iter().cloned().chain(deviations).collect();
        let description = Description { design: design.into(), ..Description::clone(&original) };
        Ok(Self {
            kernels,
            deviations: Deviations::new(kernels.sizes().design, inputs),
            description: Shared::Counted(description.into()),
        })
    }

    /// The deviating inputs, in the order of their deviations.
    pub fn inputs(&self) -> impl ExactSizeIterator<Item = Input> {
        self.deviations.inputs().iter().copied().map(Input::new)
    }

    /// Their deviations.
    pub fn deviations(&self) -> impl ExactSizeIterator<Item = DesignVariable> {
        let first = self.deviations.design();
        (0..self.deviations.inputs().len()).map(move |k| DesignVariable::new(first + k))
    }

    /// Design variables of the mechanism, SI, followed by deviations of zero.
    pub fn design(&self, b: &[f64]) -> Vector {
        let zeros = self.deviations.inputs().iter().map(|_| 0.0);
        b.iter().copied().chain(zeros).collect()
    }
}

fn deviation_of(input: &InputInfo) -> DesignInfo {
    let tolerance = if input.tolerance.relative { ToleranceInfo::NONE } else { input.tolerance.clone() };
    DesignInfo { name: input.name.clone(), unit: input.unit.clone(), nominal: 0.0, tolerance }
}
