//! Shared helpers of the file tests.

use std::io::{self, Write};

use eigentol_tables::Table;

/// All kinds of columns, numbers that are hard to write, and missing cells.
pub(crate) fn table() -> Table {
    let mut table = Table::new("mixed");
    table.whole("mode", [Some(1), None, Some(3)]);
    table.numbers("length", "mm", [0.1 + 0.2, f64::MIN_POSITIVE, -1.0e300]);
    table.numbers("sigma", "rad/s", [Some(5e-324), None, Some(-0.0)]);
    table.texts("name, with \"marks\"", ["a,b", "line\nline", " \"c\" "].map(|x| Some(x.to_owned())));
    table.flags("met", [Some(true), None, Some(false)]);
    table
}

/// A disk with room for this many bytes.
pub(crate) struct Disk(pub(crate) usize);

impl Write for Disk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.0 == 0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        let written = bytes.len().min(self.0);
        self.0 -= written;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
