//! Serialisation of error words that are constants of the program: `#[serde(with = "word")]`.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Deserializer, Serializer};

/// Words read so far, each kept once for the lifetime of the program.
static READ: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());

/// # Errors
/// Those of the format.
pub fn serialize<S: Serializer>(word: &str, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(word)
}

/// # Errors
/// Those of the format.
pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<&'static str, D::Error> {
    let word = String::deserialize(from)?;
    let mut all = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = all.get(&word[..]) {
        return Ok(known);
    }
    let text: &'static str = word.leak();
    all.insert(text);
    Ok(text)
}
