//! Campbell diagrams.

use std::ops::ControlFlow;

use clap::Args;
use eigentol::campbell::CampbellPoint;
use eigentol::campbell::campbell_table;
use eigentol_figures as figures;

use crate::advice;
use crate::diagnostics;
use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::{Point, whole};
use crate::progress;
use crate::sweep::{Orders, Points, Sweep};
use crate::verdict::Verdict;

/// Modes along an input with their spread, critical values, crossings of engine orders and onsets of flutter
#[derive(Args, Debug)]
pub(crate) struct Campbell {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    sweep: Sweep,
    #[command(flatten)]
    points: Points,
    #[command(flatten)]
    orders: Orders,
    /// How many modes texts and figures show [default: those that the orders reach and the coordinates of beams resolve]
    #[arg(long, value_name = "COUNT", value_parser = whole)]
    modes: Option<usize>,
    /// List all crossings, also of modes that no unbalance excites
    #[arg(long)]
    all_crossings: bool,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    picture: Picture,
}

impl Campbell {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        self.picture.check(&self.output)?;
        let mut question = self.point.question()?;
        let range = self.sweep.range(&question)?;
        let values = self.points.values(&range, &question, !self.output.streams())?;
        let orders = self.orders.or_first(Some(&range), &question)?;
        let bar = progress::bar("values", Some(values.len() as u64));
        question.study = progress::watched(question.study, &bar);
        let study = &question.study;
        let (d, inputs, input) = (study.description(), study.input_values(), range.input);
        let make = |points: &[CampbellPoint]| campbell_table(d, inputs, input.any(), points);
        let kind = "Campbell diagram";
        let mut rows = self.output.rows((kind, kind), make)?;
        // Rows written as they arrive need not be kept.
        let keep = rows.is_none() || self.picture.is_wanted();
        let (mut points, mut done, mut solved) = (Vec::new(), 0, 0);
        let mut written = Ok(());
        let campbell = study.campbell_each(input, &values, &orders, |point| {
            done += 1;
            solved += usize::from(point.modes.is_ok());
            if keep {
                points.push(point.clone());
            }
            if let Some(rows) = &mut rows {
                written = rows.add(point);
            }
            match written {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            }
        })?;
        written?;
        drop(bar);
        let mut found = campbell;
        found.points = points;
        if self.all_crossings {
            found = found.with_all_crossings();
        }
        if let Some(count) = self.modes {
            found = found.with_modes(count);
        }
        let modes = found.labels().last().map_or(0, |last| last + 1);
        let style = self.picture.style(&question, modes)?;
        self.picture.draw(|| figures::campbell(&found, &style))?;
        match rows {
            Some(rows) => {
                rows.finish()?;
                let searched = found.searched.iter();
                let searched = searched.flat_map(|x| x.sentences(d, input.any()));
                let notes = found.left_out().into_iter().chain(searched);
                for sentence in notes.chain(advice::on_beams(modes)) {
                    diagnostics::note(&sentence);
                }
            }
            None => {
                let mut answer = self.output.answer();
                answer.add(&found)?;
                answer.rests_on(found.shown().labels().last().map_or(0, |last| last + 1));
                self.output.write(&answer)?;
            }
        }
        if done < values.len() {
            return Ok(Verdict::stopped(done, values.len(), "values"));
        }
        if solved > 0 {
            return Ok(Verdict::Yes);
        }
        Ok(Verdict::No("no value of the range has modes".to_owned()))
    }
}
