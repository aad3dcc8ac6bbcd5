//! Named arguments of shapes and force laws: each at most once, none unknown, none missing.

use proc_macro2::Ident;

use super::resolver::Resolver;
use crate::base::nearest::{advice, meant, suggestion};
use crate::syntax::ast::{NamedCall, Value};

/// A shape or a law with the arguments that it takes.
pub(super) struct Signature<R> {
    pub(super) word: &'static str,
    /// The function that interprets the arguments.
    pub(super) read: R,
    required: &'static [&'static str],
    optional: &'static [&'static str],
    choice: Choice,
    /// Arguments that one might expect, each with the reason why it does not exist.
    refused: &'static [(&'static str, &'static str)],
    /// An example for messages.
    example: &'static str,
}

/// A set of arguments of which some must be given.
enum Choice {
    ExactlyOne(&'static [&'static str]),
    AtLeastOne(&'static [&'static str]),
}

/// Names of arguments in other tools; only arguments of the signature are ever suggested.
const SYNONYMS: [(&str, &str); 51] = [
    ("speed", "frequency"),
    ("harmonic", "order"),
    ("displacement", "amplitude"),
    ("magnitude", "amount"),
    ("m", "mass"),
    ("weight", "mass"),
    ("rho", "density"),
    ("l", "length"),
    ("height", "length"),
    ("r", "radius"),
    ("inner_radius", "inner"),
    ("outer_radius", "outer"),
    ("radius", "outer"),
    ("axis", "along"),
    ("direction", "along"),
    ("along", "axis"),
    ("direction", "axis"),
    ("com", "center"),
    ("centre", "center"),
    ("dimensions", "size"),
    ("moments", "inertia"),
    ("k", "stiffness"),
    ("c", "damping"),
    ("free_length", "length"),
    ("natural_length", "length"),
    ("torque", "moment"),
    ("coordinate", "on"),
    ("joint", "on"),
    ("point", "at"),
    ("expression", "law"),
    ("force", "value"),
    ("force", "law"),
    ("axes", "along"),
    ("directions", "along"),
    ("distance", "length"),
    ("first", "of"),
    ("driven", "of"),
    ("second", "with"),
    ("driver", "with"),
    ("gear_ratio", "ratio"),
    ("value", "zero"),
    ("expression", "zero"),
    ("equation", "zero"),
    ("hub", "wheel"),
    ("disk", "wheel"),
    ("center", "wheel"),
    ("axle", "axis"),
    ("plane", "on"),
    ("ground", "on"),
    ("road", "on"),
    ("up", "normal"),
];

impl<R: Copy> Signature<R> {
    /// A word with its required arguments.
    pub(super) const fn new(
        word: &'static str,
        required: &'static [&'static str],
        example: &'static str,
        read: R,
    ) -> Self {
        Self { word, read, required, optional: &[], choice: Choice::ExactlyOne(&[]), refused: &[], example }
    }

    /// Adds arguments that may be omitted.
    pub(super) const fn optional(mut self, names: &'static [&'static str]) -> Self {
        self.optional = names;
        self
    }

    /// Requires exactly one of these arguments.
    pub(super) const fn exactly_one(mut self, names: &'static [&'static str]) -> Self {
        self.choice = Choice::ExactlyOne(names);
        self
    }

    /// Requires one or more of these arguments.
    pub(super) const fn at_least_one(mut self, names: &'static [&'static str]) -> Self {
        self.choice = Choice::AtLeastOne(names);
        self
    }

    /// Adds arguments that are refused, with reasons.
    pub(super) const fn refusing(mut self, reasons: &'static [(&'static str, &'static str)]) -> Self {
        self.refused = reasons;
        self
    }

    fn choices(&self) -> &'static [&'static str] {
        match self.choice {
            Choice::ExactlyOne(names) | Choice::AtLeastOne(names) => names,
        }
    }

    fn names(&self) -> impl Iterator<Item = &'static str> + Clone {
        let choices = self.choices().iter();
        let others = self.required.iter().chain(self.optional);
        choices.chain(others).copied()
    }

    /// The required arguments that are missing: "`mass` or `density`".
    fn missing(&self, given: impl Fn(&str) -> bool) -> Vec<String> {
        let quoted = |name: &&str| format!("`{name}`");
        let mut missing = Vec::new();
        let choices = self.choices();
        if !choices.is_empty() && !choices.iter().any(|name| given(name)) {
            let words: Vec<String> = choices.iter().map(quoted).collect();
            if let Some((last, others)) = words.split_last() {
                missing.push(format!("{} or {last}", others.join(", ")));
            }
        }
        missing.extend(self.required.iter().filter(|name| !given(name)).map(quoted));
        missing
    }
}

