//! Equilibria and modes along an input.

use std::ops::ControlFlow;

use clap::Args;
use eigentol::sweep::SweepPoint;
use eigentol::sweep::sweep_table;

use crate::diagnostics;
use crate::failure::Failure;
use crate::output::Output;
use crate::point::Point;
use crate::progress;
use crate::sweep::{self, Points};
use crate::verdict::Verdict;

/// Equilibria and modes along an input, and the critical values on the way
#[derive(Args, Debug)]
pub(crate) struct Follow {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    sweep: sweep::Sweep,
    #[command(flatten)]
    points: Points,
    #[command(flatten)]
    output: Output,
}

impl Follow {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let question = self.point.question()?;
        let range = self.sweep.range(&question)?;
        let values = self.points.values(&range, &question, !self.output.streams())?;
        let bar = progress::bar("values", Some(values.len() as u64));
        let study = progress::watched(question.study, &bar);
        let (d, inputs, input) = (study.description(), study.input_values(), range.input);
        // The maximum number unless one motion ends and another begins.
        let motions = 2 * d.coordinates.len();
        let make = |points: &[SweepPoint]| sweep_table(d, inputs, input.any(), points, motions);
        let mut rows = self.output.rows(("sweep", "sweep"), make)?;
        let (mut points, mut done, mut solved, mut labels) = (Vec::new(), 0, 0, 0);
        let mut written = Ok(());
        let mut sweep = study.sweep_each(input, &values, |point| {
            done += 1;
            if let Ok(modes) = &point.modes {
                solved += 1;
                labels = modes.modes.iter().fold(labels, |most, mode| most.max(mode.label + 1));
            }
            match &mut rows {
                Some(rows) => written = rows.add(point.clone()),
                None => points.push(point.clone()),
            }
            match written {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            }
        })?;
        written?;
        drop(bar);
        match rows {
            Some(rows) => {
                rows.finish()?;
                let searched = sweep.searched.iter();
                for sentence in searched.flat_map(|x| x.sentences(d, input.any())) {
                    diagnostics::note(&sentence);
                }
                if labels > motions {
                    let more = labels - motions;
                    diagnostics::note(&format!("{more} motions are left out: there are columns for {motions}"));
                }
            }
            None => {
                sweep.points = points;
                self.output.show(&sweep)?;
            }
        }
        if done < values.len() {
            return Ok(Verdict::stopped(done, values.len(), "values"));
        }
        match solved {
            0 => Ok(Verdict::No("no value of the range has modes".to_owned())),
            _ => Ok(Verdict::Yes),
        }
    }
}
