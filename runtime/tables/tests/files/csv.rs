//! Tables written and read back, and unreadable files.

use std::io;

use eigentol_tables::{Column, Error, Table, Values, csv};

use crate::common::{Disk, table};

#[test]
fn a_table_comes_back_bit_by_bit() {
    let text = csv::to_string(&table()).expect("text");
    let back = csv::read("mixed", text.as_bytes()).expect("a table");
    assert_eq!(back, table());
    let Some(Column { values: Values::Numbers(own), .. }) = back.column("sigma") else {
        panic!("numbers");
    };
    assert!(own[2].expect("a number").is_sign_negative());
}

#[test]
fn what_is_not_finite_is_an_empty_cell() {
    let mut table = Table::new("distances");
    table.numbers("distance", "sigma", [f64::INFINITY, f64::NAN, 2.0]);
    let text = csv::to_string(&table).expect("text");
    assert_eq!(text, "distance [sigma]\n\"\"\n\"\"\n2.0\n");
    assert_eq!(csv::read("distances", text.as_bytes()).expect("a table"), table);
}

#[test]
fn a_file_that_is_cut_off_is_refused() {
    let text = csv::to_string(&table()).expect("text");
    // Cuts at the end of a row leave a valid shorter table, which CSV cannot detect.
    let mut whole = 0;
    for end in 1..text.len() {
        match csv::read("cut", &text.as_bytes()[..end]) {
            Ok(_) => whole += 1,
            Err(error) => assert!(matches!(error, Error::Malformed { .. }), "{end}: {error}"),
        }
    }
    assert_eq!(whole, 3);
    let error = csv::read("empty", io::empty()).expect_err("no headings");
    assert_eq!(error.to_string(), "line 1: there are no headings: the file is empty");
}

#[test]
fn other_columns_are_refused_in_one_file() {
    let mut other = Table::new("other");
    other.numbers("length", "m", [1.0]);
    let mut writer = csv::Writer::new(Vec::new());
    writer.write(&table()).expect("written");
    assert!(matches!(writer.write(&other), Err(Error::OtherColumns { .. })));
}

#[test]
fn columns_of_different_lengths_are_refused() {
    let mut table = table();
    table.columns[1].values = Values::Numbers(vec![Some(1.0)]);
    assert!(matches!(csv::to_string(&table), Err(Error::Lengths { found: 1, expected: 3, .. })));
}

#[test]
fn a_full_disk_is_an_error() {
    let size = csv::to_string(&table()).expect("text").len();
    assert!(csv::write(&table(), Disk(size)).is_ok());
    for room in 0..size {
        let error = csv::write(&table(), Disk(room)).expect_err("no room");
        assert!(matches!(&error, Error::Write(own) if own.kind() == io::ErrorKind::StorageFull), "{error:?}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn so_is_that_of_the_system() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("the device");
    let error = csv::write(&table(), full).expect_err("no room");
    assert!(matches!(&error, Error::Write(own) if own.kind() == io::ErrorKind::StorageFull), "{error:?}");
}
