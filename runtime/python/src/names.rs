//! Names, and suggestions for unknown ones.

use eigentol::Description;
use eigentol_language::base::nearest::nearest;

/// ``; did you mean `speed`?``, or nothing if no name is near.
pub(crate) fn did_you_mean<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    match nearest(name, known) {
        Some(near) => format!("; did you mean `{near}`?"),
        None => String::new(),
    }
}

/// Names of the entries of a description.
macro_rules! names {
    ($($list:ident)*) => {
        $(
            pub(crate) fn $list(description: &Description) -> Vec<&str> {
                description.$list.iter().map(|info| &*info.name).collect()
            }
        )*
    };
}

names! { coordinates inputs design outputs excitations }

/// The names of the excitations of each harmonic.
pub(crate) fn harmonics(description: &Description) -> Vec<Vec<&str>> {
    let all = &description.excitations;
    let firsts = (0..all.len()).filter(|&k| all[k].with == k);
    firsts.map(|first| all.iter().filter(move |info| info.with == first).map(|info| &*info.name).collect()).collect()
}
