//! Modes that independent blades mix: seen from a blade, they vibrate at one frequency.
//!
//! In multiblade coordinates a change of one blade alone is periodic in the angle of the drive, and to first order its mean
//! acts, a share of that of all blades. This holds unless the eigenvalues of two modes differ by a multiple of the speed,
//! `s_j = s_k + i h W`: then its harmonics couple them, as modes that do not reach the hub, or all where the hub hardly
//! moves. The spread of each is that of single blades there, not of their mean.

use crate::kernels::Kernels;
use crate::modes::ring_speeds;
use crate::sensitivity::Sensitivities;
use crate::tolerance::Tolerances;
use crate::{Complex, Equilibrium, Modes};

/// Modes whose distance is less than so many standard deviations of what moves a blade are mixed.
const MIXED: f64 = 4.5;

/// For each mode, those with which independent blades mix it.
pub(super) fn mixed(
    mechanism: &dyn Kernels,
    at: &Equilibrium,
    modes: &Modes,
    slopes: &Sensitivities,
    tolerances: &Tolerances,
) -> Vec<Vec<usize>> {
    let description = &modes.description;
    let mut mixed = vec![Vec::new(); modes.modes.len()];
    let speeds = if description.rings.is_empty() { Vec::new() } else { ring_speeds(mechanism, at) };
    let rings = description.rings.iter().zip(&speeds).filter(|(ring, _)| ring.patterns);
    for (ring, speed) in rings {
        let reach = |mode: usize| -> f64 {
            let Some(s) = slopes.modes[mode].s() else { return 0.0 };
            let variance: f64 = ring
                .design
                .chunks_exact(ring.members)
                .map(|of| {
                    let all: Complex = of.iter().map(|&k| s.by_design[k]).sum();
                    // What moves one blade against another.
                    let mut contrast = vec![0.0; description.design.len()];
                    (contrast[of[0]], contrast[of[1]]) = (all.norm(), -all.norm());
                    tolerances.sigma(&contrast).powi(2) / 2.0
                })
                .sum();
            variance.sqrt()
        };
        let reaches: Vec<f64> = (0..modes.modes.len()).map(reach).collect();
        for (j, one) in modes.modes.iter().enumerate().filter(|(j, _)| reaches[*j] > 0.0) {
            for (k, other) in modes.modes.iter().enumerate().filter(|(k, _)| reaches[*k] > 0.0) {
                let near = |s: Complex, itself: bool| {
                    let turns = if *speed == 0.0 { 0.0 } else { ((one.s - s).im / speed).round() };
                    let gap = (one.s - s - Complex::new(0.0, turns * speed)).norm();
                    let all = turns.abs() <= (ring.members - 1) as f64;
                    all && !(itself && turns == 0.0) && gap <= MIXED * (reaches[j] + reaches[k])
                };
                if near(other.s, j == k) || near(other.s.conj(), false) {
                    mixed[j].push(k);
                }
            }
        }
    }
    mixed
}
