//! Names of what is in instances and arrays: `blade[1].mass` is one identifier, in which [`LINK`] stands for a point and,
//! before a number, for brackets. No text that people read shows it.

use std::borrow::Cow;

/// The letter that joins the words of a name. Nobody writes it, and Rust takes it for a letter.
pub const LINK: char = 'ˑ';

/// `blade[1]` and `mass`: `blade[1].mass`. Without an instance, the name itself.
pub fn joined(instance: &str, name: &str) -> String {
    if instance.is_empty() { name.to_owned() } else { format!("{instance}{LINK}{name}") }
}

/// A text with all names in it as people write them.
pub fn written(text: &str) -> Cow<'_, str> {
    if !text.contains(LINK) {
        return Cow::Borrowed(text);
    }
    let mut words = text.split(LINK);
    let mut written = words.next().unwrap_or_default().to_owned();
    for word in words {
        let digits = word.len() - word.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        match word.split_at(digits) {
            ("", name) => written.extend([".", name]),
            (index, rest) => written.extend(["[", index, "]", rest]),
        }
    }
    Cow::Owned(written)
}

/// A text in which names are one word for other languages: `blade_1_mass`.
pub fn flattened(text: &str) -> String {
    text.replace(LINK, "_")
}

/// Whether a written name has the indices that a pattern has, or others in its ranges: `blade[..].mass`, `link[2..4]`.
pub fn fits(pattern: &str, name: &str) -> bool {
    match (pattern.split_once('['), name.split_once('[')) {
        (None, None) => pattern == name,
        (Some((own, pattern)), Some((other, name))) if own == other => {
            let (Some((range, pattern)), Some((index, name))) = (pattern.split_once(']'), name.split_once(']')) else {
                return false;
            };
            contains(range.trim(), index) && fits(pattern, name)
        }
        _ => false,
    }
}

/// Whether a range or an index contains an index.
fn contains(range: &str, index: &str) -> bool {
    let Some((from, to)) = range.split_once("..") else { return range == index };
    let Ok(index) = index.parse::<u32>() else { return false };
    let bound = |text: &str, otherwise: u32| match text.trim() {
        "" => Some(otherwise),
        text => text.parse().ok(),
    };
    bound(from, 0).is_some_and(|from| from <= index) && bound(to, u32::MAX).is_some_and(|to| index < to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_written_with_points_and_brackets() {
        let name = joined(&joined(&joined("rotor", "blade"), "12"), "mass");
        assert_eq!(written(&name), "rotor.blade[12].mass");
        assert_eq!(written(&format!("`{name}` is a body")), "`rotor.blade[12].mass` is a body");
        assert_eq!(joined("", "mass"), "mass");
        assert_eq!(flattened(&name), "rotor_blade_12_mass");
    }

    #[test]
    fn patterns_fit_the_indices_in_their_ranges() {
        for (pattern, fitting) in [
            ("b[..].m", [true, true, true, false]),
            ("b[1..].m", [false, true, true, false]),
            ("b[0..2].m", [true, true, false, false]),
            ("b[..1].m", [true, false, false, false]),
            ("b[2].m", [false, false, true, false]),
            ("b[..].c", [false; 4]),
            ("b.m", [false; 4]),
        ] {
            let names = ["b[0].m", "b[1].m", "b[2].m", "b[0].m[1]"];
            assert_eq!(names.map(|name| fits(pattern, name)), fitting, "{pattern}");
        }
    }
}
