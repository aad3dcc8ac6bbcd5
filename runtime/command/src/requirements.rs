//! Requirements on a design, and outputs that an option names.

use eigentol::requirement::Requirement;
use eigentol::{Excitation, Output, Study};
use eigentol_interpreter::{Interpreted, excitation, output};

use crate::failure::Failure;
use crate::study_file::StudyFile;

/// The keys of a study file that state requirements.
macro_rules! require_keys {
    () => {
        r#"  require = ["frequency 1 >= 59 rad/s", "stable"]
  failure = 0.001                # greatest probability of violating each, or a list with one for each"#
    };
}
pub(crate) use require_keys;

/// The requirements that texts state, with what each text has beside them, such as the probability that it allows.
pub(crate) fn requirements<T: Clone>(
    study: &Study<Interpreted>,
    all: &[String],
    beside: &[T],
) -> Result<(Vec<Requirement>, Vec<T>), Failure> {
    let (mut wanted, mut each) = (Vec::new(), Vec::new());
    for (k, text) in all.iter().enumerate() {
        let stated = eigentol_interpreter::requirements(study, text)?;
        each.extend(beside.get(k).into_iter().flat_map(|own| vec![own.clone(); stated.len()]));
        wanted.extend(stated);
    }
    Ok((wanted, each))
}

impl StudyFile {
    /// The greatest probability of violating each requirement, as far as the file says it.
    pub(crate) fn allowed(&self) -> Result<Vec<Option<f64>>, Failure> {
        let count = self.require.len();
        match self.failure.as_deref() {
            None => Ok(vec![None; count]),
            Some([one]) => Ok(vec![Some(*one); count]),
            Some(each) if each.len() == count => Ok(each.iter().copied().map(Some).collect()),
            Some(each) => {
                let message = format!("`failure` has {} numbers for {count} requirements", each.len());
                Err(Failure::usage(message, "give one for all, or one for each"))
            }
        }
    }
}

/// The orbit written as `shake,lift` or `shake,lift under u`.
pub(crate) fn named_orbit(study: &Study<Interpreted>, text: &str) -> Result<([Output; 2], Excitation), Failure> {
    let (pair, under) = match text.split_once(" under ") {
        Some((pair, under)) => (pair, Some(under.trim())),
        None => (text, None),
    };
    Ok((named_pair(study, pair)?, excitation(study, under)?))
}

/// The two outputs of an orbit written as `shake,lift`.
pub(crate) fn named_pair(study: &Study<Interpreted>, text: &str) -> Result<[Output; 2], Failure> {
    match text.split_once(',') {
        Some((x, y)) => Ok([output(study, x.trim())?, output(study, y.trim())?]),
        None => {
            let message = format!("`{text}` is no pair of outputs");
            Err(Failure::usage(message, "write `--orbit shake,lift`"))
        }
    }
}
