//! `include "bearing.part";` before or after a mechanism: the parts that another file declares. `"sections.csv"` and
//! `"casing.mtx"` among values: tables and matrices, whose texts follow the declaration.

use std::fs;
use std::path::{Path, PathBuf};

#[cfg(feature = "locations")]
use proc_macro2::Span;
use proc_macro2::{Literal, TokenStream, TokenTree};
use quote::quote_spanned;

use crate::base::diagnostics::Diagnostic;
pub use crate::base::quoted::without_mark;
use crate::base::quoted::{DATA, ending, file_name, placed, quoted};

/// Parts that come with eigentol: found by these names where the folder has no such file.
const LIBRARY: [(&str, &str); 9] = [
    ("belt.part", include_str!("../parts/belt.part")),
    ("blade.part", include_str!("../parts/blade.part")),
    ("flexible_coupling.part", include_str!("../parts/flexible_coupling.part")),
    ("gear_pair.part", include_str!("../parts/gear_pair.part")),
    ("journal_bearing.part", include_str!("../parts/journal_bearing.part")),
    ("leaf_spring.part", include_str!("../parts/leaf_spring.part")),
    ("mount.part", include_str!("../parts/mount.part")),
    ("rolling_bearing.part", include_str!("../parts/rolling_bearing.part")),
    ("universal_joint.part", include_str!("../parts/universal_joint.part")),
];

/// The name and the text of a part of the library.
pub fn library(name: &str) -> Option<(&'static str, &'static str)> {
    LIBRARY.iter().find(|(known, _)| *known == name).copied()
}

/// Where the files of a declaration may be, and those that have been read.
#[derive(Debug)]
pub struct Files {
    root: PathBuf,
    read: Vec<PathBuf>,
    /// Names of the parts of the library that have been read.
    known: Vec<&'static str>,
    /// Tables and matrices that have been read, by the names that values give them.
    data: Vec<(String, PathBuf)>,
}

/// The name of a table or a matrix.
fn data_name(literal: &Literal) -> Option<String> {
    file_name(literal).filter(|name| ending(name).is_some_and(|own| DATA.contains(&&*own)))
}

/// A file that a declaration includes.
struct Included {
    path: PathBuf,
    text: String,
}

impl Files {
    /// Files in a folder and those in it.
    pub fn of(root: &Path) -> Self {
        Self { root: root.to_owned(), read: Vec::new(), known: Vec::new(), data: Vec::new() }
    }

    /// The files that were included.
    pub fn into_paths(self) -> Vec<PathBuf> {
        self.read
    }

    /// Reads a file once; `chain` are the files from the first one to that which includes it.
    fn include(&mut self, name: &Literal, chain: &[PathBuf]) -> Result<Option<Included>, Diagnostic> {
        let mistake = |message: String| Err(Diagnostic::new(name.span(), message));
        let Some(written) = quoted(name) else {
            let error = Diagnostic::new(name.span(), "expected the name of a file");
            return Err(error.with_help("write `include \"bearing.part\";`"));
        };
        // A folder without a name is this one.
        let here = Path::new(".");
        let folder = chain.last().and_then(|file| file.parent()).unwrap_or(&self.root);
        if let Some((name, text)) = library(&written).filter(|_| !here.join(folder).join(&written).exists()) {
            if self.known.contains(&name) {
                return Ok(None);
            }
            self.known.push(name);
            return Ok(Some(Included { path: name.into(), text: text.to_owned() }));
        }
        let path = self.path(name, &written, chain)?;
        if let Some(start) = chain.iter().position(|file| *file == path) {
            let circle: Vec<String> =
                chain[start..].iter().chain([&path]).map(|file| file.display().to_string()).collect();
            return mistake(format!("files cannot include each other: `{}`", circle.join("` includes `")));
        }
        if self.read.contains(&path) {
            return Ok(None);
        }
        self.read(name, path).map(Some)
    }

    /// The text of a table or a matrix that values name, once.
    fn data(&mut self, name: &Literal, chain: &[PathBuf]) -> Result<Option<(String, Included)>, Diagnostic> {
        let Some(written) = data_name(name) else { return Ok(None) };
        let path = self.path(name, &written, chain)?;
        match self.data.iter().find(|(known, _)| *known == written) {
            Some((_, known)) if *known == path => Ok(None),
            Some((_, known)) => {
                let message = format!("`{written}` is also the name of {}", known.display());
                Err(Diagnostic::new(name.span(), message).with_help("give the two files different names"))
            }
            None => {
                self.data.push((written.clone(), path.clone()));
                self.read(name, path).map(|file| Some((written, file)))
            }
        }
    }

    /// Where a file is, in terms of the folder of the declaration.
    fn path(&self, name: &Literal, written: &str, chain: &[PathBuf]) -> Result<PathBuf, Diagnostic> {
        let mistake = |message: String| Err(Diagnostic::new(name.span(), message));
        let here = Path::new(".");
        let folder = chain.last().and_then(|file| file.parent()).unwrap_or(&self.root);
        let (path, root) = match (here.join(folder).join(written).canonicalize(), here.join(&self.root).canonicalize())
        {
            (Ok(path), Ok(root)) => (path, root),
            (Err(error), _) | (_, Err(error)) => return mistake(format!("`{written}` cannot be read: {error}")),
        };
        match path.strip_prefix(&root) {
            Ok(inside) => Ok(self.root.join(inside)),
            Err(_) => {
                let message = format!("`{written}` is outside the folder of the declaration");
                Err(Diagnostic::new(name.span(), message).with_help("it includes only what is in that folder"))
            }
        }
    }

