//! Mistuning: how much higher than that of equal blades the vibration of the worst blade becomes.
//!
//! An engine order `r` acts on blade `k` of `N` with the phase `2 pi r k/N`, at any frequency. Equal blades answer in the
//! pattern with as many nodal diameters, all with one amplitude. Blades that differ mix the patterns; the amplification
//! factor is the highest amplitude of any blade at any frequency over that of equal blades. For blades that only couple with
//! their neighbours, Whitehead's `(1 + sqrt N)/2` is its greatest value (D. S. Whitehead, "Effect of mistuning on the
//! vibration of turbomachine blades induced by wakes", J. Mech. Eng. Sci. 8, 1966).
//!
//! The distribution is that of samples within the tolerances, each against equal blades with the mean of its own, on a model with matrices that are linear in the design, in the
//! modes near the resonance; some samples are solved as a whole, which measures the error of the model.

mod answer;
mod peak;

pub use peak::BladePeak;

use eigentol_contract::RingInfo;

use self::peak::{Driven, highest, undamped};
use crate::algebra::{Lu, Matrix, Vector};
use crate::eigenproblem::{Pairs, symmetric};
use crate::equilibrium::{Policy, equilibrium};
use crate::kernels::{DirectionalKernels, Linear};
use crate::sensitivity::directions;
use crate::shafts::refuse;
use crate::tolerance::{Draw, Tolerances};
use crate::{Complex, Description, Equilibrium, Error, Shared, Text, Watch};

/// What is asked: which blades, which of their coordinates the order excites, and the order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EngineOrder {
    /// The ring, counted from 0.
    pub ring: usize,
    /// Which coordinate of the blades, counted from 0.
    pub coordinate: usize,
    /// The order.
    pub order: usize,
    /// Number of samples.
    pub samples: usize,
    /// Seed of the samples.
    pub seed: u64,
}

impl EngineOrder {
    /// An order on a ring and a coordinate of its blades, `flap`, by name; the first if none is given.
    ///
    /// # Errors
    /// [`Error::Setting`] if there is none.
    pub fn of(d: &Description, ring: Option<&str>, coordinate: Option<&str>, order: usize) -> Result<Self, Error> {
        let refuse = |message: String| Error::setting("engine order", message);
        let place = d.rings.iter().position(|own| ring.is_none_or(|ring| *own.name == *ring));
        let place = place.ok_or_else(|| match ring {
            Some(ring) => refuse(format!("no blades `{ring}` are declared with `cyclic`")),
            None => refuse("no blades are declared with `cyclic`".to_owned()),
        })?;
        let own = &d.rings[place];
        let first = own.coordinates.chunks_exact(own.members).map(|slots| &*d.coordinates[slots[0]].name);
        let names: Vec<&str> = first.map(|name| name.split_once("].").map_or(name, |(_, name)| name)).collect();
        let found = names.iter().position(|name| coordinate.is_none_or(|coordinate| coordinate == *name));
        let coordinate = found.ok_or_else(|| {
            let unknown = coordinate.unwrap_or_default();
            refuse(format!("each `{}` has no coordinate `{unknown}`, but `{}`", own.name, names.join("`, `")))
        })?;
        Ok(Self { ring: place, coordinate, order, samples: 1000, seed: 0 })
    }
}

/// The amplification of one engine order by mistuning.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mistuning {
    /// The name of the ring.
    pub ring: Text,
    /// The number of blades.
    pub blades: usize,
    /// The engine order.
    pub order: usize,
    /// The highest response of equal blades: each has the mean of their design variables.
    pub tuned: BladePeak,
    /// The highest response of the blades as they are.
    pub built: BladePeak,
    /// The amplification factor of the blades as they are.
    pub factor: f64,
    /// Its derivatives by each design variable, per SI unit; that of the tuned response is in them. `None` where several
    /// blades are the worst, as equal ones are: which of them depends on the sign of a change.
    pub by_design: Option<Vector>,
    /// Amplification factors within the tolerances, ascending.
    pub sampled: Vector,
    /// In how many of the samples each blade was the worst.
    pub worst: Vec<usize>,
    /// How many samples were also solved as a whole, and the largest relative difference of their factors. The first twelve
    /// are, except those without an equilibrium.
    pub verified: (usize, f64),
    /// The inputs, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Mistuning {
    /// The factor that a share of the samples does not exceed.
    #[must_use]
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let last = self.sampled.len().checked_sub(1)?;
        let place = (share.clamp(0.0, 1.0) * last as f64).round();
        self.sampled.get(place as usize).copied()
    }

    /// `(1 + sqrt N)/2`.
    #[must_use]
    pub fn whitehead(&self) -> f64 {
        (1.0 + (self.blades as f64).sqrt()) / 2.0
    }
}

