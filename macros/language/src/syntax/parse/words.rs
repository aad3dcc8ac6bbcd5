//! The words that start items, and replacements for others.

use crate::base::nearest::{advice, suggestion};

/// The words that start an item.
pub(super) const KEYWORDS: [&str; 14] = [
    "input",
    "design",
    "let",
    "curve",
    "gravity",
    "kernels",
    "body",
    "joint",
    "point",
    "force",
    "every",
    "constraint",
    "steady",
    "output",
];

/// Other words that start an item.
const ALSO_NAMES: [&str; 7] = ["unbalance", "material", "correlated", "cyclic", "part", "use", "for"];

/// Names of items in other tools and languages.
const SYNONYMS: [(&str, &str); 26] = [
    ("imbalance", "unbalance"),
    ("eccentricity", "unbalance"),
    ("table", "curve"),
    ("lookup", "curve"),
    ("spline", "curve"),
    ("map", "curve"),
    ("characteristic", "curve"),
    ("motor", "force"),
    ("param", "design"),
    ("parameter", "design"),
    ("variable", "design"),
    ("const", "let"),
    ("constant", "let"),
    ("link", "body"),
    ("marker", "point"),
    ("frame", "point"),
    ("site", "point"),
    ("loop", "constraint"),
    ("closure", "constraint"),
    ("equality", "constraint"),
    ("element", "force"),
    ("result", "output"),
    ("all", "every"),
    ("each", "every"),
    ("default", "every"),
    ("hold", "steady"),
];

/// Words that belong after the name of an item, not before it.
pub(crate) const INSIDE: [(&str, &[&str]); 4] = [
    (
        "body",
        &["massless", "rod", "disk", "cylinder", "tube", "box", "sphere", "rigid", "beam", "shaft", "superelement"],
    ),
    ("joint", &["fixed", "revolute", "prismatic", "screw", "cylindrical", "universal", "planar", "spherical", "free"]),
    (
        "force",
        &[
            "spring",
            "damper",
            "inerter",
            "spring_damper",
            "tension",
            "generalized",
            "potential",
            "bushing",
            "load",
            "follower",
            "drag",
            "distributed",
            "harmonic",
        ],
    ),
    ("constraint", &["coincident", "aligned", "distance", "coupling", "equation", "rolling"]),
];

/// The replacement for an unknown word at the start of an item.
pub(super) fn instead_of(unknown: &str) -> String {
    let inside = INSIDE.iter().find(|(_, words)| words.contains(&unknown));
    if let Some((keyword, _)) = inside {
        return format!("a `{unknown}` is a {keyword}: write `{keyword} NAME: {unknown} ...;`");
    }
    let known = KEYWORDS.into_iter().chain(ALSO_NAMES);
    advice(unknown, known, &SYNONYMS).unwrap_or_else(|| {
        let words = KEYWORDS.join(", ");
        format!("an item starts with one of {words}, {}", ALSO_NAMES.join(", "))
    })
}

/// The words that start a law of a tolerance; `truncated normal` is two words.
pub(super) const LAWS: [&str; 7] = ["normal", "truncated", "uniform", "triangular", "lognormal", "weibull", "beta"];

/// Other names for laws.
const SYNONYMS_OF_LAWS: [(&str, &str); 8] = [
    ("gaussian", "normal"),
    ("gauss", "normal"),
    ("truncnorm", "truncated"),
    ("truncated_normal", "truncated"),
    ("rectangular", "uniform"),
    ("flat", "uniform"),
    ("triangle", "triangular"),
    ("log_normal", "lognormal"),
];

/// The law that an unknown word probably means, as it is written.
pub(super) fn suggested_law(unknown: &str) -> Option<&'static str> {
    match suggestion(unknown, LAWS, &SYNONYMS_OF_LAWS)? {
        "truncated" => Some("truncated normal"),
        "beta" => Some("beta(2, 3)"),
        law => Some(law),
    }
}

/// Help for `# ...`.
pub(super) const COMMENT: &str = "a comment begins with `//`";

/// Help for `3,5`.
pub(super) const DECIMAL_POINT: &str = "a fraction is written with a point: `3.5`, not `3,5`";

/// Help for `G6.3`.
pub(crate) const GRADE: &str =
    "a grade of balancing is eccentricity times service speed (ISO 21940-11): write `grade: G6.3, service: 3000 rpm`";
