//! Total derivatives: how an equilibrium, its modes and the outputs move with inputs and design variables, the shift of
//! the equilibrium included (eqs. 19-21 completed).

mod adjoint;
mod clusters;
mod directional;
mod eigenvalues;
mod events;
mod explicit;
mod finite_difference;
mod gradients;
mod outputs;
mod pencil;
mod quantity;
mod redundancy;
mod second;
mod shapes;
mod shift;
mod sweep;

pub use adjoint::sensitivities;
pub(crate) use adjoint::sensitivities_into;
pub use clusters::{ModalCouplings, modal_couplings};
pub use directional::{DirectionalDerivatives, directional_derivatives};
pub(crate) use eigenvalues::eigenvalues;
pub use events::{critical_sensitivity, crossing_sensitivity};
pub use explicit::{sensitivities_explicit, sensitivities_with_frozen_equilibrium};
pub use finite_difference::sensitivities_by_finite_difference;
pub(crate) use gradients::{Cheaper, of_undamped};
pub use outputs::{OutputSensitivities, output_sensitivities};
pub use quantity::Quantity;
pub use second::{ModeCurvature, SecondDerivatives, mode_curvature};
pub use shapes::{ShapeSensitivity, shape_sensitivity};
pub use shift::{EquilibriumShift, equilibrium_shift};
pub use sweep::sensitivity_sweep;

use crate::array::{all_finite, unless_finite};
use crate::modes::{Family, PerMode, merged, near_another};
use crate::{Complex, Description, Equilibrium, Error, Mode, Modes};

/// How derivatives were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Adjoint: all variables at once.
    Adjoint,
    /// Explicit partial derivatives and the shift of the equilibrium.
    Explicit,
    /// The equilibrium held still: wrong wherever it moves; for comparison only.
    FrozenEquilibrium,
    /// Central differences of the matrices at re-solved equilibria.
    FiniteDifference,
}

/// First derivatives of one number by every input and design variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes<T, const U: usize, const P: usize> {
    /// By each input, per SI unit.
    pub by_input: [T; U],
    /// By each design variable, per SI unit.
    pub by_design: [T; P],
}

impl<T: Copy, const U: usize, const P: usize> Slopes<T, U, P> {
    #[inline]
    fn map<R>(&self, f: impl Fn(T) -> R) -> Slopes<R, U, P> {
        Slopes {
            by_input: self.by_input.map(&f),
            by_design: self.by_design.map(&f),
        }
    }
}

impl<const U: usize, const P: usize> Slopes<f64, U, P> {
    fn finite(&self) -> bool {
        all_finite(&self.by_input) && all_finite(&self.by_design)
    }
}

/// Total derivatives of one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeSensitivity<const U: usize, const P: usize> {
    /// `dlambda/du`, 1/s^2 by SI unit of the input; `lambda = -Re s^2`. Zero, as by the design variables, where `s` has no
    /// derivative because it has merged with another eigenvalue.
    pub lambda_by_input: [f64; U],
    /// `dlambda/db`, 1/s^2 by SI unit of the design variable.
    pub lambda_by_design: [f64; P],
    /// `ds`, 1/s by SI unit; `None` where the eigenvalue has no derivative: an undamped neutral mode, a general one that
    /// has merged with another.
    pub s: Option<Slopes<Complex, U, P>>,
    /// `domega/du`, rad/s by SI unit (eq. 21), `omega = Im s`; `None` for a mode that does not oscillate.
    pub omega_by_input: Option<[f64; U]>,
    /// `domega/db`, rad/s by SI unit (eq. 21); `None` for a mode that does not oscillate.
    pub omega_by_design: Option<[f64; P]>,
    /// The mode is a member of a cluster of nearly equal eigenvalues ([`Modes::cluster_of`]): these numbers belong to the
    /// computed basis of the cluster, any other one has others. What exists are [`directional_derivatives`].
    pub clustered: bool,
    /// The eigenvalue they belong to.
    value: Complex,
}

impl<const U: usize, const P: usize> ModeSensitivity<U, P> {
    /// Total derivatives of a quantity of the mode; `None` where it has none, or one beyond the range of a double.
    pub fn of(&self, quantity: Quantity) -> Option<Slopes<f64, U, P>> {
        let oscillates = self.omega_by_design.is_some();
        if !oscillates && quantity != Quantity::Growth {
            return None;
        }
        let slopes = self.s?.map(|ds| quantity.slope(self.value, ds));
        slopes.finite().then_some(slopes)
    }

    /// What stands where derivatives are going to be written.
    const BLANK: Self = Self {
        lambda_by_input: [0.0; U],
        lambda_by_design: [0.0; P],
        s: None,
        omega_by_input: None,
        omega_by_design: None,
        clustered: false,
        value: Complex::ZERO,
    };

    /// Goes to an undamped mode, apart from all others, with these derivatives of `lambda`.
    #[inline]
    pub(crate) fn set_undamped<const N: usize>(
        &mut self,
        mode: &Mode<N>,
        by_input: [f64; U],
        by_design: [f64; P],
    ) {
        let slopes = Slopes {
            by_input,
            by_design,
        };
        *self = Self::from_lambda(mode, slopes, false);
    }