/// Number of samples that are also solved as a whole.
const VERIFIED: usize = 12;
/// Most modes of the model, or so many times the number of blades.
const MODES: usize = 40;

/// The amplification of an engine order at an equilibrium.
///
/// # Errors
/// [`Error::Setting`] if there is no such ring, coordinate or order, if its unknowns are not the coordinates of the blades, or
/// if nothing damps their vibration; those of [`equilibrium`] for equal blades.
pub fn mistuning(
    mechanism: &dyn DirectionalKernels,
    at: &Equilibrium,
    tolerances: &Tolerances,
    asked: EngineOrder,
    watch: Watch<'_>,
) -> Result<Mistuning, Error> {
    let description = &at.description;
    refuse(description, "mistuning")?;
    let ring = ring(description, asked)?;
    let slots = &ring.coordinates[asked.coordinate * ring.members..(asked.coordinate + 1) * ring.members];
    let alike = alike(ring, &at.design);
    let tuned_at = equilibrium(mechanism, &at.inputs, &alike, &at.coordinates, Policy::Nearest)?;
    let full = |linear: &Linear| highest(&Driven::new(linear, slots, asked.order));
    let tuned = full(&tuned_at.linear)?;
    let built = full(&at.linear)?;
    let by_design = match built.others {
        0 => Some(slopes(mechanism, [&tuned_at, at], [&tuned, &built], (ring, slots, asked.order))?),
        _ => None,
    };
    let mut found = Mistuning {
        ring: ring.name.clone(),
        blades: ring.members,
        order: asked.order,
        factor: built.amplitude / tuned.amplitude,
        by_design,
        sampled: Vector::default(),
        worst: vec![0; ring.members],
        verified: (0, 0.0),
        inputs: at.inputs.clone(),
        description: description.clone(),
        tuned,
        built,
    };
    if !tolerances.vary() {
        return Ok(found);
    }
    let model = Model::new(mechanism, at, found.tuned.frequency, ring.members)?;
    let mut draw = Draw::starting((asked.seed, 0), 0, &at.design, tolerances);
    let mut factors = Vec::new();
    for sample in 0..asked.samples {
        if watch.stopped() {
            return Err(Error::Stopped);
        }
        let design = draw.next_design();
        // What moves all blades alike is in both.
        let both = [design, &self::alike(ring, design)];
        let [peak, equal] = both.map(|design| highest(&model.driven(&at.design, design, slots, asked.order)));
        let (peak, equal) = (peak?, equal?);
        let factor = peak.amplitude / equal.amplitude;
        if sample < VERIFIED {
            let solved =
                both.map(|design| equilibrium(mechanism, &at.inputs, design, &at.coordinates, Policy::Nearest));
            if let [Ok(own), Ok(equal)] = &solved {
                let whole = full(&own.linear)?.amplitude / full(&equal.linear)?.amplitude;
                let (count, most) = found.verified;
                found.verified = (count + 1, most.max((factor / whole - 1.0).abs()));
            }
        }
        found.worst[peak.blade] += 1;
        factors.push(factor);
        watch.advance(1);
    }
    factors.sort_by(f64::total_cmp);
    found.sampled = factors.into();
    Ok(found)
}

fn ring(description: &Description, asked: EngineOrder) -> Result<&RingInfo, Error> {
    let refuse = |message: String| Err(Error::setting("engine order", message));
    let Some(ring) = description.rings.get(asked.ring) else {
        return refuse("no blades are declared with `cyclic`".to_owned());
    };
    if ring.patterns {
        let message = "on a support that is not symmetric, coordinates of single blades are no unknowns: mistuning takes blades \
                       on a hub that is driven or symmetric about the axis";
        return refuse(message.to_owned());
    }
    let coordinates = ring.coordinates.len() / ring.members;
    if asked.coordinate >= coordinates {
        return refuse(format!("each `{}` has {coordinates} coordinates", ring.name));
    }
    Ok(ring)
}

/// The design with the mean of the blades' variables in each of them.
fn alike(ring: &RingInfo, design: &[f64]) -> Vector {
    let mut alike = Vector::from(design.to_vec());
    for of in ring.design.chunks_exact(ring.members) {
        let mean = of.iter().map(|&k| design[k]).sum::<f64>() / of.len() as f64;
        of.iter().for_each(|&k| alike[k] = mean);
    }
    alike
}

