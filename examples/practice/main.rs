//! Questions that engineers ask, each with its mechanism, its method and its answer in a file of its own.
//!
//! `cargo run --release --example practice` answers all, `-- gear_train` one. They are one program because each would link the
//! solvers anew.

use std::error::Error;
use std::io::{self, Write};

pub mod centrifuge;
pub mod fly_ball_governor;
pub mod gear_train;
pub mod grinding_spindle;
pub mod helicopter_blade;
pub mod slider_crank_press;
pub mod turbine_blade;
pub mod turntable_arm;

/// Writes the answer to a question.
pub type Answer = fn(&mut dyn Write) -> Result<(), Box<dyn Error>>;

/// All of them, by the names of their files.
pub const QUESTIONS: [(&str, Answer); 8] = [
    ("helicopter_blade", helicopter_blade::answer),
    ("fly_ball_governor", fly_ball_governor::answer),
    ("slider_crank_press", slider_crank_press::answer),
    ("centrifuge", centrifuge::answer),
    ("grinding_spindle", grinding_spindle::answer),
    ("turntable_arm", turntable_arm::answer),
    ("gear_train", gear_train::answer),
    ("turbine_blade", turbine_blade::answer),
];

/// One revolution per minute, rad/s.
pub const RPM: f64 = std::f64::consts::TAU / 60.0;

#[allow(dead_code, reason = "the tests take this file as a module")]
fn main() -> Result<(), Box<dyn Error>> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let unknown = |name: &&String| QUESTIONS.iter().all(|(known, _)| known != name);
    if let Some(name) = wanted.iter().find(unknown) {
        let names = QUESTIONS.map(|(name, _)| name).join(", ");
        return Err(format!("there is no question `{name}`, there are {names}").into());
    }
    for (name, answer) in QUESTIONS {
        if wanted.is_empty() || wanted.iter().any(|own| own == name) {
            answer(&mut io::stdout())?;
        }
    }
    Ok(())
}
