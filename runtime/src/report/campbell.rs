//! Campbell diagrams as text.

use core::fmt;

use super::table::{Table, cells, heading, in_unit, number, of_mode, optional, undamped};
use super::title::title_along;
use crate::campbell::Campbell;

impl fmt::Display for Campbell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title_along(d, &self.inputs, self.input);
        writeln!(f, "{title}: Campbell diagram")?;
        let Some(info) = d.inputs.get(self.input.index()) else {
            return Ok(());
        };
        let mut head = vec![heading(&info.name, &info.unit)];
        head.extend(cells([
            "mode",
            "omega [rad/s]",
            "sigma",
            "damping ratio",
            "sigma",
            "whirl",
            "motion",
        ]));
        let mut table = Table::new(head);
        for point in &self.points {
            let value = in_unit(point.value, &info.unit);
            let modes = match &point.modes {
                Ok(modes) => modes,
                Err(error) => {
                    table.row(vec![value, error.to_string()]);
                    continue;
                }
            };
            for mode in modes {
                let own = |exists: bool, text: String| if exists { text } else { "-".to_owned() };
                let oscillates = mode.behaviour.frequency().is_some();
                let sigma = |spread: Option<f64>| of_mode(spread, mode.clustered);
                table.row(vec![
                    value.clone(),
                    (mode.label + 1).to_string(),
                    own(oscillates, number(mode.s.im)),
                    sigma(mode.frequency.as_ref().map(|spread| spread.sigma)),
                    optional(mode.damping_ratio.as_ref().map(|spread| spread.mean)),
                    sigma(mode.damping_ratio.as_ref().map(|spread| spread.sigma)),
                    mode.whirl.map_or("-".to_owned(), |whirl| whirl.to_string()),
                    mode.behaviour.to_string(),
                ]);
            }
        }
        write!(f, "{table}")?;
        undamped(f, self.family, d)?;
        let events = self.crossings.iter().chain(&self.critical);
        for event in events.chain(&self.flutter_onsets) {
            write!(f, "{event}")?;
        }
        Ok(())
    }
}
