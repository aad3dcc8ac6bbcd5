//! A mistake in a file of any language, in the form that is drawn.

/// What is wrong, where, and how to fix it. Lines and characters count from 1.
#[derive(Clone, Debug)]
pub(crate) struct Mistake {
    pub(crate) start: (usize, usize),
    /// One past the last character.
    pub(crate) end: (usize, usize),
    pub(crate) message: String,
    pub(crate) help: Option<String>,
}

impl From<&eigentol_interpreter::Mistake> for Mistake {
    fn from(own: &eigentol_interpreter::Mistake) -> Self {
        Self {
            start: (own.line, own.column),
            end: (own.end_line, own.end_column),
            message: own.message.clone(),
            help: own.help.clone(),
        }
    }
}

impl From<&eigentol_urdf::Mistake> for Mistake {
    fn from(own: &eigentol_urdf::Mistake) -> Self {
        let (line, column) = (own.line as usize, own.column as usize);
        Self {
            start: (line, column),
            end: (line, column + 1),
            message: own.reason.to_string(),
            help: Some(own.reason.help()),
        }
    }
}
