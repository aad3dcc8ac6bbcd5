use eigentol_results::Table;

use crate::Error;

/// Rejects columns of different lengths, which a hand-built table may have.
pub(crate) fn check(table: &Table) -> Result<(), Error> {
    let rows = table.rows();
    match table.columns.iter().find(|column| column.values.len() != rows) {
        None => Ok(()),
        Some(column) => Err(Error::Lengths {
            table: table.name.clone(),
            column: column.heading(),
            found: column.values.len(),
            expected: rows,
        }),
    }
}
