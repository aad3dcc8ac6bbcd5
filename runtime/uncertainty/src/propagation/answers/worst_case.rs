use eigentol_results::numbers::number;
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use super::{Row, names_and_units, responses};
use crate::Description;
use crate::propagation::{Extreme, ResponseLimits, WorstCase};

/// `worst case`: a row for each response, numbers in its `unit`; `worst designs`: a row for each extreme of each
/// response, with the design that attains it.
impl Answer for WorstCase {
    const KIND: &'static str = "worst case";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled(format_args!("worst case over the box of limits, {} designs", self.evaluations));
        let rows = Row::each(&self.wanted, d, &self.responses);
        extremes(&mut said, &rows, d);
        self.designs(&mut said);
        for row in &rows {
            reservations(&mut said, row, d);
        }
        said
    }
}

displayed!(WorstCase);

type Limits<'a> = Row<&'a ResponseLimits>;

fn extremes(said: &mut Findings, rows: &[Limits<'_>], d: &Description) {
    let mut table = Columns::new("worst case", rows);
    responses(&mut table);
    type Pick = fn(&ResponseLimits) -> Option<f64>;
    let picks: [(&str, Pick); 3] = [
        ("nominal", |x| x.nominal),
        ("least", |x| Some(x.least.as_ref()?.value)),
        ("greatest", |x| Some(x.greatest.as_ref()?.value)),
    ];
    for (name, pick) in picks {
        table.number(name, "", &|row| Some(row.in_unit(pick(row.result)?))).digits(number);
    }
    table.flag("monotonic", &|row| Some(row.result.is_monotonic())).shown();
    table.words("turning", &|row| {
        let names = turning(row.result, d);
        (!names.is_empty()).then(|| names.join(" "))
    });
    table.whole("corners without a value", &|row| Some(row.result.missing.len()));
    said.columns(table);
}

/// The variables with which a response rises and falls.
fn turning<'d>(limits: &ResponseLimits, d: &'d Description) -> Vec<&'d str> {
    limits.turning.iter().filter_map(|&k| d.design.get(k)).map(|info| &*info.name).collect()
}

/// Why the limits of a response may not hold.
fn reservations(said: &mut Findings, row: &Limits<'_>, d: &Description) {
    let name = &row.name;
    let turning = turning(row.result, d);
    if !turning.is_empty() {
        said.note(format!("{name} rises and falls with {}: it may be worse inside the box.", turning.join(", ")));
    }
    let missing = row.result.missing.len();
    if missing > 0 {
        said.note(format!("{name} has no value at {missing} of the corners."));
    }
}

impl WorstCase {
    fn designs(&self, said: &mut Findings) {
        let d = &self.description;
        let mut rows: Vec<Row<(&str, &Extreme)>> = Vec::new();
        for (response, extremes) in self.wanted.iter().zip(&self.responses) {
            for (end, extreme) in [("least", &extremes.least), ("greatest", &extremes.greatest)] {
                let extreme = extreme.iter();
                rows.extend(extreme.map(|extreme| Row::new(response, d, (end, extreme))));
            }
        }
        let mut table = Columns::new("worst designs", &rows);
        names_and_units(&mut table);
        table.words("end", &|row| Some(row.result.0.to_owned()));
        table.number("value", "", &|row| Some(row.in_unit(row.result.1.value)));
        table.flag("confirmed", &|row| Some(row.result.1.confirmed));
        table.design(d, &|row| Some(&row.result.1.design[..]));
        said.columns(table);
    }
}
