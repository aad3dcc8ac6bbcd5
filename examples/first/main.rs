//! A bar on a spinning shaft, the first example of the paper (section 6.1, table 1): how far does a tolerance of its length
//! spread its frequency, and what does it cost to know?
//!
//! `cargo run --release -p eigentol-first`

use std::error::Error;
use std::io::{self, Write};

use cpu_time::ThreadTime;
use eigentol::{Study, mechanism};

mechanism! {
    /// A uniform bar hinged on a shaft that spins at a constant rate.
    pub mechanism RotatingPendulum {
        input  omega: rad/s;
        design l = 1.0 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: 3 kg, length: l, along: -z);
        joint spin:  revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

/// Samples of the tolerance at each speed, as in the paper.
const SAMPLES: usize = 3000;

/// Writes the frequency at three speeds, its spread by exact derivatives and by samples, and how long both take.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let study = Study::new(RotatingPendulum).start(RotatingPendulum::theta, 1.0).samples(SAMPLES).threads(1);
    // Below 3.835 rad/s the bar hangs; above, it swings out.
    for speed in [2.0, 5.0, 8.0] {
        let study = study.clone().input(RotatingPendulum::omega, speed);
        writeln!(out, "{}\n{}", study.modes()?, study.first_order()?)?;
    }
    let study = |speed: f64| study.clone().input(RotatingPendulum::omega, speed);
    writeln!(out, "{}", study(5.0).monte_carlo()?)?;

    // Samples are solved one by one, as in the paper, and nothing is kept from the answers above.
    let exact = time(1000, || study(5.0).vectors(None).first_order().map(drop))?;
    let sampled = time(3, || study(5.0).vectors(None).monte_carlo().map(drop))?;
    writeln!(
        out,
        "First order takes {:.2} us, {SAMPLES} samples one by one {:.0} us: {:.0} times as long (1179 in the paper).",
        1e6 * exact,
        1e6 * sampled,
        sampled / exact
    )?;
    Ok(())
}

/// CPU time of one call, s: the mean of several.
fn time<E>(calls: u32, mut work: impl FnMut() -> Result<(), E>) -> Result<f64, E> {
    let start = ThreadTime::now();
    for _ in 0..calls {
        work()?;
    }
    Ok(start.elapsed().as_secs_f64() / f64::from(calls))
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
