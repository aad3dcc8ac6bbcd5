//! User errors are collected, so that one run reports every independent mistake.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::fmt;

use proc_macro2::{Ident, Span, TokenStream};

use super::names::{LINK, written};
use super::span::Extent;

/// One mistake: the problem, its place, and how to fix it.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// The offending tokens.
    pub span: Extent,
    /// The problem.
    pub message: String,
    /// How to fix it.
    pub help: Option<String>,
    /// The instance of a part in which it is, and where that is used.
    pub within: Option<(String, Extent)>,
}

impl Diagnostic {
    /// A mistake at `span`.
    pub fn new(span: impl Into<Extent>, message: impl Into<String>) -> Self {
        Self { span: span.into(), message: message.into(), help: None, within: None }
    }

    /// Adds advice on how to fix the mistake.
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The message, with the help on a separate line.
    pub fn text(&self) -> String {
        match &self.help {
            Some(help) => format!("{}\nhelp: {help}", self.message),
            None => self.message.clone(),
        }
    }

    /// The help, and where the instance is used: `line` writes the line of a text.
    #[cfg(feature = "locations")]
    pub fn help_and_use(&self, line: impl Fn(usize) -> String) -> Option<String> {
        let used = self.within.as_ref().map(|(name, at)| {
            let start = at.first.start();
            format!("this is in `{name}`, used at {}:{}", line(start.line), start.column + 1)
        });
        let all: Vec<String> = self.help.clone().into_iter().chain(used).collect();
        (!all.is_empty()).then(|| all.join("\n"))
    }
}

/// What tells one place from another.
pub fn place(span: Span) -> String {
    format!("{span:?}")
}

/// A text in which names have lost the instances before them.
fn without_instances(text: &str) -> String {
    let word = |word: &str| {
        let mut words = word.rsplit(LINK);
        words.find(|word| !word.starts_with(|c: char| c.is_ascii_digit())).unwrap_or_default().to_owned()
    };
    text.split('`').map(word).collect::<Vec<_>>().join("`")
}

/// A collector of mistakes. Dropping a collector whose mistakes were never read is a bug in the compiler, which would
/// then accept a wrong declaration; debug builds panic.
#[derive(Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    seen: BTreeSet<(String, String)>,
    looked_at: Cell<bool>,
}

impl Diagnostics {
    /// An empty collector.
    pub fn new() -> Self {
        Self::default()
    }

    /// Records a mistake.
    pub fn error(&mut self, span: impl Into<Extent>, message: impl Into<String>) {
        self.push(Diagnostic::new(span, message));
    }

    /// Records a mistake with advice on how to fix it.
    pub fn error_with_help(&mut self, span: impl Into<Extent>, message: impl Into<String>, help: impl Into<String>) {
        self.push(Diagnostic::new(span, message).with_help(help));
    }

    /// Records a mistake, with its help if there is any, unless another instance of the same item has it already.
    pub fn push(&mut self, mut diagnostic: Diagnostic) {
        self.looked_at.set(false);
        let place = place(diagnostic.span.first);
        // Only some compilers tell places apart.
        if place.contains("bytes") && !self.seen.insert((place, without_instances(&diagnostic.message))) {
            return;
        }
        diagnostic.message = written(&diagnostic.message).into_owned();
        diagnostic.help = diagnostic.help.map(|help| written(&help).into_owned());
        self.list.push(diagnostic);
    }

    /// Says in which instance of a part each mistake is: `within` gives its name and where it is used.
    pub fn explain(&mut self, within: impl Fn(Span) -> Option<(String, Extent)>) {
        for diagnostic in &mut self.list {
            diagnostic.within = within(diagnostic.span.first);
        }
    }

    /// Puts a place before the messages from the given one on.
    pub fn prefix_from(&mut self, first: usize, place: &str) {
        self.list[first..].iter_mut().for_each(|diagnostic| diagnostic.message.insert_str(0, place));
    }

    /// Moves all mistakes of another collector into this one.
    pub fn append(&mut self, mut other: Diagnostics) {
        self.extend(other.list.drain(..));
    }

    /// Whether no mistake was recorded.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Number of mistakes.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// The value if there are no mistakes, otherwise the mistakes.
    pub fn into_result<T>(self, value: T) -> Result<T, Diagnostics> {
        if self.is_empty() { Ok(value) } else { Err(self) }
    }

    /// The mistakes in the order found.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.looked_at.set(true);
        self.list.iter()
    }

    /// One `compile_error!` per mistake, at the offending tokens.
    pub fn into_compile_errors(self) -> TokenStream {
        // syn marks the range from the first to the last of the tokens it is given.
        let error = |at: Extent, text: String| {
            let [first, last] = [at.first, at.last].map(|span| Ident::new("end", span));
            syn::Error::new_spanned(quote::quote!(#first #last), text)
        };
        let errors = self.iter().map(|diagnostic| {
            let mut all = error(diagnostic.span, diagnostic.text());
            if let Some((name, at)) = &diagnostic.within {
                all.combine(error(*at, format!("in `{name}`, used here")));
            }
            all.to_compile_error()
        });
        errors.collect()
    }
}

impl Extend<Diagnostic> for Diagnostics {
    fn extend<T: IntoIterator<Item = Diagnostic>>(&mut self, mistakes: T) {
        for diagnostic in mistakes {
            self.push(diagnostic);
        }
    }
}

impl Drop for Diagnostics {
    fn drop(&mut self) {
        if cfg!(debug_assertions) && !std::thread::panicking() {
            assert!(
                self.list.is_empty() || self.looked_at.get(),
                "mistakes were dropped unreported: {:?}",
                self.list.iter().map(Diagnostic::text).collect::<Vec<_>>()
            );
        }
    }
}

/// One paragraph per mistake, for build scripts and logs.
impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, diagnostic) in self.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            #[cfg(feature = "locations")]
            {
                let start = diagnostic.span.first.start();
                write!(f, "{}:{}: ", start.line, start.column + 1)?;
            }
            write!(f, "error: {}", diagnostic.message)?;
            #[cfg(feature = "locations")]
            let help = diagnostic.help_and_use(|line| line.to_string());
            #[cfg(not(feature = "locations"))]
            let help = diagnostic.help.as_ref();
            if let Some(help) = help {
                write!(f, "\nhelp: {help}")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

/// `a`, `b` and `c`.
pub fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use proc_macro2::Span;

    use super::*;

    #[test]
    fn result_is_the_value_without_mistakes() {
        assert_eq!(Diagnostics::new().into_result(3).ok(), Some(3));
    }

    #[test]
    fn every_mistake_becomes_a_compile_error_with_its_help() {
        let mut diagnostics = Diagnostics::new();
        diagnostics.error(Span::call_site(), "first");
        diagnostics.error_with_help(Span::call_site(), "second", "do this");
        let tokens = diagnostics.into_compile_errors().to_string();
        assert_eq!(tokens.matches("compile_error").count(), 2);
        assert!(tokens.contains("second\\nhelp: do this"), "{tokens}");
    }

    #[test]
    #[cfg(debug_assertions)]
    #[should_panic(expected = "dropped unreported")]
    fn forgetting_a_mistake_panics() {
        Diagnostics::new().error(Span::call_site(), "forgotten");
    }
}