/// Derivatives of the amplification factor. At a peak the frequency does not matter: `dX_k = -e_k^T D^-1 dD x`.
fn slopes(
    mechanism: &dyn DirectionalKernels,
    states: [&Equilibrium; 2],
    peaks: [&BladePeak; 2],
    (ring, slots, order): (&RingInfo, &[usize], usize),
) -> Result<Vector, Error> {
    let mut relative: Vec<Vec<f64>> = Vec::new();
    for (at, peak) in states.into_iter().zip(peaks) {
        let driven = Driven::new(&at.linear, slots, order);
        let z = Complex::new(0.0, peak.frequency);
        let factors = Lu::of(driven.stiffness(z)).ok_or_else(undamped)?;
        let x = factors.solve(&driven.force());
        let seen = Vector::from_fn(x.len(), |k| Complex::from(f64::from(u8::from(k == slots[peak.blade]))));
        let left = factors.solve_transposed(&seen);
        let value = x[slots[peak.blade]];
        let changes = directions(mechanism, at)?.skip(at.inputs.len()).map(|along| {
            let change = along.linear(mechanism, at);
            let dx = -Driven::new(&change, slots, order).form(z, &left, &x);
            (dx / value).re
        });
        relative.push(changes.collect());
    }
    let factor = peaks[1].amplitude / peaks[0].amplitude;
    // A blade moves the mean of all by its part.
    let mut tuned = relative[0].clone();
    for of in ring.design.chunks_exact(ring.members) {
        let mean = of.iter().map(|&k| relative[0][k]).sum::<f64>() / of.len() as f64;
        of.iter().for_each(|&k| tuned[k] = mean);
    }
    Ok(relative[1].iter().zip(&tuned).map(|(built, tuned)| factor * (built - tuned)).collect())
}

/// Matrices that are linear in the design, in the modes nearest to a frequency.
struct Model {
    basis: Matrix,
    nominal: Linear,
    by_design: Vec<(usize, Linear)>,
}

impl Model {
    fn new(mechanism: &dyn DirectionalKernels, at: &Equilibrium, frequency: f64, blades: usize) -> Result<Self, Error> {
        let n = at.linear.mass.row_count();
        let basis =
            if n <= MODES { identity(n) } else { nearest(&at.linear, frequency, MODES.max(2 * blades).min(n))? };
        let reduced = |linear: &Linear| Linear {
            mass: projected(&basis, &linear.mass),
            damping: projected(&basis, &linear.damping),
            stiffness: projected(&basis, &linear.stiffness),
        };
        let along = directions(mechanism, at)?.skip(at.inputs.len()).enumerate();
        let by_design = along.map(|(k, along)| (k, reduced(&along.linear(mechanism, at)))).collect();
        let nominal = reduced(&at.linear);
        Ok(Self { nominal, by_design, basis })
    }

    /// The blades of a design.
    fn driven(&self, nominal: &[f64], design: &[f64], slots: &[usize], order: usize) -> Driven {
        let mut linear = self.nominal.clone();
        for (k, change) in &self.by_design {
            let deviation = design[*k] - nominal[*k];
            if deviation == 0.0 {
                continue;
            }
            for (all, change) in [
                (&mut linear.mass, &change.mass),
                (&mut linear.damping, &change.damping),
                (&mut linear.stiffness, &change.stiffness),
            ] {
                for (entry, change) in all.as_flattened_mut().iter_mut().zip(change.as_flattened()) {
                    *entry += deviation * change;
                }
            }
        }
        Driven::in_basis(linear, &self.basis, slots, order)
    }
}

fn identity(n: usize) -> Matrix {
    Matrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { 0.0 })
}

/// One row for each of the undamped modes nearest to a frequency.
fn nearest(linear: &Linear, frequency: f64, count: usize) -> Result<Matrix, Error> {
    let n = linear.mass.row_count();
    let stiffness = Matrix::from_fn(n, n, |i, j| 0.5 * (linear.stiffness[i][j] + linear.stiffness[j][i]));
    let mut pairs = Pairs::default();
    symmetric::solve_into(&stiffness, &linear.mass, &mut pairs)
        .map_err(|_| Error::ModesNotFound { mode: 0, residual: 1.0 })?;
    let mut order: Vec<usize> = (0..n).collect();
    let distance = |r: &usize| (pairs.lambda[*r].max(0.0).sqrt() / frequency).ln().abs();
    order.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    Ok(Matrix::from_fn(count, n, |i, j| pairs.shapes[order[i]][j]))
}

/// `B A B^T`.
fn projected(basis: &Matrix, matrix: &Matrix) -> Matrix {
    let (m, n) = (basis.row_count(), matrix.row_count());
    let half = Matrix::from_fn(n, m, |i, r| (0..n).map(|j| matrix[i][j] * basis[r][j]).sum::<f64>());
    Matrix::from_fn(m, m, |r, s| (0..n).map(|i| basis[r][i] * half[i][s]).sum())
}
