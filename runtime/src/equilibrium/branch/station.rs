//! A point on a branch with what is needed to go on from it, and the signs that tell that something lies between two.

use super::super::Equilibrium;
use super::curve::{Curve, Trouble, plane};
use super::frame::{Frame, Place, System};
use crate::array::{Cholesky, asymmetry};
use crate::constraints::Structure;
use crate::modes::free_pairs;
use crate::{Description, Linear, Mechanism};

/// A regular point of a branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Station<const N: usize, const U: usize, const P: usize> {
    pub(crate) place: Place<N>,
    pub(crate) equilibrium: Equilibrium<N, U, P>,
    pub(crate) frame: Frame<N>,
    /// Local unit tangent.
    pub(crate) tangent: Place<N>,
    pub(crate) signs: Signs,
}

/// Signs that change where something happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Signs {
    /// The input falls along the branch.
    pub(crate) falling: bool,
    /// The input stands still along the branch.
    pub(crate) vertical: bool,
    /// `det [Khat dg/du; t^T] < 0` where as many constraints as there are change no sign: changes where branches cross.
    pub(crate) crossed: bool,
    /// Number of negative eigenvalues of a symmetric `Khat`, along the directions that constraints leave free.
    pub(crate) negative: Option<usize>,
}

/// Tangents with a smaller part along the input are vertical.
pub(crate) const VERTICAL: f64 = 1e-10;

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Curve<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// The station at a place on the branch, its tangent on the side of `towards` (SI units).
    pub(crate) fn station(
        &self,
        place: &Place<N>,
        system: &System<N>,
        equilibrium: Equilibrium<N, U, P>,
        towards: &Place<N>,
        before: Option<&Signs>,
    ) -> Result<Station<N, U, P>, Trouble<N>> {
        let frame = self.frame(place, system);
        let scaled = frame.scaled(system);
        let singular = Trouble::Missed("the branch is not isolated");
        let towards = frame.direction(towards).unit();
        let factors = towards.and_then(|towards| plane(&scaled, &towards));
        let Some(factors) = factors else {
            return Err(singular);
        };
        let (q, [p]) = factors.solve(&[0.0; N], [1.0]);
        let tangent = Place { q, p }.unit().ok_or(singular)?;
        let vertical = tangent.p.abs() <= VERTICAL;
        let constraints = Structure::of(Self::DESCRIPTION).constraints();
        let signs = Signs {
            falling: match before {
                Some(before) if vertical => before.falling,
                _ => tangent.p < 0.0,
            },
            vertical,
            // Each constraint turns the sign: its multiplier adds a negative eigenvalue.
            crossed: factors.negative_determinant() != (constraints % 2 == 1),
            negative: if vertical {
                None
            } else {
                negative(&equilibrium.linear, Self::DESCRIPTION)
            },
        };
        // Cramer: sign det Khat = sign t_p sign det [Khat dg/du; t^T].
        let odd = signs.falling != signs.crossed;
        if signs.negative.is_some_and(|count| (count % 2 == 1) != odd) {
            return Err(Trouble::Missed("the stiffness is singular to rounding"));
        }
        Ok(Station {
            place: *place,
            equilibrium,
            frame,
            tangent,
            signs,
        })
    }

    /// The first station of a branch, its tangent towards the end of the range.
    pub(crate) fn first_station(
        &self,
        equilibrium: Equilibrium<N, U, P>,
    ) -> Result<Station<N, U, P>, Trouble<N>> {
        let place = Place {
            q: equilibrium.coordinates,
            p: equilibrium.inputs[self.settings.input.0],
        };
        let system = self.system(&place)?;
        let frame = self.frame(&place, &system);
        let scaled = frame.scaled(&system);
        let axis = |k: Option<usize>| Place {
            q: core::array::from_fn(|i| if k == Some(i) { 1.0 } else { 0.0 }),
            p: if k.is_none() { 1.0 } else { 0.0 },
        };
        let mut best: Option<Place<N>> = None;
        let mut share = 0.0;
        for k in core::iter::once(None).chain((0..N).map(Some)) {
            let Some(factors) = plane(&scaled, &axis(k)) else {
                continue;
            };
            let (q, [p]) = factors.solve(&[0.0; N], [1.0]);
            let found = Place { q, p };
            if found.finite() && 1.0 / found.norm() > share {
                share = 1.0 / found.norm();
                best = found.unit();
            }
        }
        let forward = (self.settings.high - self.settings.low).signum();
        let tangent = best.ok_or(Trouble::Missed("the branch is not isolated"))?;
        let tangent = tangent.scaled(if tangent.p * forward < 0.0 { -1.0 } else { 1.0 });
        let direction = frame.stretched(&tangent);
        self.station(&place, &system, equilibrium, &direction, None)
    }
}

impl<const N: usize, const U: usize, const P: usize> Station<N, U, P> {
    /// The same point, looking back.
    pub(crate) fn reversed(&self) -> Self {
        Self {
            tangent: self.tangent.scaled(-1.0),
            signs: Signs {
                falling: !self.signs.falling,
                crossed: !self.signs.crossed,
                ..self.signs
            },
            ..*self
        }
    }

    /// Whether the determinant of `Khat` (reduced by constraints), and where it is symmetric every eigenvalue, is positive.
    pub(crate) fn stiff(&self) -> bool {
        self.signs.falling == self.signs.crossed
            && self.signs.negative.is_none_or(|count| count == 0)
    }

    /// Tangent in SI units.
    pub(crate) fn direction(&self) -> Place<N> {
        self.frame.stretched(&self.tangent)
    }
}

/// Negative eigenvalues of a symmetric `Khat` along the directions that constraints leave free.
fn negative<const N: usize>(linear: &Linear<f64, N>, description: &Description) -> Option<usize> {
    if !symmetric_to_rounding(linear, description) {
        return None;
    }
    if Structure::of(description).open() && Cholesky::new(&linear.stiffness).is_ok() {
        return Some(0);
    }
    Some(free_pairs(linear, description).ok()?.negative())
}

/// Whether `Khat` has modes of its own: it is symmetric, and nothing in it belongs to speeds.
pub(crate) fn symmetric_to_rounding<const N: usize>(
    linear: &Linear<f64, N>,
    description: &Description,
) -> bool {
    Structure::of(description).holonomic()
        && (description.symmetric_stiffness || asymmetry(&linear.stiffness) <= 1e-11)
}
