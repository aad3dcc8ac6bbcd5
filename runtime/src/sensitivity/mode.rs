//! Total derivatives of one mode.

use super::Quantity;
use crate::algebra::{Vector, all_finite, unless_finite};
use crate::modes::Family;
use crate::{Complex, Mode};

/// First derivatives of one number by every input and design variable.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound = "T: eigentol_statistics::serial::Exact + Copy + Default")
)]
pub struct Slopes<T> {
    /// By each input, per SI unit.
    pub by_input: Vector<T>,
    /// By each design variable, per SI unit.
    pub by_design: Vector<T>,
}

impl<T: Copy + Default> Slopes<T> {
    pub(crate) fn map<R: Copy + Default>(&self, f: impl Fn(T) -> R) -> Slopes<R> {
        Slopes {
            by_input: self.by_input.map(&f),
            by_design: self.by_design.map(&f),
        }
    }

    fn iter(&self) -> impl Iterator<Item = T> {
        self.by_input.iter().chain(&self.by_design).copied()
    }
}

impl<T: Copy + Default> Slopes<T> {
    fn empty() -> Self {
        Self {
            by_input: Vector::default(),
            by_design: Vector::default(),
        }
    }
}

/// Total derivatives of one mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModeSensitivity {
    /// `dlambda/du`, 1/s^2 per SI unit of the input; `lambda = -Re s^2`. Zero, as by the design variables, where `s` has no
    /// derivative because it has merged with another eigenvalue.
    pub lambda_by_input: Vector,
    /// `dlambda/db`, 1/s^2 per SI unit of the design variable.
    pub lambda_by_design: Vector,
    /// `ds`, 1/s per SI unit; `None` where the eigenvalue has no derivative: an undamped neutral mode, a general one that
    /// has merged with another.
    pub s: Option<Slopes<Complex>>,
    /// `domega/du`, rad/s per SI unit (eq. 21), `omega = Im s`; `None` for a mode that does not oscillate.
    pub omega_by_input: Option<Vector>,
    /// `domega/db`, rad/s per SI unit (eq. 21); `None` for a mode that does not oscillate.
    pub omega_by_design: Option<Vector>,
    /// The mode is a member of a cluster of nearly equal eigenvalues ([`Modes::cluster_of`](crate::Modes::cluster_of)): these numbers belong to the
    /// computed basis of the cluster and would differ in another. What does exist are [`directional_derivatives`](crate::clusters::directional_derivatives).
    pub clustered: bool,
    /// The eigenvalue they belong to.
    value: Complex,
}

impl ModeSensitivity {
    /// Total derivatives of a quantity of the mode; `None` where it has none, or one beyond the range of a double.
    #[must_use]
    pub fn of(&self, quantity: Quantity) -> Option<Slopes<f64>> {
        let oscillates = self.omega_by_design.is_some();
        if !oscillates && quantity != Quantity::Growth {
            return None;
        }
        let slopes = self.s.as_ref()?.map(|ds| quantity.slope(self.value, ds));
        let finite = all_finite(&slopes.by_input) && all_finite(&slopes.by_design);
        finite.then_some(slopes)
    }

    /// What stands where derivatives are going to be written.
    pub(crate) fn blank() -> Self {
        Self {
            lambda_by_input: Vector::default(),
            lambda_by_design: Vector::default(),
            s: None,
            omega_by_input: None,
            omega_by_design: None,
            clustered: false,
            value: Complex::ZERO,
        }
    }

    /// Goes to a mode, apart from all others, with these derivatives of its eigenvalue: of `lambda` (real part) for an undamped
    /// mode, of `s` for a general one.
    pub(crate) fn set(&mut self, mode: &Mode, family: Family, slopes: &Slopes<Complex>) {
        let (by_input, by_design) = (slopes.by_input.iter(), slopes.by_design.iter());
        match family {
            Family::Undamped => {
                let real = |slope: &Complex| slope.re;
                self.set_undamped(mode, by_input.map(real), by_design.map(real));
            }
            Family::General => self.set_general(mode, by_input.copied(), by_design.copied()),
        }
    }

    /// Goes to an undamped mode, apart from all others, with these derivatives of `lambda`.
    #[inline]
    pub(crate) fn set_undamped(
        &mut self,
        mode: &Mode,
        by_input: impl ExactSizeIterator<Item = f64>,
        by_design: impl ExactSizeIterator<Item = f64>,
    ) {
        self.lambda_by_input.assign(by_input);
        self.lambda_by_design.assign(by_design);
        self.finish_undamped(mode);
    }