    #[inline]
    fn from_lambda<const N: usize>(
        mode: &Mode<N>,
        lambda: Slopes<f64, U, P>,
        clustered: bool,
    ) -> Self {
        // ds = -dlambda / (2 s), `s` real or imaginary
        let s = if mode.s.im > 0.0 {
            let rate = 0.5 / mode.s.im;
            Some(lambda.map(|dlambda| Complex::new(0.0, rate * dlambda)))
        } else if mode.s.re > 0.0 {
            let rate = -0.5 / mode.s.re;
            Some(lambda.map(|dlambda| Complex::new(rate * dlambda, 0.0)))
        } else {
            None
        };
        Self::new(mode, lambda, s, clustered)
    }

    fn from_eigenvalue<const N: usize>(
        mode: &Mode<N>,
        s: Slopes<Complex, U, P>,
        clustered: bool,
    ) -> Self {
        let lambda = s.map(|ds| -2.0 * (mode.s * ds).re);
        let finite = lambda.finite() && s.map(|ds| ds.l1_norm()).finite();
        if finite {
            Self::new(mode, lambda, Some(s), clustered)
        } else {
            Self::merged(mode)
        }
    }

    /// A general mode that has merged with another: it has no derivatives.
    fn merged<const N: usize>(mode: &Mode<N>) -> Self {
        let none = Slopes {
            by_input: [0.0; U],
            by_design: [0.0; P],
        };
        Self::new(mode, none, None, true)
    }

    #[inline]
    fn new<const N: usize>(
        mode: &Mode<N>,
        lambda: Slopes<f64, U, P>,
        s: Option<Slopes<Complex, U, P>>,
        clustered: bool,
    ) -> Self {
        let omega = s.filter(|_| mode.frequency().is_some());
        Self {
            lambda_by_input: lambda.by_input,
            lambda_by_design: lambda.by_design,
            s,
            omega_by_input: omega.map(|s| s.by_input.map(|ds| ds.im)),
            omega_by_design: omega.map(|s| s.by_design.map(|ds| ds.im)),
            clustered,
            value: mode.s,
        }
    }

    #[inline]
    fn finite(&self) -> bool {
        match &self.s {
            // As finite as those of `lambda`, from which they come or which come from them.
            Some(s) => {
                let all = s.by_input.iter().chain(&s.by_design);
                let rest = |z: &Complex| unless_finite(z.re) + unless_finite(z.im);
                all.fold(0.0, |sum, ds| sum + rest(ds)) == 0.0
            }
            None => all_finite(&self.lambda_by_input) && all_finite(&self.lambda_by_design),
        }
    }
}

/// Total derivatives of all modes at one equilibrium, in the order of the modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensitivities<const N: usize, const U: usize, const P: usize> {
    /// One entry for each mode.
    pub modes: PerMode<ModeSensitivity<U, P>, N>,
    /// How they were found.
    pub method: Method,
    /// Which modes they belong to.
    pub family: Family,
    /// The mechanism they belong to.
    pub description: &'static Description,
}

impl<const N: usize, const U: usize, const P: usize> Sensitivities<N, U, P> {
    /// Room for the derivatives of these modes.
    #[inline]
    pub(crate) fn blank(modes: &Modes<N>, method: Method) -> Self {
        let mut blank = Self {
            modes: const { PerMode::blank(ModeSensitivity::BLANK) },
            method,
            family: modes.family,
            description: modes.description,
        };
        blank.modes.places(modes.modes.len());
        blank
    }

    /// The derivatives of every mode from those of its eigenvalue: of `lambda` (real part) for undamped modes, of `s` for
    /// general ones. Refuses what is not finite.
    #[inline]
    fn fill(
        &mut self,
        at: &Equilibrium<N, U, P>,
        modes: &Modes<N>,
        mut eigenvalue: impl FnMut(&Mode<N>) -> Slopes<Complex, U, P>,
    ) -> Result<(), Error> {
        let mut finite = true;
        for (position, (own, mode)) in self.modes.iter_mut().zip(&modes.modes).enumerate() {
            *own = if merged(modes, position) {
                ModeSensitivity::merged(mode)
            } else {
                let slopes = eigenvalue(mode);
                let clustered = near_another(modes, position, CLUSTER_GAP);
                match modes.family {
                    Family::Undamped => {
                        ModeSensitivity::from_lambda(mode, slopes.map(|value| value.re), clustered)
                    }
                    Family::General => ModeSensitivity::from_eigenvalue(mode, slopes, clustered),
                }
            };
            finite &= own.finite();
        }
        if finite {
            Ok(())
        } else {
            Err(shift::outside_domain(at))
        }
    }
}

/// Eigenvalues closer than this, relative to the larger, form a cluster whatever the tolerances are: rounding mixes their
/// shapes.
pub(crate) const CLUSTER_GAP: f64 = 1e-6;

/// As [`Sensitivities::fill`], by value.
fn assemble<const N: usize, const U: usize, const P: usize>(
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    method: Method,
    eigenvalue: impl FnMut(&Mode<N>) -> Slopes<Complex, U, P>,
) -> Result<Sensitivities<N, U, P>, Error> {
    let mut found = Sensitivities::blank(modes, method);
    found.fill(at, modes, eigenvalue)?;
    Ok(found)
}
