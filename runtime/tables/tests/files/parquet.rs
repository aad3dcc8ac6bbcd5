//! Parquet files written row by row and read back, and unreadable files.

use std::io;

use eigentol_tables::{Error, Table, Values, parquet};

use crate::common::{Disk, table};

fn bytes(tables: &[Table]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut writer = parquet::Writer::new(&mut file);
    for table in tables {
        writer.write(table).expect("written");
    }
    writer.finish().expect("finished");
    file
}

#[test]
fn a_table_comes_back_bit_by_bit() {
    let back = parquet::read(&bytes(&[table()])[..]).expect("a table");
    assert_eq!(format!("{back:?}"), format!("{:?}", table()));
}

#[test]
fn parts_are_joined_in_order() {
    let part = |from: usize| {
        let mut table = Table::new("samples");
        table.whole("sample", from..from + 1000);
        let value = |k: usize| (!k.is_multiple_of(7)).then(|| (k as f64).sqrt());
        table.numbers("frequency", "rad/s", (from..from + 1000).map(value));
        table
    };
    let parts: Vec<Table> = (0..10).map(|k| part(1000 * k)).collect();
    let back = parquet::read(&bytes(&parts)[..]).expect("a table");
    assert_eq!((back.name.as_str(), back.rows()), ("samples", 10_000));
    let Values::Numbers(values) = &back.columns[1].values else {
        panic!("numbers");
    };
    for (k, value) in values.iter().enumerate() {
        assert_eq!(*value, (!k.is_multiple_of(7)).then(|| (k as f64).sqrt()), "{k}");
    }
}

#[test]
fn a_file_that_is_cut_off_is_refused() {
    let whole = bytes(&[table()]);
    for end in 0..whole.len() {
        let error = parquet::read(&whole[..end]).expect_err("cut off");
        assert!(matches!(error, Error::Content(_)), "{end}: {error}");
    }
}

#[test]
fn other_columns_are_refused_in_one_file() {
    let mut file = Vec::new();
    let mut writer = parquet::Writer::new(&mut file);
    writer.write(&table()).expect("written");
    let mut other = table();
    other.columns[1].unit = "m".to_owned();
    assert!(matches!(writer.write(&other), Err(Error::OtherColumns { .. })));
    // The rejected table leaves the file unaffected.
    writer.write(&table()).expect("written");
    writer.finish().expect("finished");
    assert_eq!(parquet::read(&file[..]).expect("a table").rows(), 2 * table().rows());
}

#[test]
fn another_version_is_refused() {
    let file = bytes(&[table()]);
    let key = b"eigentol";
    let at = file.windows(key.len()).position(|window| window == key).expect("the key");
    let version = at + file[at..].iter().position(|byte| *byte == b'1').expect("the version");
    let mut other = file.clone();
    other[version] = b'7';
    let error = parquet::read(&other[..]).expect_err("another version");
    assert!(matches!(&error, Error::Version { found, expected: 1, .. } if found == "7"), "{error}");
}

#[test]
fn a_full_disk_is_an_error() {
    let size = bytes(&[table()]).len();
    assert!(parquet::write(&table(), Disk(size)).is_ok());
    for room in 0..size {
        let error = parquet::write(&table(), Disk(room)).expect_err("no room");
        assert!(matches!(&error, Error::Write(own) if own.kind() == io::ErrorKind::StorageFull), "{room}: {error:?}");
    }
}
