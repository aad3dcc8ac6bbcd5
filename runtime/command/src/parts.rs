//! Partial results of a sampling run: files that merge to a result bit-identical to a single run.

use std::fs;
use std::ops::Range;
use std::path::Path;
use std::str::FromStr;

use eigentol::Error;
use eigentol::tolerance::PartialMonteCarlo;
use eigentol_tables::part;

use crate::failure::Failure;

/// A part of a run: `3/64` is the third of 64.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    number: u64,
    count: u64,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/');
        let parts = parts.and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        match parts {
            Some((number, count)) if (1..=count).contains(&number) => Ok(Self { number, count }),
            Some(_) => Err("shards are counted from 1: `1/64` to `64/64`".to_owned()),
            None => Err("write the number of the shard and how many there are: `3/64`".to_owned()),
        }
    }
}

impl Shard {
    pub(crate) const WHOLE: Self = Self { number: 1, count: 1 };

    /// The range of its samples, out of `samples`.
    pub(crate) fn range(self, samples: u64) -> Range<u64> {
        let end = |number: u64| {
            let product = u128::from(samples) * u128::from(number) / u128::from(self.count);
            // At most the number of samples.
            u64::try_from(product).unwrap_or(samples)
        };
        end(self.number - 1)..end(self.number)
    }
}

/// Reads a partial result.
pub(crate) fn read(path: &Path) -> Result<PartialMonteCarlo, Failure> {
    let text = fs::read_to_string(path).map_err(|source| Failure::read(path, source))?;
    part::read(&text).map_err(|error| Failure::Part {
        path: path.to_owned(),
        message: match error {
            eigentol_tables::Error::Content(reason) => reason,
            other => other.to_string(),
        },
    })
}

/// Merges a part read from a file with others of its run.
pub(crate) fn add(all: &mut PartialMonteCarlo, path: &Path, part: PartialMonteCarlo) -> Result<(), Failure> {
    all.merge(part).map_err(|error| {
        let message = match &error {
            Error::OtherRun { what, own, other } => {
                format!("it belongs to another run: its {what} is {other}, that of the others {own}")
            }
            Error::SamplesOverlap { start, end } => {
                format!("its samples {start} to below {end} are already included")
            }
            error => error.to_string(),
        };
        Failure::Part { path: path.to_owned(), message }
    })
}

/// Serialises a partial result as the text of a file.
pub(crate) fn text(part: &PartialMonteCarlo) -> Result<String, Failure> {
    Ok(part::to_string(part)?)
}

#[cfg(test)]
mod tests {
    use super::Shard;

    #[test]
    fn shards_cover_all_samples_once() {
        for (samples, count) in [(10, 3), (3, 7), (0, 2), (u64::MAX, 1000)] {
            let mut end = 0;
            for number in 1..=count {
                let range = Shard { number, count }.range(samples);
                assert_eq!(range.start, end);
                end = range.end;
            }
            assert_eq!(end, samples);
        }
    }

    #[test]
    fn shards_are_counted_from_one() {
        assert_eq!("3/64".parse(), Ok(Shard { number: 3, count: 64 }));
        for wrong in ["0/4", "5/4", "1/0", "3", "a/b", "-1/4", ""] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
