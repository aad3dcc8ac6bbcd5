//! Vector instructions of the processor, detected at run time.

use super::lanes::Task;
#[cfg(target_arch = "x86_64")]
use super::x86::{Avx2, Avx512};

/// A set of vector instructions that this processor supports.
///
/// Results do not depend on the choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instructions(Set);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Set {
    Scalar,
    #[cfg(target_arch = "x86_64")]
    Four(Avx2),
    #[cfg(target_arch = "x86_64")]
    Eight(Avx512),
}

impl Instructions {
    /// No vectors: one state at a time.
    pub const SCALAR: Self = Self(Set::Scalar);

    /// The widest vectors of this processor.
    #[must_use]
    #[inline]
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(set) = Avx512::detect() {
                return Self(Set::Eight(set));
            }
            if let Some(set) = Avx2::detect() {
                return Self(Set::Four(set));
            }
        }
        Self::SCALAR
    }

    /// All sets that this processor supports, the narrowest first.
    pub fn available() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let vectors = [Avx2::detect().map(Set::Four), Avx512::detect().map(Set::Eight)];
        #[cfg(not(target_arch = "x86_64"))]
        let vectors: [Option<Set>; 0] = [];
        let vectors = vectors.into_iter().flatten().map(Self);
        core::iter::once(Self::SCALAR).chain(vectors)
    }

    /// Runs a task with vectors of this kind.
    #[inline]
    pub fn run<T: Task>(self, task: T) -> T::Output {
        match self.0 {
            Set::Scalar => task.run::<f64>(),
            #[cfg(target_arch = "x86_64")]
            Set::Four(set) => set.run(task),
            #[cfg(target_arch = "x86_64")]
            Set::Eight(set) => set.run(task),
        }
    }
}
