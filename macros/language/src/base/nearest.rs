//! Suggests the nearest known name for a misspelt one.

/// What has no word here, and what is written instead: a linear answer needs smooth forces.
const ABSENT: [(&str, &str); 8] = [
    (
        "friction coulomb stiction",
        "dry friction has no linear law: what sticks is held by a `spring` or a joint, what slides has a `damper` of the same loss",
    ),
    (
        "contact impact stop backlash",
        "forces are smooth: declare the state in contact, by a `spring_damper` or a constraint, or the one without",
    ),
    ("max min if", "forces are smooth: write the side that acts, or `(x + sqrt(x^2 + d^2)) / 2` with a small `d`"),
    ("abs", "forces are smooth: write the side that acts, or `sqrt(x^2 + d^2)` with a small `d`"),
    ("sign sgn step tanh", "forces are smooth: write `x / sqrt(x^2 + d^2)` with a small `d`"),
    ("pow", "a power is written `x^2`"),
    ("controller pid feedback", "feedback is a force: `generalized(on: y, value: -kp * y - kd * rate(y))`"),
    ("mesh stl", "no file is read: `rigid(mass: 2 kg, inertia: [3, 4, 5] kg*m^2, center: [0, 0, 1] m)`"),
];

/// The advice on an unknown word: what to write instead, or the known word that is probably meant.
pub fn advice<'a>(
    name: &str,
    known: impl IntoIterator<Item = &'a str> + Clone,
    synonyms: &[(&str, &str)],
) -> Option<String> {
    let is_named = |word: &str| word.eq_ignore_ascii_case(name);
    match ABSENT.iter().find(|(words, _)| words.split(' ').any(is_named)) {
        Some((_, instead)) => Some((*instead).to_string()),
        None => suggestion(name, known, synonyms).map(meant),
    }
}

/// The question whether a known word is meant.
pub fn meant(near: &str) -> String {
    format!("did you mean `{near}`?")
}

/// The probable meaning of `name`: the known word for another tool's `name`, otherwise the nearest known word.
pub fn suggestion<'a>(
    name: &str,
    known: impl IntoIterator<Item = &'a str> + Clone,
    synonyms: &[(&str, &str)],
) -> Option<&'a str> {
    let translated = synonyms
        .iter()
        .filter(|(theirs, _)| theirs.eq_ignore_ascii_case(name))
        .find_map(|(_, ours)| known.clone().into_iter().find(|word| word == ours));
    translated.or_else(|| nearest(name, known))
}

/// The candidate nearest to `name`, if it is near enough to be meant. In a tie, the first wins.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let allowed = match name.chars().count() {
        0..=3 => 1,
        4..=5 => 2,
        length => length / 3 + 1,
    };
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let distance = if candidate.eq_ignore_ascii_case(name) { 0 } else { distance(name, candidate) };
        // If every letter would change, the name is not a misspelling.
        let longest = name.chars().count().max(candidate.chars().count());
        let near = distance <= allowed && distance < longest;
        if near && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b` (Damerau 1964, restricted).
fn distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.chars().collect();
    let b: Vec<char> = b.chars().collect();
    let mut before_last = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let substitution = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = substitution.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                let swap: usize = before_last[j - 2];
                least = least.min(swap + 1);
            }
            row.push(least);
        }
        before_last = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("theta", "theta"), 0);
        assert_eq!(distance("thtea", "theta"), 1);
        assert_eq!(distance("bar1", "bar2"), 1);
        assert_eq!(distance("kitten", "sitting"), 3);
    }

    #[test]
    fn words_of_other_tools_are_understood() {
        let synonyms = [("ball", "spherical"), ("ball", "sphere")];
        assert_eq!(suggestion("Ball", ["spherical", "bell"], &synonyms), Some("spherical"));
        assert_eq!(suggestion("ball", ["bell"], &synonyms), Some("bell"));
        assert_eq!(suggestion("pin", ["spherical"], &synonyms), None);
    }

    #[test]
    fn suggests_only_what_could_be_meant() {
        assert_eq!(nearest("thetal", ["theta2", "theta1"]), Some("theta2"));
        assert_eq!(nearest("OMEGA", ["gamma", "omega"]), Some("omega"));
        assert_eq!(nearest("m", ["k"]), None);
        assert_eq!(nearest("stiffnes", ["rest", "stiffness"]), Some("stiffness"));
        assert_eq!(nearest("abc", ["pendulum"]), None);
    }
}
