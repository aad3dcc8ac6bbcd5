//! Names and units of responses.

use super::events::meeting;
use crate::response::Response;
use crate::sweep::{Change, Condition};
use crate::{Description, Quantity, Unit};

impl Response {
    /// Its name in texts and tables, for example `frequency 1` or `critical speed`.
    ///
    /// An output has its declared name, a crossing one such as `speed where frequency 2 is 1 times speed`. `of`
    /// describes the mechanism.
    #[must_use]
    pub fn name(&self, of: &Description) -> String {
        let input = |range: &crate::sweep::Range| {
            let info = of.inputs.get(range.input.index());
            info.map_or("?", |info| &*info.name)
        };
        match self {
            Self::Mode { mode, quantity } => format!("{quantity} {}", mode + 1),
            Self::Output(output) => {
                let info = of.outputs.get(output.index());
                info.map_or("?", |info| &*info.name).to_owned()
            }
            Self::Critical(range) => format!("critical {}", input(range)),
            Self::Crossing {
                mode,
                condition,
                range,
            } => {
                let name = input(range);
                let link = match condition {
                    Condition::Line(_) => "where",
                    Condition::FlutterOnset => "at the",
                };
                format!(
                    "{name} {link} {}",
                    meeting(*mode, *condition, Change::Onset, name)
                )
            }
        }
    }

    /// The unit of its values in texts and tables: as declared, or that of the quantity of a mode.
    #[must_use]
    pub fn unit(&self, of: &Description) -> Unit {
        let declared = match self {
            Self::Mode { quantity, .. } => return quantity.unit(),
            Self::Output(output) => of.outputs.get(output.index()).map(|info| &info.unit),
            Self::Critical(range) | Self::Crossing { range, .. } => {
                of.inputs.get(range.input.index()).map(|info| &info.unit)
            }
        };
        declared
            .cloned()
            .unwrap_or_else(|| Quantity::DampingRatio.unit())
    }
}
