//! The results that a document can hold.

use eigentol::allocation::Allocation;
use eigentol::branches::{Branch, Branches};
use eigentol::campbell::Campbell;
use eigentol::clusters::{ClusterTolerance, DirectionalDerivatives};
use eigentol::equilibrium::{Assembly, Equilibria};
use eigentol::modes::Whirl;
use eigentol::propagation::{Controlled, Influence, Propagation, WorstCase};
use eigentol::requirement::{Chances, Probabilities, RareFailure, Reliability};
use eigentol::second_order::{
    EventCurvature, ModeCurvature, ModeMargin, OutputCurvature, SecondOrder,
};
use eigentol::sensitivity::{EquilibriumShift, OutputSensitivities};
use eigentol::shapes::ShapeSensitivity;
use eigentol::summary::Summary;
use eigentol::sweep::{CriticalState, Crossing, EventTolerance, Sweep};
use eigentol::tolerance::OutputTolerances;
use eigentol::{
    Description, Equilibrium, FirstOrder, Input, Modes, MonteCarlo, Sensitivities, Shared,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Tables;

/// A result that a document can hold.
pub trait Answer: Tables + Serialize + DeserializeOwned {
    /// The kind of result, as named in documents.
    const KIND: &'static str;

    /// The mechanism and operating point the result belongs to; `None` for an empty list.
    fn subject(&self) -> Option<Subject<'_>>;
}

/// The mechanism and the operating point that a result belongs to.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The mechanism.
    pub description: &'a Shared<Description>,
    /// Its inputs, SI; empty if the result does not record them.
    pub inputs: &'a [f64],
    /// The input that varies.
    pub varied: Option<Input>,
}

impl<'a> Subject<'a> {
    fn new(description: &'a Shared<Description>, inputs: &'a [f64], varied: Option<Input>) -> Self {
        Self {
            description,
            inputs,
            varied,
        }
    }
}

macro_rules! at_one_point {
    ($($kind:literal: $result:ty;)+) => {
        $(
            impl Answer for $result {
                const KIND: &'static str = $kind;

                fn subject(&self) -> Option<Subject<'_>> {
                    Some(Subject::new(&self.description, &self.inputs, None))
                }
            }
        )+
    };
}

at_one_point! {
    "allocation": Allocation;
    "assembly": Assembly;
    "chances": Chances;
    "controlled spreads": Controlled;
    "directional derivatives": DirectionalDerivatives;
    "equilibria": Equilibria;
    "equilibrium": Equilibrium;
    "equilibrium shift": EquilibriumShift;
    "first-order tolerances": FirstOrder;
    "influence": Influence;
    "margin": ModeMargin;
    "modes": Modes;
    "Monte Carlo": MonteCarlo;
    "output sensitivities": OutputSensitivities;
    "output tolerances": OutputTolerances;
    "probabilities of failure": Probabilities;
    "rare failure": RareFailure;
    "reliability": Reliability;
    "second-order tolerances": SecondOrder;
    "sensitivities": Sensitivities;
    "spreads": Propagation;
    "summary": Summary;
    "worst case": WorstCase;
}

macro_rules! at_no_point {
    ($($kind:literal: $result:ty;)+) => {
        $(
            impl Answer for $result {
                const KIND: &'static str = $kind;

                fn subject(&self) -> Option<Subject<'_>> {
                    Some(Subject::new(&self.description, &[], None))
                }
            }
        )+
    };
}

at_no_point! {
    "second derivatives": ModeCurvature;
    "second derivatives of an event": EventCurvature;
    "second derivatives of an output": OutputCurvature;
    "shape sensitivities": ShapeSensitivity;
}

macro_rules! along_an_input {
    ($($kind:literal: $result:ty;)+) => {
        $(
            impl Answer for $result {
                const KIND: &'static str = $kind;

                fn subject(&self) -> Option<Subject<'_>> {
                    Some(Subject::new(&self.description, &self.inputs, Some(self.input)))
                }
            }
        )+
    };
}

along_an_input! {
    "Campbell diagram": Campbell;
    "event": EventTolerance;
    "sweep": Sweep;
}

macro_rules! at_an_equilibrium {
    ($($kind:literal: $result:ty;)+) => {
        $(
            impl Answer for $result {
                const KIND: &'static str = $kind;

                fn subject(&self) -> Option<Subject<'_>> {
                    let at = &self.equilibrium;
                    Some(Subject::new(&at.description, &at.inputs, Some(self.input)))
                }
            }
        )+
    };
}

at_an_equilibrium! {
    "critical state": CriticalState;
    "crossing": Crossing;
}

impl Answer for Branch {
    const KIND: &'static str = "branch";

    fn subject(&self) -> Option<Subject<'_>> {
        let at = self.points.first().map(|own| &own.equilibrium.inputs[..]);
        Some(Subject::new(
            &self.description,
            at.unwrap_or_default(),
            Some(self.input),
        ))
    }
}

impl Answer for Branches {
    const KIND: &'static str = "branches";

    fn subject(&self) -> Option<Subject<'_>> {
        self.branches.first()?.subject()
    }
}

macro_rules! lists {
    ($($kind:literal: $one:ty;)+) => {
        $(
            impl Tables for Vec<$one> {
                fn tables(&self) -> Vec<crate::Table> {
                    self[..].tables()
                }
            }

            impl Answer for Vec<$one> {
                const KIND: &'static str = $kind;

                fn subject(&self) -> Option<Subject<'_>> {
                    self.first()?.subject()
                }
            }
        )+
    };
}

lists! {
    "critical states": CriticalState;
    "crossings": Crossing;
    "events": EventTolerance;
}

impl Tables for Vec<Option<Whirl>> {
    fn tables(&self) -> Vec<crate::Table> {
        self[..].tables()
    }
}

/// The whirl of each mode. It does not record the mechanism; the modes do.
impl Answer for Vec<Option<Whirl>> {
    const KIND: &'static str = "whirls";

    fn subject(&self) -> Option<Subject<'_>> {
        None
    }
}

impl Tables for Vec<ClusterTolerance> {
    fn tables(&self) -> Vec<crate::Table> {
        self[..].tables()
    }
}

impl Answer for Vec<ClusterTolerance> {
    const KIND: &'static str = "clusters";

    fn subject(&self) -> Option<Subject<'_>> {
        let one = self.first()?;
        Some(Subject::new(&one.description, &one.inputs, None))
    }
}
