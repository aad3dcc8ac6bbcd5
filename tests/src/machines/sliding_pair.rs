//! Two sliders that drift as one body once their anchor spring is removed.
//!
//! The frequencies `w` satisfy `m1 m2 w^4 - (m1 kc + m2 (ka + kc)) w^2 + ka kc = 0`. With `ka = 0` they are
//! `sqrt(kc (m1 + m2) / (m1 m2))` and 0, the latter belonging to a rigid-body motion whose eigenvalue `s = 0` is double
//! and defective.

use crate::corpus::machine;

machine! {
    /// A slider on an anchor spring that may be removed, and a second one coupled to it.
    pub mechanism SlidingPair {
        design m1 = 2 kg +/- 1%;
        design m2 = 3 kg +/- 1%;
        design anchor = 10 N/m;
        design coupling = 400 N/m +/- 2%;
        body first: point(mass: m1);
        body second: point(mass: m2);
        joint slide: prismatic(x) from ground to first;
        joint stretch: prismatic(x) from first to second;
        force hold: spring(on: slide, stiffness: anchor);
        force couple: spring(on: stretch, stiffness: coupling, rest: 50 mm);
    }
}
