use eigentol::modes::Whirl;
use eigentol::{Complex, Mode, Modes, Role};

use super::Tables;
use super::names::{behaviour, operating_point, word};
use crate::Table;

/// `modes`: a row for each mode; its shape takes two columns per coordinate and speed, real and imaginary part.
impl Tables for Modes {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let modes = self.modes.iter();
        let mut table = Table::new("modes");
        table.whole("mode", modes.clone().map(|mode| mode.label + 1));
        table.numbers("frequency", "rad/s", modes.clone().map(Mode::frequency));
        let natural = modes.clone().map(Mode::natural_frequency);
        table.numbers("natural frequency", "rad/s", natural);
        let damping = modes.clone().map(Mode::damping_ratio);
        table.numbers("damping ratio", "", damping);
        table.numbers("Re s", "1/s", modes.clone().map(|mode| mode.s.re));
        table.numbers("Im s", "1/s", modes.clone().map(|mode| mode.s.im));
        table.numbers("lambda", "1/s^2", modes.clone().map(|mode| mode.lambda));
        table.numbers("error of s", "1/s", modes.clone().map(|mode| mode.error));
        table.texts(
            "motion",
            modes.clone().map(|mode| behaviour(mode.behaviour)),
        );
        for (i, info) in d.coordinates.iter().enumerate() {
            if !matches!(info.role, Role::Position | Role::Speed) {
                continue;
            }
            let part = |of: fn(Complex) -> f64| {
                let entry = move |mode: &Mode| mode.shape.get(i).map(|value| of(*value));
                modes.clone().map(entry)
            };
            table.numbers(
                format!("Re shape {}", info.name),
                "",
                part(|value| value.re),
            );
            table.numbers(
                format!("Im shape {}", info.name),
                "",
                part(|value| value.im),
            );
        }
        operating_point(&mut table, d, &self.inputs, None);
        vec![table]
    }
}

/// `whirls`: a row for each mode.
impl Tables for [Option<Whirl>] {
    fn tables(&self) -> Vec<Table> {
        let mut table = Table::new("whirls");
        table.whole("mode", 1..=self.len());
        table.texts("sense", self.iter().map(|own| own.and_then(sense)));
        let ratio = self.iter().map(|own| own.map(|whirl| whirl.ratio));
        table.numbers("ratio", "", ratio);
        vec![table]
    }
}

pub(super) fn sense(whirl: Whirl) -> Option<String> {
    word(&whirl.sense().to_string())
}