/// The valid arguments of a call.
pub(super) struct Arguments<'a> {
    given: Vec<(&'static str, &'a Value)>,
    /// `of DRIVE` after an order.
    pub(super) of: Option<&'a Ident>,
}

impl<'a> Arguments<'a> {
    /// The value of an argument, if it was given.
    pub(super) fn get(&self, name: &str) -> Option<&'a Value> {
        self.given.iter().find(|(given, _)| *given == name).map(|(_, value)| *value)
    }
}

impl Resolver<'_> {
    /// The signature that a call uses. `synonyms` are the words of other tools.
    pub(super) fn signature<R: Copy>(
        &mut self,
        call: &NamedCall,
        kind: &str,
        known: &'static [Signature<R>],
        synonyms: &[(&str, &str)],
    ) -> Option<&'static Signature<R>> {
        let word = call.word.to_string();
        let found = known.iter().find(|signature| signature.word == word);
        if found.is_none() {
            let words: Vec<&str> = known.iter().map(|signature| signature.word).collect();
            let help = advice(&word, words.iter().copied(), synonyms)
                .unwrap_or_else(|| format!("known are {}", words.join(", ")));
            let message = format!("unknown {kind} `{word}`");
            self.diagnostics.error_with_help(&call.word, message, help);
        }
        found
    }

    /// Matches the arguments of a call with its signature.
    pub(super) fn arguments<'a, R: Copy>(
        &mut self,
        call: &'a NamedCall,
        signature: &'static Signature<R>,
    ) -> Arguments<'a> {
        let word = signature.word;
        let mut given: Vec<(&'static str, &'a Value)> = Vec::new();
        // A misspelt argument is not also missing, nor is the mass if a density was refused.
        let mut meant = Vec::new();
        let mut of = None;
        for argument in call.arguments.iter().flatten() {
            let name = argument.name.to_string();
            match &argument.of {
                Some(drive) if name == "order" => of = Some(drive),
                Some(drive) => {
                    let message = format!("`{name}` has no `of`; an order is counted `of` a drive");
                    self.diagnostics.error(drive, message);
                }
                None => {}
            }
            let is_given = |name: &str| given.iter().any(|(given, _)| *given == name);
            match signature.names().find(|known| *known == name) {
                Some(known) if is_given(known) => {
                    let message = format!("`{name}` is given twice");
                    self.diagnostics.error(&argument.name, message);
                }
                Some(known) => {
                    let other = signature.choices().iter().find(|other| is_given(other));
                    let exclusive = matches!(signature.choice, Choice::ExactlyOne(names) if names.contains(&known));
                    if let (Some(other), true) = (other, exclusive) {
                        let message = format!("`{word}` takes `{other}` or `{known}`, not both");
                        self.diagnostics.error(&argument.name, message);
                    }
                    given.push((known, &argument.value));
                }
                None => {
                    let refused = signature.refused.iter().find(|(refused, _)| *refused == name);
                    let near = suggestion(&name, signature.names(), &SYNONYMS);
                    let help = match (refused, near) {
                        (Some((_, reason)), _) => (*reason).to_string(),
                        (None, Some(near)) => self::meant(near),
                        (None, None) => format!("write `{}`", signature.example),
                    };
                    match refused {
                        Some(_) => meant.extend(signature.names()),
                        None => meant.extend(near),
                    }
                    let message = format!("`{word}` has no argument `{name}`");
                    self.diagnostics.error_with_help(&argument.name, message, help);
                }
            }
        }
        let missing = signature.missing(|name| given.iter().any(|(given, _)| *given == name) || meant.contains(&name));
        if !missing.is_empty() {
            self.diagnostics.error_with_help(
                &call.word,
                format!("`{word}` needs {}", missing.join(", ")),
                format!("write `{}`", signature.example),
            );
        }
        Arguments { given, of }
    }
}
