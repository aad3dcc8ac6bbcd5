use eigentol::campbell::{Campbell, CampbellMode, CampbellPoint};
use eigentol::tolerance::Spread;
use eigentol::{Description, Input};

use super::Tables;
use super::events::events;
use super::modes::sense;
use super::names::{behaviour, operating_point, varied};
use crate::Table;

/// A row for each mode at each value of the input, or one row without a mode if there are none.
///
/// Parts of a diagram can be written one after the other: all have the same columns.
///
/// ```
/// # use eigentol::{Study, mechanism};
/// # mechanism! {
/// #     mechanism Pendulum {
/// #         input  omega: rad/s;
/// #         design l = 2 m +/- 1 %;
/// #         gravity 9.81 m/s^2 along -z;
/// #         body shaft: massless;
/// #         body bar: rod(mass: 3 kg, length: l, along: -z);
/// #         joint spin:  revolute(z) from ground to shaft, driven at omega;
/// #         joint theta: revolute(y) from shaft to bar;
/// #     }
/// # }
/// use std::ops::ControlFlow;
/// use eigentol_tables::{campbell_table, csv};
///
/// let study = Study::new(Pendulum);
/// let (d, inputs, input) = (study.description(), study.input_values(), Pendulum::omega.any());
/// let mut file = csv::Writer::new(Vec::new());
/// study.campbell_each(Pendulum::omega, &[0.0, 1.0, 2.0], &[1.0], |point| {
///     let rows = campbell_table(d, inputs, input, &[point]);
///     match file.write(&rows) {
///         Ok(()) => ControlFlow::Continue(()),
///         Err(_) => ControlFlow::Break(()),
///     }
/// })?;
/// assert_eq!(String::from_utf8(file.finish()?)?.lines().count(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn campbell_table(
    d: &Description,
    inputs: &[f64],
    input: Input,
    points: &[CampbellPoint],
) -> Table {
    let mut values = Vec::new();
    let mut modes: Vec<Option<&CampbellMode>> = Vec::new();
    let mut errors = Vec::new();
    for point in points {
        match &point.modes {
            Ok(own) => modes.extend(own.iter().map(Some)),
            Err(_) => modes.push(None),
        }
        values.resize(modes.len(), point.value);
        let error = point.modes.as_ref().err().map(ToString::to_string);
        errors.resize(modes.len(), error);
    }
    let mut table = Table::new("Campbell diagram");
    varied(&mut table, d, input, values.into_iter());
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
    operating_point(&mut table, d, inputs, Some(input));
    table
}

/// `Campbell diagram`: [`campbell_table`]; then `crossings`, `critical states` and `flutter onsets`, if any.
impl Tables for Campbell {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let table = campbell_table(d, &self.inputs, self.input, &self.points);
        let mut tables = vec![table];
        tables.extend(events("crossings", &self.crossings));
        tables.extend(events("critical states", &self.critical));
        tables.extend(events("flutter onsets", &self.flutter_onsets));
        tables
    }
}
