//! Inputs that deviate from their set values: tolerances of inputs become tolerances of additional design variables.

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
/// the value, which is unknown here: the deviation then has no tolerance, and [`Tolerances`](crate::Tolerances) must be
/// given.
///
/// It provides every kind of kernel table that `K` provides, even if `K` is itself such a table: `dyn BatchKernels`.
///
/// ```
/// # use eigentol::mechanism;
/// # mechanism! {
/// #     mechanism RotatingPendulum {
/// #         input  omega: rad/s;
/// #         design m = 3.0 kg;
/// #         design l = 1.0 m +/- 3%;
/// #         gravity 9.81 m/s^2 along -z;
/// #         body shaft: massless;
/// #         body bar: rod(mass: m, length: l, along: -z);
/// #         joint spin:  revolute(z) from ground to shaft, driven at omega;
/// #         joint theta: revolute(y) from shaft to bar;
/// #     }
/// # }
/// use eigentol::kernels::DeviatingInputs;
/// use eigentol::{Policy, Tolerances, equilibrium, modes, sensitivity, tolerance};
///
/// let wandering = DeviatingInputs::new(&RotatingPendulum, &[RotatingPendulum::omega.any()])?;
/// let (u, b) = ([5.0], wandering.design(&[3.0, 1.0]));
/// let state = equilibrium::equilibrium(&wandering, &u, &b, &[1.0], Policy::Stable)?;
/// let found = modes::modes(&state)?;
///
/// // Exact mass and length, a speed of 5 rad/s +/- 0.3 rad/s.
/// let tolerances = Tolerances::new([0.0, 0.0, 0.3], 3.0, None)?;
/// let slopes = sensitivity::sensitivities(&wandering, &state, &found)?;
/// let spread = tolerance::first_order(&found, &slopes, &tolerances)?;
/// let sigma = spread.modes[0].frequency().map(|frequency| frequency.sigma);
///
/// // The frequency is sqrt(u^2 - (3 g / 2 l)^2 / u^2).
/// let (speed, natural) = (5.0_f64, 1.5 * 9.81);
/// let frequency = (speed.powi(2) - (natural / speed).powi(2)).sqrt();
/// let slope = (speed + natural.powi(2) / speed.powi(3)) / frequency;
/// assert!((sigma.expect("it swings") - 0.1 * slope).abs() < 1e-13);
/// # Ok::<(), eigentol::Error>(())
/// ```
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
        let own = kernels.description();
        inputs
            .iter()
            .try_for_each(|input| check_input(*input, &own))?;
        let inputs: Vec<usize> = inputs.iter().map(|input| input.index()).collect();
        let deviations = inputs.iter().map(|&input| deviation_of(&own.inputs[input]));
        let design: Vec<DesignInfo> = own.design.iter().cloned().chain(deviations).collect();
        let description = Description {
            design: design.into(),
            ..Description::clone(&own)
        };
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
    let tolerance = if input.tolerance.relative {
        ToleranceInfo::NONE
    } else {
        input.tolerance.clone()
    };
    DesignInfo {
        name: input.name.clone(),
        unit: input.unit.clone(),
        nominal: 0.0,
        tolerance,
    }
}
