//! Reference values: the files in `truth/`, computed independently in high precision.

use serde_json::Value;

/// A part of a reference file. Numbers may be written as strings.
#[derive(Clone, Debug)]
pub struct Truth(Value);

impl Truth {
    /// Reads a file of `truth/` by its name without extension.
    ///
    /// # Panics
    /// When the file does not exist or is not JSON.
    pub fn load(name: &str) -> Self {
        let path = format!("{}/../truth/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        Self(serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}")))
    }

    /// A field.
    ///
    /// # Panics
    /// When the field is missing.
    pub fn get(&self, field: &str) -> Self {
        self.find(field).unwrap_or_else(|| panic!("no field {field}"))
    }

    /// A field that may be missing or null.
    pub fn find(&self, field: &str) -> Option<Self> {
        self.0.get(field).filter(|value| !value.is_null()).cloned().map(Self)
    }

    /// The names of the fields.
    pub fn fields(&self) -> Vec<String> {
        self.0.as_object().expect("an object").keys().cloned().collect()
    }

    /// The items of a list.
    pub fn list(&self) -> Vec<Self> {
        self.0.as_array().expect("a list").iter().cloned().map(Self).collect()
    }

    /// A text.
    pub fn text(&self) -> String {
        self.0.as_str().expect("a text").to_owned()
    }

    /// A Boolean.
    ///
    /// # Panics
    /// When the value is not a Boolean.
    pub fn truth(&self) -> bool {
        self.0.as_bool().expect("true or false")
    }

    /// A number.
    pub fn number(&self) -> f64 {
        match &self.0 {
            Value::String(text) => text.parse().expect("a number"),
            other => other.as_f64().expect("a number"),
        }
    }

    /// A list of numbers.
    pub fn numbers(&self) -> Vec<f64> {
        self.list().iter().map(Self::number).collect()
    }

    /// A matrix, row by row.
    pub fn matrix(&self) -> Vec<f64> {
        self.list().iter().flat_map(Self::numbers).collect()
    }
}