    fn read(&mut self, name: &Literal, path: PathBuf) -> Result<Included, Diagnostic> {
        match fs::read_to_string(&path) {
            Ok(text) => {
                self.read.push(path.clone());
                Ok(Included { path, text: without_mark(text) })
            }
            Err(error) => {
                let message = format!("`{}` cannot be read: {error}", quoted(name).unwrap_or_default());
                Err(Diagnostic::new(name.span(), message))
            }
        }
    }

    /// The tokens of a macro, followed by those of the files that they include, which get the place of the `include`.
    ///
    /// # Errors
    /// A file that cannot be read, is outside the folder or includes itself.
    pub fn tokens(
        &mut self,
        tokens: TokenStream,
        lexer: &dyn Fn(&str) -> Option<TokenStream>,
        chain: &mut Vec<PathBuf>,
    ) -> Result<TokenStream, Diagnostic> {
        let (mut own, statements) = split(tokens);
        for name in named(own.clone()) {
            if let Some((written, file)) = self.data(&name, chain)? {
                let text = file.text;
                own.extend(quote_spanned! { name.span() => file #written #text; });
            }
        }
        for statement in statements {
            let Some(file) = self.include(&statement.name, chain)? else { continue };
            let Some(inner) = lexer(&file.text) else {
                let message =
                    format!("{} cannot be split into words: `eigentol check` says where", file.path.display());
                return Err(Diagnostic::new(statement.name.span(), message));
            };
            chain.push(file.path);
            own.extend(self.tokens(placed(inner, statement.name.span()), lexer, chain)?);
            chain.pop();
        }
        Ok(own)
    }
}

/// An `include` with its name.
struct Statement {
    name: Literal,
    #[cfg(feature = "locations")]
    ends: [Span; 2],
}

/// The tokens without the statements that include files, and these.
fn split(tokens: TokenStream) -> (TokenStream, Vec<Statement>) {
    let all: Vec<TokenTree> = tokens.into_iter().collect();
    let (mut own, mut statements) = (TokenStream::new(), Vec::new());
    let mut rest = &all[..];
    while let [first, after @ ..] = rest {
        rest = match rest {
            [TokenTree::Ident(word), TokenTree::Literal(name), TokenTree::Punct(end), after @ ..]
                if word == "include" && end.as_char() == ';' =>
            {
                statements.push(Statement {
                    name: name.clone(),
                    #[cfg(feature = "locations")]
                    ends: [word.span(), end.span()],
                });
                after
            }
            _ => {
                own.extend([first.clone()]);
                after
            }
        };
    }
    (own, statements)
}

/// The tables and matrices that values name, in any depth.
fn named(tokens: TokenStream) -> Vec<Literal> {
    let (mut names, mut is_text) = (Vec::new(), false);
    for token in tokens {
        match &token {
            TokenTree::Group(group) => names.extend(named(group.stream())),
            // Documentation is `doc = "text"`.
            TokenTree::Literal(literal) if !is_text => names.extend(data_name(literal).map(|_| literal.clone())),
            _ => {}
        }
        is_text = matches!(&token, TokenTree::Punct(sign) if sign.as_char() == '=');
    }
    names
}

#[cfg(feature = "locations")]
mod texts {
    use super::*;
    use crate::base::diagnostics::Diagnostics;
    use crate::mistakes::{Mistakes, START, tokens};

    impl Files {
        /// A declaration with the content of the files that it includes after it, as a text that needs no files.
        ///
        /// # Errors
        /// As [`Files::tokens`].
        pub fn text(&mut self, text: &str) -> Result<String, Mistakes> {
            let mut whole = String::new();
            self.append(text, &mut Vec::new(), &mut whole)?;
            Ok(whole)
        }

        fn append(&mut self, text: &str, chain: &mut Vec<PathBuf>, whole: &mut String) -> Result<(), Mistakes> {
            let of_file = |mistakes: Mistakes| match chain.last() {
                Some(file) => mistakes.with_file(file),
                None => mistakes,
            };
            let (own, statements) = split(tokens(text).map_err(of_file)?);
            let mut lines: Vec<Vec<char>> = text.split('\n').map(|line| line.chars().collect()).collect();
            for Statement { ends: [first, last], .. } in &statements {
                let (start, end) = (first.start(), last.end());
                for line in start.line..=end.line {
                    let chars = &mut lines[line - 1];
                    let from = if line == start.line { start.column } else { 0 };
                    let to = if line == end.line { end.column } else { chars.len() };
                    chars[from..to].fill(' ');
                }
            }
            let lines: Vec<String> = lines.into_iter().map(String::from_iter).collect();
            whole.push_str(&lines.join("\n"));
            let of_file = |mistake: Diagnostic, chain: &[PathBuf]| {
                let mut all = Diagnostics::new();
                all.push(mistake);
                match chain.last() {
                    Some(file) => Mistakes::from(all).with_file(file),
                    None => all.into(),
                }
            };
            for name in named(own) {
                let file = self.data(&name, chain).map_err(|mistake| of_file(mistake, chain))?;
                if let Some((written, Included { path, text })) = file {
                    whole.push_str(&format!("\n{START}{}\nfile {written:?} {text:?};\n", path.display()));
                }
            }
            for statement in statements {
                let file = self.include(&statement.name, chain).map_err(|mistake| of_file(mistake, chain))?;
                if let Some(Included { path, text }) = file {
                    whole.push_str(&format!("\n{START}{}\n", path.display()));
                    chain.push(path);
                    self.append(&text, chain, whole)?;
                    chain.pop();
                }
            }
            Ok(())
        }
    }
}
