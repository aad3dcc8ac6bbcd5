use eigentol::campbell::{Campbell, CampbellMode};
use eigentol::tolerance::Spread;

use super::Tables;
use super::events::events;
use super::modes::sense;
use super::names::{behaviour, operating_point, varied};
use crate::Table;

/// `Campbell diagram`: a row for each mode at each value of the input, one without a mode where there are none; then `crossings`, `critical states` and
/// `flutter onsets`, where there are any.
impl Tables for Campbell {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let mut values = Vec::new();
        let mut modes: Vec<Option<&CampbellMode>> = Vec::new();
        let mut errors = Vec::new();
        for point in &self.points {
            match &point.modes {
                Ok(own) => modes.extend(own.iter().map(Some)),
                Err(_) => modes.push(None),
            }
            values.resize(modes.len(), point.value);
            let error = point.modes.as_ref().err().map(ToString::to_string);
            errors.resize(modes.len(), error);
        }
        let mut table = Table::new("Campbell diagram");
        varied(&mut table, d, self.input, values.into_iter());
        let each = modes.iter().copied();
        table.whole("mode", each.clone().map(|mode| Some(mode?.label + 1)));
        table.numbers(
            "frequency",
            "rad/s",
            each.clone().map(|mode| mode?.behaviour.frequency()),
        );
        let sigma = |mode: &CampbellMode, own: &Option<Spread>| {
            own.as_ref()
                .filter(|_| !mode.clustered)
                .map(|own| own.sigma)
        };
        let own = each.clone().map(|mode| sigma(mode?, &mode?.frequency));
        table.numbers("sigma of frequency", "rad/s", own);
        let own = each
            .clone()
            .map(|mode| Some(mode?.damping_ratio.as_ref()?.mean));
        table.numbers("damping ratio", "", own);
        let own = each.clone().map(|mode| sigma(mode?, &mode?.damping_ratio));
        table.numbers("sigma of damping ratio", "", own);
        table.numbers("Re s", "1/s", each.clone().map(|mode| Some(mode?.s.re)));
        table.numbers("Im s", "1/s", each.clone().map(|mode| Some(mode?.s.im)));
        table.texts(
            "whirl",
            each.clone().map(|mode| mode?.whirl.and_then(sense)),
        );
        let ratio = each.clone().map(|mode| Some(mode?.whirl?.ratio));
        table.numbers("whirl ratio", "", ratio);
        table.texts(
            "motion",
            each.clone().map(|mode| behaviour(mode?.behaviour)),
        );
        table.flags("cluster", each.map(|mode| Some(mode?.clustered)));
        table.texts("error", errors);
        operating_point(&mut table, d, &self.inputs, Some(self.input));
        let mut tables = vec![table];
        tables.extend(events("crossings", &self.crossings));
        tables.extend(events("critical states", &self.critical));
        tables.extend(events("flutter onsets", &self.flutter_onsets));
        tables
    }
}
