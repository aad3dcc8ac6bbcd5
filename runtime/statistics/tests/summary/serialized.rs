//! State that is written and read back is the same to the last bit.

use eigentol_statistics::Error;
use eigentol_statistics::summary::Partial;

use crate::common::gathered;

fn text(partial: &Partial) -> String {
    serde_json::to_string(partial).expect("numbers and lists")
}

#[test]
fn what_was_read_goes_on_as_what_was_written() -> Result<(), Error> {
    let mut partial = gathered(100..900)?;
    partial.merge(gathered(2000..2100)?)?;
    let mut read: Partial = serde_json::from_str(&text(&partial)).expect("what was written");
    assert_eq!(read, partial);
    read.merge(gathered(900..2000)?)?;
    assert_eq!(read, gathered(100..2100)?);
    let empty: Partial = serde_json::from_str(&text(&gathered(0..0)?)).expect("what was written");
    assert_eq!(empty, gathered(0..0)?);
    Ok(())
}

#[test]
fn states_that_cannot_be_are_refused() -> Result<(), Error> {
    let written = serde_json::to_value(gathered(100..1600)?).expect("numbers and lists");
    let refused = |path: &str, value: serde_json::Value| {
        let mut changed = written.clone();
        *changed.pointer_mut(path).unwrap_or_else(|| panic!("{path} in {written}")) = value;
        assert!(serde_json::from_value::<Partial>(changed).is_err(), "{path}");
    };
    refused("/tree/nodes/0/start", 3.into());
    refused("/tree/nodes/0/level", 60.into());
    refused("/tree/nodes/1/level", 0_u32.into());
    refused("/tree/nodes/0/moments", serde_json::json!([]));
    refused("/tree/nodes/0/pairs", serde_json::json!([]));
    refused("/fragments/0/index", 1.into());
    refused("/fragments/0/values", serde_json::json!([0]));
    refused("/fragments/0/present", serde_json::json!([]));
    refused("/sketches/0", serde_json::Value::Null);
    refused("/sketches/0/count", 7.into());
    refused("/sketches/0/scale", 0.into());
    refused("/sketches/0/buckets/0/0", 1.into());
    refused("/sketches/0/buckets/0/0", i32::MIN.into());
    refused("/sketches/0/buckets/0/1", 0.into());
    refused("/sketches/0/buckets", serde_json::json!([]));
    refused("/plan/pairs/0", serde_json::json!([1, 9]));
    refused("/outcomes", serde_json::json!([]));
    Ok(())
}