    /// Room for the derivatives of `lambda` by so many inputs and design variables. Once they are written,
    /// [`Self::finish_undamped`] adds what follows from them.
    #[inline(always)]
    pub(crate) fn make_room(&mut self, inputs: usize, design: usize) -> [&mut [f64]; 2] {
        [
            self.lambda_by_input.make_room(inputs),
            self.lambda_by_design.make_room(design),
        ]
    }

    /// Goes to an undamped mode, apart from all others, whose derivatives of `lambda` are written.
    #[inline]
    pub(crate) fn finish_undamped(&mut self, mode: &Mode) {
        // ds = -dlambda / (2 s), `s` real or imaginary
        if mode.s.im > 0.0 {
            let s = self.s.get_or_insert_with(Slopes::empty);
            let rate = 0.5 / mode.s.im;
            let omega = self.omega_by_input.get_or_insert_default();
            oscillating(rate, &self.lambda_by_input, &mut s.by_input, omega);
            let omega = self.omega_by_design.get_or_insert_default();
            oscillating(rate, &self.lambda_by_design, &mut s.by_design, omega);
            self.clustered = false;
            self.value = mode.s;
            return;
        }
        if mode.s.re > 0.0 {
            let s = self.s.get_or_insert_with(Slopes::empty);
            let rate = -0.5 / mode.s.re;
            let slope = |dlambda: &f64| Complex::new(rate * dlambda, 0.0);
            s.by_input.assign(self.lambda_by_input.iter().map(slope));
            s.by_design.assign(self.lambda_by_design.iter().map(slope));
        } else {
            self.s = None;
        }
        self.finish(mode, false);
    }

    /// Goes to a general mode with these derivatives of `s`; where they are not finite, it has merged with another.
    pub(crate) fn set_general(
        &mut self,
        mode: &Mode,
        by_input: impl ExactSizeIterator<Item = Complex>,
        by_design: impl ExactSizeIterator<Item = Complex>,
    ) {
        let s = self.s.get_or_insert_with(Slopes::empty);
        s.by_input.assign(by_input);
        s.by_design.assign(by_design);
        let lambda = |ds: &Complex| -2.0 * (mode.s * ds).re;
        self.lambda_by_input.set(&s.by_input, lambda);
        self.lambda_by_design.set(&s.by_design, lambda);
        let (inputs, design) = (s.by_input.len(), s.by_design.len());
        let rest: f64 = s.iter().map(|ds| unless_finite(ds.l1_norm())).sum();
        if rest == 0.0 && self.lambda_is_finite() {
            self.finish(mode, false);
        } else {
            self.set_merged(mode, inputs, design);
        }
    }

    /// Goes to a general mode that has merged with another: it has no derivatives by so many variables.
    pub(crate) fn set_merged(&mut self, mode: &Mode, inputs: usize, design: usize) {
        self.lambda_by_input = Vector::zeros(inputs);
        self.lambda_by_design = Vector::zeros(design);
        self.s = None;
        self.finish(mode, true);
    }

    /// What follows from `s`.
    #[inline]
    fn finish(&mut self, mode: &Mode, clustered: bool) {
        match &self.s {
            Some(s) if mode.frequency().is_some() => {
                let by_input = self.omega_by_input.get_or_insert_default();
                by_input.set(&s.by_input, |ds| ds.im);
                let by_design = self.omega_by_design.get_or_insert_default();
                by_design.set(&s.by_design, |ds| ds.im);
            }
            _ => (self.omega_by_input, self.omega_by_design) = (None, None),
        }
        self.clustered = clustered;
        self.value = mode.s;
    }

    fn lambda_is_finite(&self) -> bool {
        all_finite(&self.lambda_by_input) && all_finite(&self.lambda_by_design)
    }

    #[inline]
    pub(crate) fn finite(&self) -> bool {
        match &self.s {
            // As finite as those of `lambda`, from which they come or which come from them.
            Some(s) => {
                let rest = |z: Complex| unless_finite(z.re) + unless_finite(z.im);
                s.iter().map(rest).sum::<f64>() == 0.0
            }
            None => self.lambda_is_finite(),
        }
    }
}

/// `domega = rate dlambda` of an undamped mode that oscillates, and `ds`.
#[inline(always)]
fn oscillating(rate: f64, dlambda: &[f64], ds: &mut Vector<Complex>, domega: &mut Vector) {
    let count = dlambda.len();
    let (ds, domega) = (ds.make_room(count), domega.make_room(count));
    for ((ds, domega), dlambda) in ds.iter_mut().zip(domega).zip(dlambda) {
        *domega = rate * dlambda;
        *ds = Complex::new(0.0, *domega);
    }
}
