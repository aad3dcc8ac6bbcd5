//! Generated items as lines of text, for a file.
//!
//! rustc looks up the place of every call that it compiles, and counts the characters of the line up to it. On one line
//! that takes the square of its length: of 500 s for three robots it took 480.

use proc_macro2::{Delimiter, Group, Spacing, TokenStream, TokenTree};

/// A line is ended once it is this long.
const WIDTH: usize = 100;

/// The tokens as text: a line for each attribute and each statement, or more if it is long.
pub(crate) fn lines(tokens: TokenStream) -> String {
    let mut lines = Lines::default();
    lines.add(tokens);
    lines.text
}

#[derive(Default)]
struct Lines {
    text: String,
    /// Where the last line starts.
    start: usize,
    /// Whether nothing may come between the last token and the next.
    joint: bool,
}

impl Lines {
    fn add(&mut self, tokens: TokenStream) {
        let mut last = None;
        for token in tokens {
            let ends = match &token {
                TokenTree::Group(group) => {
                    self.add_group(group);
                    group.delimiter() == Delimiter::Brace || last == Some('#')
                }
                TokenTree::Punct(punct) => {
                    self.add_word(&punct.to_string());
                    self.joint = punct.spacing() == Spacing::Joint;
                    punct.as_char() == ';'
                }
                word => {
                    self.add_word(&word.to_string());
                    false
                }
            };
            if ends {
                self.end_line();
            }
            last = match token {
                TokenTree::Punct(punct) => Some(punct.as_char()),
                _ => None,
            };
        }
    }

    fn add_group(&mut self, group: &Group) {
        let (open, close) = match group.delimiter() {
            Delimiter::Parenthesis => ("(", ")"),
            Delimiter::Brace => ("{", "}"),
            Delimiter::Bracket => ("[", "]"),
            Delimiter::None => ("", ""),
        };
        self.add_word(open);
        self.joint = true;
        self.add(group.stream());
        self.joint = true;
        self.add_word(close);
    }

    fn add_word(&mut self, word: &str) {
        let length = self.text.len() - self.start;
        match self.joint {
            true => {}
            false if length >= WIDTH => self.end_line(),
            false if length > 0 => self.text.push(' '),
            false => {}
        }
        self.text.push_str(word);
        self.joint = false;
    }

    fn end_line(&mut self) {
        self.text.push('\n');
        self.start = self.text.len();
    }
}

#[cfg(test)]
mod tests {
    use proc_macro2::TokenStream;
    use quote::quote;

    use super::{WIDTH, lines};

    #[test]
    fn lines_are_short_and_hold_the_same_tokens() {
        let many = (0..1000).map(|k| quote!(a[#k] - -b.c("; \n")));
        let tokens = quote! {
            #[doc = "a"]
            fn f<'a, T: ::core::marker::Copy>(r#in: &'a [T; 2]) -> T {
                let x = r#in[0];
                x >>= 1.5e-3f64; x.0.1 .. = y && !z;
                [#(#many),*]
            }
        };
        let text = lines(tokens.clone());
        assert!(text.lines().all(|line| line.len() < WIDTH + 20), "{text}");
        let read: TokenStream = text.parse().expect("tokens");
        assert_eq!(read.to_string(), tokens.to_string());
    }
}
