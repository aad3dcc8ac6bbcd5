use eigentol_results::numbers::{number, short};
use eigentol_results::relevance::{BELOW, names, relevant};
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use super::{Row, names_and_units};
use crate::Description;
use crate::propagation::{Estimate, Influence, VariableInfluence};

/// `influence`: a row for each response and variable; `at low` and `at high` are in the `unit` of the response.
impl Answer for Influence {
    const KIND: &'static str = "influence";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("where the scatter of responses comes from");
        let (total, counts) = (self.counts.total(), &self.counts);
        said.note(format!("{total} designs: {counts}."));
        let mut all = Vec::new();
        for (response, influence) in self.wanted.iter().zip(&self.responses) {
            let rows = influence.variables.iter().map(|variable| Row::new(response, d, variable));
            let rows: Vec<_> = rows.collect();
            described(&mut said, &rows, d);
            if influence.missing > 0 {
                let missing = influence.missing;
                said.note(format!("{missing} designs have no value and are left out."));
            }
            all.extend(rows);
        }
        let table = influences(&all, Vec::new(), d);
        said.columns(table);
        said
    }
}

displayed!(Influence);

type Of<'a> = Row<&'a VariableInfluence>;

/// What the text says of one response.
fn described(said: &mut Findings, rows: &[Of<'_>], d: &Description) {
    let negligible = |row: &Of<'_>| {
        let none = |index: Option<Estimate>| index.is_some_and(|index| !relevant(index.upper, 1.0));
        none(row.result.first) && none(row.result.total)
    };
    let (left, shown): (Vec<usize>, Vec<usize>) = (0..rows.len()).partition(|&k| negligible(&rows[k]));
    said.text(influences(rows, shown, d).finish().1);
    if !left.is_empty() {
        let left: Vec<&str> = left.iter().map(|&k| variable(&rows[k], d)).collect();
        let names = names(&left, "variables");
        said.note(format!("Left out, certainly {BELOW} of the variance: {names}"));
    }
    let dependent = |row: &Of<'_>| row.result.first.is_none() && row.result.correlation.is_some();
    if rows.iter().any(dependent) {
        said.note(
            "No Sobol' indices: the variables depend on each other, so no share of the variance belongs to one of them alone.",
        );
    }
}

fn variable<'d>(row: &Of<'_>, d: &'d Description) -> &'d str {
    let info = d.design.get(row.result.variable);
    info.map_or("?", |info| &*info.name)
}

fn influences<'a, 'o>(rows: &'a [Of<'o>], shown: Vec<usize>, d: &Description) -> Columns<'a, Of<'o>> {
    let mut table = Columns::new("influence", rows);
    table.show_rows(shown);
    names_and_units(&mut table);
    let label = rows.first().map_or_else(String::new, Row::label);
    table.words("of", &|row| Some(d.design.get(row.result.variable)?.name.to_string())).shown().headed(&label);
    index(&mut table, "first", &|x| x.first);
    index(&mut table, "total", &|x| x.total);
    type Pick = fn(&VariableInfluence) -> Option<f64>;
    let picks: [(&str, Pick); 3] = [
        ("correlation", |x| x.correlation),
        ("rank correlation", |x| x.rank_correlation),
        ("regression", |x| x.regression),
    ];
    for (name, pick) in picks {
        table.number(name, "", &|row| pick(row.result)).digits(short);
    }
    let ends: [(&str, Pick); 2] = [("at low", |x| x.at_low), ("at high", |x| x.at_high)];
    for (name, pick) in ends {
        table.number(name, "", &|row| Some(row.in_unit(pick(row.result)?))).digits(number);
    }
    table
}

/// An index and its interval.
fn index(table: &mut Columns<'_, Of<'_>>, name: &str, of: &dyn Fn(&VariableInfluence) -> Option<Estimate>) {
    table.number(name, "", &|row| Some(of(row.result)?.value)).digits(short);
    table.number(&format!("{name} from"), "", &|row| Some(of(row.result)?.lower));
    table.number(&format!("{name} to"), "", &|row| Some(of(row.result)?.upper));
    table.cells("95 %", &|row| {
        let estimate = of(row.result);
        estimate.map_or_else(|| "-".to_owned(), |item| format!("{} to {}", short(item.lower), short(item.upper)))
    });
}
