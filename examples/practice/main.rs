//! Questions that engineers ask, each in its own file with its mechanism, method and answer.
//!
//! `cargo run --release -p eigentol-examples --example practice` answers all of them, `-- gear_train` only one. Built with
//! `--features reports`, `-- --reports DIRECTORY` also writes a report of each there. They form a single program because
//! separate ones would each have to link the solvers.

use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use eigentol::Study;
#[cfg(feature = "reports")]
use eigentol::kernels::{PictureKernels, SummaryKernels};
#[cfg(feature = "reports")]
use eigentol_report::Report;

pub mod bent_boom;
pub mod centrifuge;
pub mod fan;
pub mod flexible_arm;
pub mod flexible_blade;
pub mod fly_ball_governor;
pub mod gear_train;
pub mod grinding_spindle;
pub mod helicopter_blade;
pub mod rotor_bearings;
pub mod slider_crank_press;
pub mod turbine_blade;
pub mod turntable_arm;

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests;

/// Writes the answer to a question.
pub type Answer = fn(&mut dyn Write) -> Result<(), Box<dyn Error>>;

/// A question, identified by the name of its file.
pub struct Question {
    /// Name of the file, without the extension.
    pub name: &'static str,
    /// Writes the answer.
    pub answer: Answer,
    /// Writes a report of the mechanism to a file.
    pub report: fn(&Path) -> Result<(), Box<dyn Error>>,
}

/// All questions.
pub const QUESTIONS: [Question; 13] = [
    Question {
        name: "helicopter_blade",
        answer: helicopter_blade::answer,
        report: |path| save(&helicopter_blade::study(), path),
    },
    Question {
        name: "fly_ball_governor",
        answer: fly_ball_governor::answer,
        report: |path| save(&fly_ball_governor::study(), path),
    },
    Question {
        name: "slider_crank_press",
        answer: slider_crank_press::answer,
        report: |path| save(&slider_crank_press::study(), path),
    },
    Question { name: "centrifuge", answer: centrifuge::answer, report: |path| save(&centrifuge::study(), path) },
    Question {
        name: "grinding_spindle",
        answer: grinding_spindle::answer,
        report: |path| save(&grinding_spindle::study(grinding_spindle::WORKING), path),
    },
    Question {
        name: "turntable_arm",
        answer: turntable_arm::answer,
        report: |path| save(&turntable_arm::study(turntable_arm::WORKING), path),
    },
    Question { name: "gear_train", answer: gear_train::answer, report: |path| save(&gear_train::study(), path) },
    Question {
        name: "turbine_blade",
        answer: turbine_blade::answer,
        report: |path| save(&turbine_blade::study(), path),
    },
    Question {
        name: "rotor_bearings",
        answer: rotor_bearings::answer,
        report: |path| save(&rotor_bearings::study(), path),
    },
    Question { name: "fan", answer: fan::answer, report: |path| save(&fan::study(), path) },
    Question {
        name: "flexible_blade",
        answer: flexible_blade::answer,
        report: |path| save(&flexible_blade::study(), path),
    },
    Question { name: "flexible_arm", answer: flexible_arm::answer, report: |path| save(&flexible_arm::study(), path) },
    Question {
        name: "bent_boom",
        answer: bent_boom::answer,
        report: |path| save(&bent_boom::study(bent_boom::WORKING), path),
    },
];

/// One revolution per minute, rad/s.
pub const RPM: f64 = std::f64::consts::TAU / 60.0;

#[cfg(feature = "reports")]
fn save<M>(study: &Study<M>, path: &Path) -> Result<(), Box<dyn Error>>
where
    M: SummaryKernels + PictureKernels + Clone,
{
    Ok(Report::new(study).samples(1000).save(path)?)
}

#[cfg(not(feature = "reports"))]
fn save<M>(_: &Study<M>, _: &Path) -> Result<(), Box<dyn Error>> {
    Err("reports need a program built with `--features reports`".into())
}

#[allow(dead_code, reason = "the tests take this file as a module")]
fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (mut wanted, mut reports) = (Vec::new(), None);
    while let Some(argument) = arguments.next() {
        if argument == "--reports" {
            let directory = arguments.next().ok_or("--reports needs a directory")?;
            reports = Some(PathBuf::from(directory));
        } else {
            wanted.push(argument);
        }
    }
    let unknown = |name: &&String| QUESTIONS.iter().all(|question| question.name != **name);
    if let Some(name) = wanted.iter().find(unknown) {
        let names = QUESTIONS.map(|questions| questions.name).join(", ");
        return Err(format!("there is no question `{name}`, there are {names}").into());
    }
    if let Some(directory) = &reports {
        std::fs::create_dir_all(directory)?;
    }
    for question in QUESTIONS {
        if !wanted.is_empty() && wanted.iter().all(|x| x != question.name) {
            continue;
        }
        (question.answer)(&mut io::stdout())?;
        if let Some(directory) = &reports {
            let path = directory.join(question.name).with_extension("html");
            (question.report)(&path)?;
            println!("{}\n", path.display());
        }
    }
    Ok(())
}
