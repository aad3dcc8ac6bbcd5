//! Probabilities by designs solved anew, as text.

use core::fmt;

use super::margin::chance;
use crate::judge::{Judged, Judgement, Unjudged};
use eigentol_results::numbers::{counted, percent, rough, short};

impl fmt::Display for Judged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let interval = self.interval();
        let value = self.probability.value;
        write!(f, "{}", chance(value, self.unseen))?;
        if value > self.unseen {
            write!(f, " +- {}", short(0.5 * (interval.upper - interval.lower)))?;
        }
        write!(
            f,
            " over {} along {}",
            counted(self.designs, "design"),
            counted(self.lines, "line")
        )?;
        if !self.settled {
            write!(f, ", too few for the error to be known")?;
        }
        if self.untold.value > self.unseen {
            write!(
                f,
                "; designs with a probability of {} lack the response",
                rough(self.untold.value)
            )?;
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
            Self::Judged(found) => found.fmt(f),
            Self::Open(reason) => reason.fmt(f),
        }
    }
}

/// What a judgement says of a claimed probability: `verified`, or how far it is off.
pub(super) fn verdict(judgement: &Judgement, claimed: f64) -> String {
    let Some(judged) = judgement.judged() else {
        return "not verified".to_owned();
    };
    let (found, interval) = (judged.probability.value, judged.interval());
    if judged.confirms(claimed) {
        "verified".to_owned()
    } else if !judged.settled || (interval.lower..=interval.upper).contains(&claimed) {
        "not verified".to_owned()
    } else if claimed > 10.0 * found || found > 10.0 * claimed {
        "wrong".to_owned()
    } else {
        format!("off by {}", percent(claimed / found - 1.0))
    }
}
