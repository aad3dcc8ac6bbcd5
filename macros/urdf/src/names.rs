//! Converts names of a file to names of a declaration: valid, unique, and as close to the original as possible.

use std::collections::{BTreeMap, BTreeSet};

/// Words with a meaning in a declaration, and words that Rust reserves.
const RESERVED: [&str; 68] = [
    "input",
    "design",
    "let",
    "gravity",
    "kernels",
    "body",
    "joint",
    "point",
    "force",
    "every",
    "constraint",
    "output",
    "ground",
    "pi",
    "as",
    "break",
    "const",
    "continue",
    "crate",
    "else",
    "enum",
    "extern",
    "false",
    "fn",
    "for",
    "if",
    "impl",
    "in",
    "loop",
    "match",
    "mod",
    "move",
    "mut",
    "pub",
    "ref",
    "return",
    "self",
    "Self",
    "static",
    "struct",
    "super",
    "trait",
    "true",
    "type",
    "unsafe",
    "use",
    "where",
    "while",
    "async",
    "await",
    "dyn",
    "abstract",
    "become",
    "box",
    "do",
    "final",
    "macro",
    "override",
    "priv",
    "typeof",
    "unsized",
    "virtual",
    "yield",
    "try",
    "gen",
    "union",
    "mechanism",
    "raw",
];

/// Hands out unique names.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    taken: BTreeSet<String>,
    /// Original names by assigned name, where they differ.
    pub(crate) renamed: BTreeMap<String, String>,
}

impl Names {
    /// A name for something that the file calls `original`; `kind` is added if the name would otherwise be invalid or
    /// is taken.
    pub(crate) fn of_file(&mut self, original: &str, kind: &str) -> String {
        let name = self.unique(&valid(original, kind), kind);
        if name != original {
            self.renamed.insert(name.clone(), original.to_owned());
        }
        name
    }

    /// A name for something that is not in the file.
    pub(crate) fn unique(&mut self, wanted: &str, kind: &str) -> String {
        let with_kind = format!("{wanted}_{kind}");
        let numbered = (2..).map(|number| format!("{with_kind}_{number}"));
        let mut candidates = [wanted.to_owned(), with_kind.clone()].into_iter().chain(numbered);
        let name = candidates.find(|name| !self.taken.contains(name) && !is_reserved(name)).unwrap_or_default();
        self.taken.insert(name.clone());
        name
    }
}

fn is_reserved(name: &str) -> bool {
    RESERVED.contains(&name)
}

/// Letters, digits and underscores, not starting with a digit.
fn valid(original: &str, kind: &str) -> String {
    let allowed = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = original.chars().map(allowed).collect();
    let has_letter = name.chars().any(|c| c.is_ascii_alphabetic());
    match name.chars().next() {
        Some(first) if has_letter && !first.is_ascii_digit() => name,
        Some(_) => format!("{kind}_{name}"),
        None => kind.to_owned(),
    }
}

/// The name of a type: `solo12`, `my-robot v2` become `Solo12`, `MyRobotV2`.
pub(crate) fn type_name(original: &str) -> String {
    let words = original.split(|c: char| !c.is_ascii_alphanumeric());
    let name: String = words
        .filter_map(|word| {
            let mut letters = word.chars();
            let first = letters.next()?.to_ascii_uppercase();
            Some(format!("{first}{}", letters.as_str()))
        })
        .collect();
    match name.chars().next() {
        None => "Robot".to_owned(),
        Some(first) if first.is_ascii_digit() || is_reserved(&name) => format!("Robot{name}"),
        Some(_) => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_valid_and_unique() {
        let mut names = Names::default();
        let given = ["wrist-3", "wrist_3", "wrist/3", "2f_85", "", "body", "Self", "é", "_", "pi", "arm"]
            .map(|name| names.of_file(name, "link"));
        let expected = [
            "wrist_3",
            "wrist_3_link",
            "wrist_3_link_2",
            "link_2f_85",
            "link",
            "body_link",
            "Self_link",
            "link__",
            "link___link",
            "pi_link",
            "arm",
        ];
        assert_eq!(given, expected);
        assert_eq!(names.renamed["link_2f_85"], "2f_85");
        assert!(!names.renamed.contains_key("arm"));
        assert_eq!(names.unique("arm", "joint"), "arm_joint");
    }

    #[test]
    fn names_of_types() {
        let given = ["solo12", "my-robot v2", "", "2dof", "self"].map(type_name);
        assert_eq!(given, ["Solo12", "MyRobotV2", "Robot", "Robot2dof", "RobotSelf"]);
    }
}
