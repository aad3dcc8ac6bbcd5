//! What several results have in common.

use pyo3::prelude::*;

use crate::clusters::{Clusters, DirectionalDerivatives};
use crate::events::Event;
use crate::hints;
use crate::requirements::Chances;
use crate::results::{
    Bode, Branch, Branches, Campbell, EventCurvature, ForcedCurvature, ModeCurvature, Modes, OutputCurvature,
    Sensitivities, Sweep, attributes, family,
};
use crate::spreads::{FirstOrder, Influence, MonteCarlo, OutputTolerances, Propagation, SecondOrder, counts};

attributes! {
    Campbell, DirectionalDerivatives, Event, FirstOrder, Modes, MonteCarlo, Sensitivities(self, py) {
        /// "undamped" or "general".
        family: &'static hints::Family = family(self.0.family);
    }
}

attributes! {
    Campbell, Event, FirstOrder, OutputTolerances, SecondOrder(self, py) {
        /// Standard deviations that a tolerance and a band stand for.
        sigma_level: f64 = self.0.sigma_level;
    }
}

attributes! {
    Chances, FirstOrder, MonteCarlo, OutputTolerances, SecondOrder(self, py) {
        /// Whether any variable has a tolerance.
        varies: bool = self.0.varies;
    }
}

attributes! {
    Chances, Influence, MonteCarlo, Propagation(self, py) {
        /// How many designs became what, by name.
        counts: PyResult<hints::Counts<'py>> = counts(py, &self.0.counts);
    }
}

attributes! {
    Bode, Branch, Campbell, Event, EventCurvature, Sweep(self, py) {
        /// Name of the input.
        input: String = self.0.description.inputs[self.0.input.index()].name.to_string();
    }
}

attributes! {
    EventCurvature, ForcedCurvature, ModeCurvature, OutputCurvature(self, py) {
        /// Greatest difference of mirrored second derivatives, relative to the greatest: exact arithmetic would give
        /// zero.
        asymmetry: f64 = self.0.asymmetry;
    }
}

/// Results of which Python takes the length.
macro_rules! lengths {
    ($($class:ident: |$own:ident| $list:expr;)+) => {
        $(
            #[pymethods]
            impl $class {
                fn __len__(&self) -> usize {
                    let $own = &self.0;
                    $list.len()
                }
            }
        )+
    };
}

lengths! {
    Bode: |bode| bode.points;
    Branch: |branch| branch.points;
    Branches: |branches| branches.branches;
    Campbell: |campbell| campbell.points;
    Clusters: |clusters| clusters;
    Modes: |modes| modes.modes;
    Sweep: |sweep| sweep.points;
}
