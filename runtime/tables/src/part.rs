//! Parts of a sampling run as text: the numbers and their checksum, so that a digit that changed on the way is noticed.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use crate::Error;

#[derive(Deserialize)]
struct Document<'a> {
    #[serde(borrow)]
    part: &'a RawValue,
    /// CRC-32 of the text of the part, in hexadecimal digits.
    checksum: String,
}

fn checksum(text: &str) -> String {
    format!("{:08x}", crc32fast::hash(text.as_bytes()))
}

/// A part as text.
///
/// # Errors
/// [`Error::Write`] if it cannot be written as JSON.
pub fn to_string(part: &impl Serialize) -> Result<String, Error> {
    let text = serde_json::to_string(part).map_err(|error| Error::Write(error.into()))?;
    let checksum = checksum(&text);
    Ok(format!("{{\"part\":{text},\"checksum\":\"{checksum}\"}}\n"))
}

/// The part of such a text.
///
/// # Errors
/// [`Error::Content`] if the text is cut off, is none of a part, or has changed since it was written.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, Error> {
    let refused = |error: serde_json::Error| {
        Error::Content(if error.is_eof() {
            "the file is cut off".to_owned()
        } else {
            format!("this is not a partial result: {error}")
        })
    };
    let document: Document<'_> = serde_json::from_str(text).map_err(refused)?;
    let part = serde_json::from_str(document.part.get()).map_err(refused)?;
    if checksum(document.part.get()) != document.checksum {
        return Err(Error::Content("the part has changed since it was written: its checksum is another".to_owned()));
    }
    Ok(part)
}

#[cfg(test)]
mod tests {
    use super::{read, to_string};

    #[test]
    fn a_changed_digit_is_noticed() {
        let text = to_string(&[1.25, 3.5]).expect("text");
        assert_eq!(read::<[f64; 2]>(&text).expect("a part"), [1.25, 3.5]);
        let changed = text.replace("1.25", "1.26");
        let error = read::<[f64; 2]>(&changed).expect_err("another digit");
        assert!(error.to_string().contains("checksum"), "{error}");
        let error = read::<[f64; 2]>(&text[..text.len() / 2]).expect_err("half a text");
        assert!(error.to_string().contains("cut off"), "{error}");
    }
}
