//! Figures 3 to 7 and 9 to 13 of the paper, as SVG in `target/paper_figures`: the equilibrium, the frequencies, and what
//! tolerances of 3, 6 and 12 % do to them, at first order and by Monte Carlo.
//!
//! `cargo run --release -p eigentol-examples --features figures --example paper_figures`

use std::error::Error;
use std::fs;
use std::path::Path;

use eigentol::{DesignVariable, FirstOrder, Input, Mechanism, MonteCarlo, Study};
use eigentol_figures::{Figure, Spreads, Style, equilibria, frequencies};

#[path = "rotating_double_pendulum.rs"]
#[allow(dead_code, unreachable_pub, clippy::duplicate_mod)]
mod rotating_double_pendulum;
#[path = "rotating_pendulum.rs"]
#[allow(dead_code, unreachable_pub, clippy::duplicate_mod)]
mod rotating_pendulum;

use rotating_double_pendulum::RotatingDoublePendulum;
use rotating_pendulum::RotatingPendulum;

/// Tolerances of the length.
const LEVELS: [f64; 3] = [0.03, 0.06, 0.12];

/// The figures with their numbers in the paper, from `samples` samples at each speed.
pub fn figures(samples: usize) -> Result<Vec<(usize, Figure)>, Box<dyn Error>> {
    let study = rotating_pendulum::study().samples(samples);
    let (speed, length) = (RotatingPendulum::omega, RotatingPendulum::l);
    let single = along(&study, (speed, length), [(0, 1), (0, 3)])?;
    let study = rotating_double_pendulum::equal().samples(samples);
    let (speed, length) = (RotatingDoublePendulum::omega, RotatingDoublePendulum::l);
    let double = along(&study, (speed, length), [(0, 3), (1, 3)])?;
    Ok((3..).zip(single).chain((9..).zip(double)).collect())
}

/// Equilibrium, frequencies, their means, and two figures of standard deviations: of a mode, at so many levels.
fn along<M: Mechanism>(
    study: &Study<M>,
    (speed, length): (Input<M>, DesignVariable<M>),
    wanted: [(usize, usize); 2],
) -> Result<[Figure; 5], Box<dyn Error>> {
    let speeds = rotating_pendulum::speeds();
    let style = Style::default().radians_per_second();
    let sweep = study.sweep(speed, &speeds)?;
    let mut found: Vec<(String, Vec<FirstOrder>, Vec<MonteCarlo>)> = Vec::new();
    // Standard deviations at first order have a pole at the critical speed: there the curve needs more points.
    let critical = study.critical_state(speed, 0.1, 8.0)?.value;
    let beside = (2..12).map(|k| 0.5_f64.powi(k));
    let beside = beside.flat_map(|share| [critical - share, critical + share]);
    let mut dense: Vec<f64> = speeds.iter().copied().chain(beside).collect();
    dense.sort_by(f64::total_cmp);
    // Samples of their own at each speed and level: shared ones would make random errors look systematic.
    let mut streams = 0..;
    for level in LEVELS {
        let study = study.clone().relative_tolerance(length, level);
        let first = study.first_order_sweep(speed, &dense)?;
        let at = |(&value, stream): (&f64, u64)| {
            let study = study.clone().input(speed, value).stream(stream);
            study.monte_carlo()
        };
        found.push((
            format!("{} %", 100.0 * level),
            first.into_iter().collect::<Result<_, _>>()?,
            (speeds.iter().zip(&mut streams).map(at)).collect::<Result<_, _>>()?,
        ));
    }
    // Standard deviations in the upper panel, means in the lower.
    let spreads = |(mode, levels): (usize, usize)| {
        let levels = found.iter().take(levels);
        let spreads =
            levels.fold(Spreads::new(speed.any(), mode), |item, level| item.under(&level.0, &level.1, &level.2));
        spreads.figure(&style)
    };
    let [mut first, mut second] = [spreads(wanted[0])?, spreads(wanted[1])?];
    let mut means = spreads((wanted[0].0, LEVELS.len()))?;
    means.title = format!("{}: mean frequencies", study.description().name);
    means.panels.remove(0);
    means.caption.retain(|line| !line.starts_with("First order"));
    if wanted[0].0 != wanted[1].0 {
        means.panels.extend(second.panels.get(1).cloned());
    }
    for (panel, mode) in means.panels.iter_mut().zip(1..) {
        panel.y.name += &format!(", mode {mode}");
    }
    first.panels.truncate(1);
    second.panels.truncate(1);
    let (equilibrium, frequency) = (equilibria(&sweep, &style)?, frequencies(&sweep, &style)?);
    Ok([equilibrium, frequency, means, first, second])
}

/// Draws the figures.
pub fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new("target/paper_figures");
    fs::create_dir_all(folder)?;
    for (number, figure) in figures(3000)? {
        let path = folder.join(format!("figure_{number:02}.svg"));
        figure.save(&path)?;
        println!("{}: {}", path.display(), figure.title);
    }
    Ok(())
}
