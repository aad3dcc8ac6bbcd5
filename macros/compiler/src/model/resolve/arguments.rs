//! Named arguments of shapes and force laws: each exactly once, none unknown.

use super::Resolver;
use crate::base::nearest::nearest;
use crate::syntax::ast::{NamedCall, Value};

/// A shape or a law with its arguments.
pub(super) struct Signature {
    pub(super) word: &'static str,
    pub(super) required: &'static [&'static str],
    pub(super) optional: &'static [&'static str],
    /// What to write, for messages.
    pub(super) example: &'static str,
}

/// The arguments of a call that are right.
pub(super) struct Arguments<'a> {
    given: Vec<(&'static str, &'a Value)>,
}

impl<'a> Arguments<'a> {
    /// The value of an argument, if it was given.
    pub(super) fn get(&self, name: &str) -> Option<&'a Value> {
        self.given
            .iter()
            .find(|(given, _)| *given == name)
            .map(|(_, value)| *value)
    }
}

impl Resolver<'_> {
    /// The signature that a call uses.
    pub(super) fn signature(
        &mut self,
        call: &NamedCall,
        kind: &str,
        known: &'static [Signature],
    ) -> Option<&'static Signature> {
        let word = call.word.to_string();
        let found = known.iter().find(|signature| signature.word == word);
        if found.is_none() {
            let words: Vec<&str> = known.iter().map(|signature| signature.word).collect();
            let help = match nearest(&word, words.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("known are {}", words.join(", ")),
            };
            let message = format!("unknown {kind} `{word}`");
            self.diagnostics.error_with_help(&call.word, message, help);
        }
        found
    }

    /// Sorts the arguments of a call by its signature.
    pub(super) fn arguments<'a>(
        &mut self,
        call: &'a NamedCall,
        signature: &'static Signature,
    ) -> Arguments<'a> {
        let word = signature.word;
        let known = || signature.required.iter().chain(signature.optional).copied();
        let mut given: Vec<(&'static str, &'a Value)> = Vec::new();
        // A misspelt argument is not missing as well.
        let mut meant = Vec::new();
        for argument in call.arguments.iter().flatten() {
            let name = argument.name.to_string();
            match known().find(|known| *known == name) {
                Some(known) if given.iter().any(|(given, _)| *given == known) => {
                    let message = format!("`{name}` is given twice");
                    self.diagnostics.error(&argument.name, message);
                }
                Some(known) => given.push((known, &argument.value)),
                None => {
                    let near = nearest(&name, known());
                    meant.extend(near);
                    let help = match near {
                        Some(near) => format!("did you mean `{near}`?"),
                        None => format!("write `{}`", signature.example),
                    };
                    let message = format!("`{word}` has no argument `{name}`");
                    self.diagnostics
                        .error_with_help(&argument.name, message, help);
                }
            }
        }
        let missing: Vec<String> = signature
            .required
            .iter()
            .filter(|name| !given.iter().any(|(given, _)| given == *name))
            .filter(|name| !meant.contains(name))
            .map(|name| format!("`{name}`"))
            .collect();
        if !missing.is_empty() {
            self.diagnostics.error_with_help(
                &call.word,
                format!("`{word}` needs {}", missing.join(", ")),
                format!("write `{}`", signature.example),
            );
        }
        Arguments { given }
    }
}
