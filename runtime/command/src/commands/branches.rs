//! Branches of equilibria.

use clap::Args;
use eigentol::branches::BranchEnd;
use eigentol::branches::branch_table;
use eigentol_figures as figures;
use eigentol_tables::Table;

use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::Point;
use crate::progress;
use crate::sweep::Sweep;
use crate::verdict::Verdict;

/// All branches of equilibria along an input, with their limit points, branch points and stability
#[derive(Args, Debug)]
pub(crate) struct Branches {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    sweep: Sweep,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    picture: Picture,
}

impl Branches {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        self.picture.check(&self.output)?;
        let mut question = self.point.question()?;
        let range = self.sweep.range(&question)?;
        let bar = progress::bar("points of branches", None);
        question.study = progress::watched(question.study, &bar);
        let study = &question.study;
        let settings = study.continuation(range.input, range.low, range.high)?;
        let make = |all: &[Table]| all.first().cloned().unwrap_or_default();
        let mut rows = self.output.rows(("branches", "branches"), make)?;
        let (mut number, mut written) = (0, Ok(()));
        let branches = study.branches_each(&settings, None, |branch| {
            number += 1;
            if let (Some(rows), Ok(())) = (&mut rows, &written) {
                written = rows.add(branch_table(number, branch)).and_then(|()| rows.write());
            }
        })?;
        written?;
        drop(bar);
        let style = self.picture.plain_style(&question);
        self.picture.draw(|| figures::branches(&branches, &style))?;
        match rows {
            Some(rows) => rows.finish()?,
            None => {
                self.output.show(&branches)?;
            }
        }
        let ends = branches.branches.iter().flat_map(|branch| &branch.ends);
        if ends.into_iter().any(|end| *end == BranchEnd::Stopped) {
            let points: usize = branches.branches.iter().map(|branch| branch.points.len()).sum();
            return Ok(Verdict::Stopped(format!("after {points} points")));
        }
        if branches.stable().next().is_some() {
            return Ok(Verdict::Yes);
        }
        Ok(Verdict::No("no branch has a stable part".to_owned()))
    }
}
