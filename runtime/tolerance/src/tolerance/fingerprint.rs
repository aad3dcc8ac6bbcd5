//! Identifies what samples were drawn from and how: parts of a run merge only if all of it agrees.

use core::fmt;

use super::Tolerances;
use crate::kernels::{Kernels, Linear};
use crate::modes::Family;
use crate::{Description, Equilibrium, Error, Modes};

/// Identifies a run of samples, as named facts. Samples of runs with equal fingerprints belong together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fingerprint(Vec<(String, String)>);

impl Fingerprint {
    /// The fingerprint of the state that samples are drawn about.
    #[doc(hidden)]
    pub fn new(mechanism: &dyn Kernels, at: &Equilibrium, modes: &Modes, tolerances: &Tolerances) -> Self {
        let description = &at.description;
        let mut all = Self(Vec::new());
        all.add("mechanism", &*description.name);
        all.add("kernels", probes(mechanism, description));
        for (info, value) in description.inputs.iter().zip(&at.inputs) {
            all.add(format!("input `{}`", info.name), value);
        }
        for (info, value) in description.design.iter().zip(&at.design) {
            all.add(format!("design variable `{}`", info.name), value);
        }
        for (i, info) in description.design.iter().enumerate() {
            let (sigma, shift) = (tolerances.sigmas().get(i), tolerances.shifts().get(i));
            let law = (tolerances.joint()).and_then(|(joint, _)| joint.variables().get(i));
            let law = law.map_or("normal".to_owned(), |law| Digest::of_text(&format!("{law:?}")));
            let value = format!("{sigma:?} {shift:?} {law}").replace("Some", "");
            all.add(format!("tolerance of `{}`", info.name), value);
        }
        let correlation = tolerances.correlation();
        let correlation = correlation.map(|matrix| Digest::of_numbers(matrix.as_flattened()));
        all.add("correlation", correlation.as_deref().unwrap_or("none"));
        all.add("equilibrium", Digest::of_numbers(&at.coordinates));
        let family = match modes.family {
            Family::Undamped => "undamped",
            Family::General => "general",
        };
        let parts = modes.modes.iter().flat_map(|mode| [mode.s.re, mode.s.im]);
        let parts: Vec<f64> = parts.collect();
        let (count, digest) = (modes.modes.len(), Digest::of_numbers(&parts));
        all.add("nominal modes", format!("{count} {family}, {digest}"));
        all
    }

    /// Adds a fact.
    #[doc(hidden)]
    pub fn with(mut self, name: impl fmt::Display, value: impl fmt::Display) -> Self {
        self.add(name, value);
        self
    }

    fn add(&mut self, name: impl fmt::Display, value: impl fmt::Display) {
        self.0.push((name.to_string(), value.to_string()));
    }

    /// The facts, as names and values.
    pub fn facts(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().map(|(name, value)| (&**name, &**value))
    }

    /// The value of a fact that is an integer.
    pub(crate) fn number(&self, name: &str) -> Option<u64> {
        let (_, value) = self.facts().find(|(x, _)| *x == name)?;
        value.parse().ok()
    }

    /// Refuses the fingerprint of another run.
    pub(crate) fn check(&self, other: &Self) -> Result<(), Error> {
        let value_of = |all: &Self, name: &str| {
            all.facts().find(|(x, _)| *x == name).map_or("not there".to_owned(), |(_, value)| value.to_owned())
        };
        for name in self.facts().chain(other.facts()).map(|(name, _)| name) {
            let (own, other) = (value_of(self, name), value_of(other, name));
            if own != other {
                return Err(Error::OtherRun { what: name.to_owned(), own, other });
            }
        }
        Ok(())
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, value) in self.facts() {
            writeln!(f, "{name}: {value}")?;
        }
        Ok(())
    }
}

/// Points at which kernels are evaluated: steps from one value to the next, in SI units and as a share of nominal
/// values.
const PROBES: [f64; 3] = [0.01, -0.03, 0.07];

/// A digest of kernel results at fixed states, the same for every study, which identifies the kernels.
fn probes(mechanism: &dyn Kernels, description: &Description) -> String {
    let sizes = mechanism.sizes();
    let mut digest = Digest::default();
    for step in PROBES {
        let value = |k: usize| 0.2 + step * (k + 1) as f64;
        let q: Vec<f64> = (0..sizes.coordinates).map(value).collect();
        let u: Vec<f64> = (0..sizes.inputs).map(value).collect();
        let nominal = description.design.iter().map(|info| info.nominal);
        let b: Vec<f64> = nominal.map(|value| value * (1.0 + step)).collect();
        let (residual, _) = mechanism.residual_and_stiffness(&q, &u, &b);
        let linear: Linear = mechanism.linear(&q, &u, &b);
        digest.numbers(&residual);
        for matrix in [&linear.mass, &linear.damping, &linear.stiffness] {
            digest.numbers(matrix.as_flattened());
        }
        digest.numbers(&mechanism.outputs(&q, &u, &b));
    }
    digest.to_string()
}

/// The hash of Fowler, Noll and Vo (FNV-1a, 64 bits), the same on every machine.
struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Digest {
    fn of_numbers(numbers: &[f64]) -> String {
        let mut digest = Self::default();
        digest.numbers(numbers);
        digest.to_string()
    }

    fn of_text(text: &str) -> String {
        let mut digest = Self::default();
        digest.bytes(text.as_bytes());
        digest.to_string()
    }

    fn numbers(&mut self, numbers: &[f64]) {
        for number in numbers {
            // Processors differ in the bits of NaN, and both zeros are equal.
            let number = if number.is_nan() { f64::NAN } else { number + 0.0 };
            self.bytes(&number.to_bits().to_le_bytes());
        }
    }

    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digests_are_those_of_the_reference() {
        assert_eq!(Digest::of_text(""), "cbf29ce484222325");
        assert_eq!(Digest::of_text("foobar"), "85944171f73967e8");
        assert_eq!(Digest::of_numbers(&[0.0]), Digest::of_numbers(&[-0.0]));
        assert_ne!(Digest::of_numbers(&[1.0]), Digest::of_numbers(&[-1.0]));
    }

    #[test]
    fn the_first_difference_is_named() {
        let one = Fingerprint(Vec::new()).with("seed", 3).with("stream", 1);
        assert_eq!(one.check(&one.clone()), Ok(()));
        let other = Fingerprint(Vec::new()).with("seed", 3).with("stream", 2);
        let difference = one.check(&other).map_err(|error| error.to_string());
        assert!(difference.is_err_and(|text| text.contains("stream is 1 here and 2 there")));
        let longer = one.clone().with("points", "Sobol");
        assert!(one.check(&longer).is_err() && longer.check(&one).is_err());
    }
}
