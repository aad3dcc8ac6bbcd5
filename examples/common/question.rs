//! What is asked of a mechanism: which input is swept, what varies, and by how much.

use eigentol::{DesignVariable, Error, Input, Tolerances};

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
    /// The tolerances of one level about the design `nominal`.
    ///
    /// # Errors
    /// Those of [`Tolerances::new`].
    pub fn tolerances<const P: usize>(
        &self,
        nominal: &[f64; P],
        level: f64,
    ) -> Result<Tolerances<P>, Error> {
        let half_widths = core::array::from_fn(|j| {
            if self.varied.contains(&DesignVariable(j)) {
                level * nominal[j].abs()
            } else {
                0.0
            }
        });
        Tolerances::new(half_widths, 3.0, None)
    }
}

/// A tolerance in percent, as in names of columns and in legends.
pub fn percent(level: f64) -> String {
    format!("{}", (1e6 * level).round() / 1e4)
}
