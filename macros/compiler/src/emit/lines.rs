//! Generated items as lines of text, for a file.
//!
//! rustc looks up the place of every call that it compiles, and counts the characters of the line up to it. On one line
//! that takes the square of its length: of 500 s for three robots it took 480.

use proc_macro2::{Delimiter, Group, Spacing, TokenStream, TokenTree};

/// A line is ended once it is this long.
const WIDTH: usize = 100;
const INDENT: &str = "    ";

/// The tokens as text: a line for each attribute and each statement, or more if it is long; blocks are indented.
pub(crate) fn lines(tokens: TokenStream) -> String {
    let mut lines = Lines::default();
    lines.add(tokens, true);
    lines.text
}

/// Words after which brackets open no arguments.
const KEYWORDS: [&str; 10] = ["as", "for", "if", "impl", "in", "let", "match", "mut", "return", "where"];

#[derive(Default)]
struct Lines {
    text: String,
    /// Where the last line starts.
    start: usize,
    depth: usize,
    /// Lists of types that have begun.
    types: usize,
    /// The last token.
    last: Last,
}

/// What a token is for the space after it.
#[derive(Clone, Copy, Default, PartialEq)]
enum Last {
    /// An opening bracket or half of an operator: nothing may follow but the next token.
    #[default]
    Open,
    Punct(char),
    /// The second half of `::`.
    Path,
    Word,
    Keyword,
    /// A closing brace, after which a line ends unless a sign follows.
    Block,
}

impl Lines {
    /// Adds tokens, whose semicolons end lines if they are `statements`.
    fn add(&mut self, tokens: TokenStream, statements: bool) {
        for token in tokens {
            match &token {
                TokenTree::Group(group) => {
                    let attribute = self.last == Last::Punct('#');
                    self.add_group(group);
                    if attribute {
                        self.end_line();
                    } else if statements && group.delimiter() == Delimiter::Brace {
                        self.last = Last::Block;
                    }
                }
                TokenTree::Punct(punct) => {
                    let (sign, joint) = (punct.as_char(), punct.spacing() == Spacing::Joint);
                    let second = self.last == Last::Open && sign == ':' && self.text.ends_with(':');
                    let beside = match sign {
                        ',' | ';' | '.' | '?' => self.last != Last::Punct('.'),
                        '<' => self.last == Last::Word && self.begins_types(),
                        '>' => self.last != Last::Open && self.types > 0,
                        ':' => self.last == Last::Word || self.last == Last::Punct('>'),
                        _ => false,
                    };
                    match sign {
                        '<' if beside => self.types += 1,
                        '>' if beside => self.types -= 1,
                        _ => {}
                    }
                    self.place(beside);
                    self.text.push(sign);
                    self.last = match (joint, second) {
                        (true, _) => Last::Open,
                        (_, true) => Last::Path,
                        _ if self.text.ends_with("->") => Last::Keyword,
                        _ => Last::Punct(sign),
                    };
                    if sign == ';' && statements {
                        self.end_line();
                    }
                }
                word => {
                    self.place(matches!(self.last, Last::Path | Last::Punct('.' | '&' | '!' | '<')));
                    let word = word.to_string();
                    self.text.push_str(&word);
                    self.last = if KEYWORDS.contains(&&*word) { Last::Keyword } else { Last::Word };
                }
            }
        }
    }

    /// Whether the last word names a type or a function, not a value.
    fn begins_types(&self) -> bool {
        let word = self.text.rsplit(|c: char| !c.is_alphanumeric() && c != '_').next();
        word.is_some_and(|word| word.starts_with(char::is_uppercase) || !word.ends_with('_'))
    }

    fn add_group(&mut self, group: &Group) {
        let (open, close) = match group.delimiter() {
            Delimiter::Parenthesis => ("(", ")"),
            Delimiter::Brace => ("{", "}"),
            Delimiter::Bracket => ("[", "]"),
            Delimiter::None => ("", ""),
        };
        let block = group.delimiter() == Delimiter::Brace && !group.stream().is_empty();
        let called = matches!(self.last, Last::Word | Last::Path | Last::Punct('.' | '&' | '!' | '<' | '>' | '#'));
        self.place(called && group.delimiter() != Delimiter::Brace);
        self.text.push_str(open);
        self.last = Last::Open;
        if block {
            self.depth += 1;
            self.end_line();
        }
        self.add(group.stream(), group.delimiter() == Delimiter::Brace);
        if block {
            self.depth -= 1;
            if self.text.len() > self.start {
                self.end_line();
            }
        }
        self.place(true);
        self.text.push_str(close);
        self.last = Last::Word;
    }

    /// Makes room for the next token, `beside` the last one if that reads better.
    fn place(&mut self, beside: bool) {
        if self.last == Last::Block && !beside {
            self.end_line();
        }
        let length = self.text.len() - self.start;
        if length > 0 && (self.last == Last::Open || beside) {
            return;
        }
        if length >= WIDTH {
            self.end_line();
        } else if length > 0 {
            self.text.push(' ');
            return;
        }
        self.text.extend(std::iter::repeat_n(INDENT, self.depth));
    }

    fn end_line(&mut self) {
        self.text.push('\n');
        self.start = self.text.len();
        self.last = Last::Open;
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
        assert!(text.lines().all(|line| line.len() < WIDTH + 40), "{text}");
        let read: TokenStream = text.parse().expect("tokens");
        let dense = |tokens: TokenStream| tokens.to_string().replace(' ', "");
        assert_eq!(dense(read), dense(tokens));
    }
}
