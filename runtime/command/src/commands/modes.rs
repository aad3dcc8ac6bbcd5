//! Equilibrium and natural modes.

use std::path::PathBuf;

use clap::Args;
use eigentol_figures::{deflections, mode_shapes};

use crate::destination::Target;
use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::Point;
use crate::verdict::Verdict;

/// Modes in a figure of deflection curves.
const DRAWN: usize = 6;
/// Their displacement, as a fraction of the size, so small that nothing but the mode is seen.
const SMALL: f64 = 1e-4;

/// Equilibrium and natural modes at one operating point
#[derive(Args, Debug)]
pub(crate) struct Modes {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    picture: Picture,
    /// Write the equilibrium, the modes and the forced vibrations in motion into a page for a browser: `modes.html`
    #[arg(long, value_name = "FILE")]
    motion: Option<PathBuf>,
}

impl Modes {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        self.picture.check(&self.output)?;
        let question = self.point.question()?;
        question.note_unset();
        let modes = question.study.modes()?;
        let mut answer = self.output.answer();
        answer.add(&modes.with_whirls(question.study.whirls()?))?;
        answer.add(&question.study.equilibrium()?)?;
        let style = self.picture.style(&question, modes.modes.len())?;
        if self.picture.is_wanted() {
            let study = &question.study;
            let scene = study.picture()?;
            let moving = modes.foremost(DRAWN).into_iter().filter_map(|mode| study.mode_pictures(mode, 4, SMALL).ok());
            let moving: Vec<_> = moving.collect();
            self.picture.draw(|| {
                if scene.beams.is_empty() {
                    mode_shapes(&modes, &style)
                } else {
                    deflections(&scene, &modes, &moving, &style)
                }
            })?;
        }
        if let Some(path) = &self.motion {
            let page = eigentol_report::motion(&question.study, &style)?;
            Target::of(path).write(page.as_bytes()).map_err(|source| Failure::write(path, source))?;
        }
        self.output.write(&answer)?;
        Ok(Verdict::of(&question.study)?)
    }
}
