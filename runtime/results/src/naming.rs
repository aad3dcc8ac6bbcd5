//! Names of modes in sentences.

/// `mode 2`, `modes 2 and 3`, `modes 1 to 4 and 7`, counted from 1.
pub fn named(modes: &[usize]) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &mode in modes {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == mode => *last = mode,
            _ => runs.push((mode, mode)),
        }
    }
    let texts = runs.iter().flat_map(|&(first, last)| match last - first {
        0 => vec![(first + 1).to_string()],
        1 => vec![(first + 1).to_string(), (last + 1).to_string()],
        _ => vec![format!("{} to {}", first + 1, last + 1)],
    });
    let texts: Vec<String> = texts.collect();
    match &texts[..] {
        [] => "no mode".to_owned(),
        [one] if modes.len() == 1 => format!("mode {one}"),
        [one] => format!("modes {one}"),
        [others @ .., last] => format!("modes {} and {last}", others.join(", ")),
    }
}

/// The text with a capital first letter.
pub fn capital(mut text: String) -> String {
    if let Some(first) = text.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    text
}
