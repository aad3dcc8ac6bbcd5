//! The question asked of a mechanism: which input is swept, what varies, and by how much.

use eigentol::{DesignVariable, Input, Mechanism, Study};

/// A sweep of one input under tolerances of some design variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// The driven speed, rad/s.
    pub speed: Input,
    /// Lowest and highest speed, rad/s.
    pub range: (f64, f64),
    /// The design variables that vary, independently of each other.
    pub varied: Vec<DesignVariable>,
    /// Tolerances: half-widths relative to the nominal values, three standard deviations each.
    pub levels: Vec<f64>,
}

impl Question {
    /// The study with this tolerance level on the varied design variables only.
    pub fn varied_by<M: Mechanism>(&self, study: &Study<M>, level: f64) -> Study<M> {
        (0..study.design_values().len())
            .map(DesignVariable::new)
            .fold(study.clone(), |study, variable| {
                let varies = self.varied.contains(&variable.any());
                study.relative_tolerance(variable, if varies { level } else { 0.0 })
            })
    }

    /// The driven speed as an input of the mechanism.
    pub fn input<M>(&self) -> Input<M> {
        Input::new(self.speed.index())
    }
}

/// A tolerance in percent, as used in column names and legends.
pub fn percent(level: f64) -> String {
    format!("{}", (1e6 * level).round() / 1e4)
}
