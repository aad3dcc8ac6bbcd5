//! Words that exist only in the law of a tension.

use proc_macro2::Ident;

use super::resolver::Resolver;
use super::scope::Meaning;
use super::typed::{Quantity, Typed};
use crate::base::dimension::Dimension;
use crate::model::expression::Expr;

/// A word with its meaning.
pub(super) struct Word {
    name: &'static str,
    meaning: &'static str,
    expr: Expr,
    dimension: Dimension,
}

const WORDS: [Word; 2] = [
    Word { name: "length", meaning: "the distance of the two ends", expr: Expr::Length, dimension: Dimension::LENGTH },
    Word {
        name: "rate",
        meaning: "the rate of the distance of the two ends",
        expr: Expr::LengthRate,
        dimension: Dimension::SPEED,
    },
];

/// The word with this name.
pub(super) fn word(name: &str) -> Option<Word> {
    WORDS.into_iter().find(|word| word.name == name)
}

/// Every word.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    WORDS.into_iter().map(|word| word.name)
}

impl Resolver<'_> {
    /// The value of a word of tension laws; it must not be ambiguous with another declared name.
    pub(super) fn tension_word(&mut self, word: Word, name: &Ident) -> Option<Typed> {
        if let Some(meaning) = self.scope.find(word.name) {
            if meaning == Meaning::Unclear {
                return None;
            }
            let message =
                format!("`{name}` is ambiguous here: {}, or {} of that name", word.meaning, meaning.describe());
            let help = format!("give the declared `{name}` another name");
            return self.refuse_with_help(name, message, help);
        }
        Some(Typed::Scalar(word.expr, Quantity::Of(word.dimension)))
    }
}
