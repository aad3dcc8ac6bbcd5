//! Tolerances of every kind, compiled by the macro and kept as text.

use crate::corpus::machine;

machine! {
    /// A carriage on a turntable, as a drawing gives it.
    pub mechanism Fits {
        /// Speed of the table.
        input omega: rpm +/- 1%;
        input push: N +0.5 -0 N uniform;
        input supply: 1;
        design mass = 2 kg +2 -1 % lognormal;
        design stiffness = 900 N/m +/- 7% weibull;
        design rest = 250 mm +0.1 mm -0.05 mm;
        design bore = 20 mm +0.021 0 mm triangular;
        design pin = 20 mm -0.020 -0.041 mm beta(2, 7 / 2);
        design seat = -10 mm +/- 0.2 mm;
        design reach = 0.4 m +/- 2 mm truncated normal;
        design shim = 2 mm one of [1.9, 2.0, 2.3] mm weighted [1, 6, 1];
        body table: massless;
        body carriage: point(mass: mass);
        joint spin: revolute(z) from ground to table, driven at omega * supply;
        joint slide: prismatic(x) from table to carriage at [reach + seat, 0, 0];
        force coil: spring(on: slide, stiffness: stiffness, rest: rest);
        force piston: generalized(on: slide, value: push);
        output clearance = bore - pin - shim;
    }
}
