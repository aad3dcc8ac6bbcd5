//! Probabilities by designs solved anew, in words and columns.

use core::fmt;

use crate::judge::{Judged, Judgement, Unjudged};
use eigentol_results::Columns;
use eigentol_results::numbers::{counted, percent, rough, short};
use eigentol_results::relevance::CHANCE;

/// A probability, as far as it can be distinguished from zero.
pub(crate) fn chance(value: f64, error: f64) -> String {
    let told = error.max(CHANCE);
    if value == 0.0 && error == 0.0 {
        "0".to_owned()
    } else if value < told {
        format!("< {}", short(told))
    } else {
        rough(value)
    }
}

/// Columns of data: the probability by designs solved anew, for rows that each have a judgement; empty where there is
/// none.
pub(crate) fn judged<R>(table: &mut Columns<'_, R>, judgement: &dyn Fn(&R) -> &Judgement) {
    let of = |row: &R| judgement(row).judged().copied();
    table.number("probability, solved anew", "", &|row| Some(of(row)?.probability.value));
    table.number("95 % from", "", &|row| Some(of(row)?.interval().lower));
    table.number("95 % to", "", &|row| Some(of(row)?.interval().upper));
    table.number("probability without response", "", &|row| Some(of(row)?.untold.value));
    table.flag("settled", &|row| Some(of(row)?.settled));
    table.whole("designs", &|row| usize::try_from(of(row)?.designs).ok());
}

impl fmt::Display for Judged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let interval = self.interval();
        let value = self.probability.value;
        write!(f, "{}", chance(value, self.unseen))?;
        if value > self.unseen {
            write!(f, " +- {}", short(0.5 * (interval.upper - interval.lower)))?;
        }
        write!(f, " over {}", counted(self.designs, "design"))?;
        if self.lines > 0 {
            write!(f, " along {}", counted(self.lines, "line"))?;
        }
        if !self.settled {
            write!(f, ", too few for the error to be known")?;
        }
        if self.untold.value > self.unseen {
            write!(f, "; designs with a probability of {} lack the response", rough(self.untold.value))?;
        }
        Ok(())
    }
}

impl fmt::Display for Unjudged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooDear { operations, budget } => write!(
                f,
                "not checked: the fewest designs take about {operations:.1e} operations; the limit is {budget:.1e}"
            ),
            Self::Discrete => write!(f, "not checked: a variable takes discrete values; sample"),
            Self::Still => write!(f, "no tolerance is declared"),
            Self::NotAsked => write!(f, "not checked"),
        }
    }
}

impl fmt::Display for Judgement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Judged(judged) => judged.fmt(f),
            Self::Open(reason) => reason.fmt(f),
        }
    }
}

/// What a judgement says of a claimed probability: `verified`, or how far it is off.
pub(crate) fn verdict(judgement: &Judgement, claimed: f64) -> String {
    let Some(judged) = judgement.judged() else {
        return "not verified".to_owned();
    };
    let (value, interval) = (judged.probability.value, judged.interval());
    if judged.confirms(claimed) {
        "verified".to_owned()
    } else if !judged.settled || (interval.lower..=interval.upper).contains(&claimed) {
        "not verified".to_owned()
    } else if claimed > 10.0 * value || value > 10.0 * claimed {
        "wrong".to_owned()
    } else {
        format!("off by {}", percent(claimed / value - 1.0))
    }
}
