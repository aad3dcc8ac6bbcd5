//! Equilibria and events as text.

use core::fmt;

use super::branches::critical_vectors;
use super::table::{Table, cells, heading, in_unit, number};
use crate::equilibrium::{CriticalState, Crossing, Doubt};
use crate::{Equilibrium, Stability};

impl fmt::Display for Stability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stable => write!(f, "stable"),
            Self::Neutral { zero } => write!(f, "neutral ({zero} free directions)"),
            Self::Divergent { negative } => match negative {
                1 => write!(f, "divergent (unstable in one direction)"),
                _ => write!(f, "divergent (unstable in {negative} directions)"),
            },
            Self::Unverified(doubt) => write!(f, "not decided: {doubt}"),
        }
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NonsymmetricStiffness => write!(f, "the stiffness is not symmetric"),
            Self::GyroscopicStabilisation { negative } => {
                write!(
                    f,
                    "{negative} directions without stiffness may be held by gyroscopic forces"
                )
            }
            Self::NegativeDamping => write!(f, "the damping feeds in energy"),
        }
    }
}

impl<const N: usize, const U: usize, const P: usize> fmt::Display for Equilibrium<N, U, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = self.description;
        write!(f, "{}: equilibrium, {}", d.name, self.stability)?;
        for (info, &value) in d.inputs.iter().zip(&self.inputs) {
            let unit = info.unit;
            write!(
                f,
                ", {} = {} {}",
                info.name,
                in_unit(value, unit),
                unit.symbol
            )?;
        }
        writeln!(f)?;
        let mut table = Table::new(cells(["coordinate", "value", "residual"]));
        for ((info, &value), &residual) in d
            .coordinates
            .iter()
            .zip(&self.coordinates)
            .zip(&self.residual)
        {
            table.row(vec![
                heading(info.name, info.unit),
                in_unit(value, info.unit),
                number(residual),
            ]);
        }
        write!(f, "{table}")?;
        writeln!(
            f,
            "  relative residual {:.1e} after {} iterations",
            self.relative_residual, self.iterations
        )?;
        match self.pose {
            Some(pose) if pose.margin < NEAR_SINGULAR => writeln!(
                f,
                "  {} is near its singular pose (margin {:.1e}): its coordinates are badly conditioned",
                pose.joint, pose.margin
            ),
            _ => Ok(()),
        }
    }
}

/// Pose margin below which a report warns.
const NEAR_SINGULAR: f64 = 0.1;

impl<const N: usize, const U: usize, const P: usize> fmt::Display for CriticalState<N, U, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = self.equilibrium.description;
        if let Some(info) = d.inputs.get(self.input.0) {
            let value = in_unit(self.value, info.unit);
            writeln!(
                f,
                "{}: critical at {} = {value} {}, {}",
                d.name, info.name, info.unit.symbol, self.kind
            )?;
        }
        write!(f, "{}", self.equilibrium)?;
        critical_vectors(f, d, &self.v, &self.w)
    }
}

impl<const N: usize, const U: usize, const P: usize> fmt::Display for Crossing<N, U, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = self.equilibrium.description;
        if let Some(info) = d.inputs.get(self.input.0) {
            let value = in_unit(self.value, info.unit);
            writeln!(
                f,
                "{}: frequency {} is {} times {} at {value} {}",
                d.name,
                self.mode + 1,
                self.ratio,
                info.name,
                info.unit.symbol
            )?;
        }
        write!(f, "{}{}", self.equilibrium, self.modes)
    }
}
