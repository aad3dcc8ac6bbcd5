//! Whether messages are coloured.

use clap::ValueEnum;

/// Whether messages are coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    Auto,
    Always,
    Never,
}

impl Color {
    /// The setting requested on a command line that could not be parsed.
    pub(crate) fn asked() -> Self {
        let arguments: Vec<String> =
            (std::env::args_os()).map(|argument| argument.to_string_lossy().into_owned()).collect();
        let apart = arguments.iter().position(|argument| argument == "--color");
        let value = match apart {
            Some(k) => arguments.get(k + 1).map(String::as_str),
            None => arguments.iter().find_map(|argument| argument.strip_prefix("--color=")),
        };
        value.and_then(|value| Self::from_str(value, false).ok()).unwrap_or(Self::Auto)
    }

    /// Whether to colour text, given whether it is written to a terminal.
    pub(crate) fn on(self, terminal: bool) -> bool {
        // https://no-color.org
        let wanted = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => wanted && terminal,
        }
    }
}
