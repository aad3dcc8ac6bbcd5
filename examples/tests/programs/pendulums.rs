//! The bars compared with the closed form of one, with samples, and with the paper.

use super::{first, near, printed, shows};
use super::{rotating_double_pendulum, rotating_pendulum};
use rotating_double_pendulum::{IndependentBars, RotatingDoublePendulum};
use rotating_pendulum::RotatingPendulum;

/// The square of the critical speed of a 1 m bar: 3 g / 2.
const W: f64 = 1.5 * 9.81;

#[test]
fn the_programs_print_the_speeds_and_ratios_of_the_paper_beside_their_own() {
    let single = printed(rotating_pendulum::run);
    shows(&single, &["2.71247", "3.83601", "2.712", "3.835", "1179"]);
    let double = printed(rotating_double_pendulum::run);
    shows(&double, &["1.89513", "2.68011", "1.895", "2.679", "1414"]);
    shows(&double, &["IndependentBars", "share of m2", "one by one", "in vectors"]);
}

/// At 5 rad/s the frequency follows from the closed form, with its slope by the length.
#[test]
fn the_first_page_prints_frequency_and_spread() {
    let page = printed(first::run);
    let (square, cosine) = (25.0, W / 25.0);
    let frequency = f64::sqrt(square - W * cosine);
    let sigma = W * cosine / frequency * 0.01;
    shows(&page, &[&format!("{frequency:.5}"), &format!("{sigma:.5}")]);
    shows(&page, &["3000 stable", "1179 in the paper"]);
}

#[test]
fn the_bar_follows_its_closed_form() {
    let study = rotating_pendulum::study().samples(400).seed(5);
    let speeds = rotating_pendulum::speeds();
    let first = study.first_order_sweep(RotatingPendulum::omega, &speeds).unwrap();
    for (&speed, first) in speeds.iter().zip(first) {
        let study = study.clone().input(RotatingPendulum::omega, speed);
        let square = speed * speed;
        let (theta, lambda, slope) = if square < W {
            (0.0, W - square, -W)
        } else {
            let cosine = W / square;
            (cosine.acos(), square - W * cosine, 2.0 * W * cosine)
        };
        let angle = study.equilibrium().unwrap().coordinates[0];
        assert!((angle - theta).abs() < 1e-9, "{angle} at {speed}");
        let frequency = lambda.sqrt();
        // sigma_l is a third of the tolerance.
        let sigma = 0.01 * slope.abs() / (2.0 * frequency);
        let first = first.unwrap();
        let found = first.modes[0].frequency().unwrap();
        near("frequency", found.mean, frequency, 1e-9);
        near("sigma", found.sigma, sigma, 1e-9);
        let run = study.monte_carlo().unwrap();
        assert_eq!(run.counts.stable, 400, "{speed}");
        if first.distance_to_critical > 20.0 {
            let sampled = run.modes[0].as_ref().unwrap();
            assert!((sampled.mean - frequency).abs() < 5.0 * sigma / 400f64.sqrt());
            near("sampled sigma", sampled.sigma.unwrap(), sigma, 5.0 / 800f64.sqrt());
        }
    }
    let near_critical = study.input(RotatingPendulum::omega, 3.8).first_order();
    assert!(!near_critical.unwrap().trusted());
}

/// Both lengths together are the one length of equal bars; no frequency changes if all masses change alike.
#[test]
fn four_dimensions_share_the_variance_as_two_equal_bars_say() {
    for speed in [1.5, 2.65, 5.0] {
        let equal = rotating_double_pendulum::equal().input(RotatingDoublePendulum::omega, speed);
        let bars = rotating_double_pendulum::independent().input(IndependentBars::omega, speed);
        let one = equal.sensitivities().unwrap().modes;
        let four = bars.sensitivities().unwrap().modes;
        let spreads = bars.first_order().unwrap().modes;
        for ((one, four), spread) in one.iter().zip(&four).zip(&spreads) {
            let one = &one.frequency().unwrap().by_design;
            let [l1, l2, m1, m2] = four.frequency().unwrap().by_design[..] else { panic!("four dimensions") };
            near("by both lengths", l1 + l2, one[1], 1e-9);
            assert!((m1 + m2).abs() < 1e-9 * m1.abs(), "{m1} {m2}");
            // Three standard deviations are 3 % of 1 m and of 3 kg.
            let parts = [l1, l2, 3.0 * m1, 3.0 * m2].map(|part| (0.01 * part).powi(2));
            let variance: f64 = parts.iter().sum();
            near("sigma", spread.frequency().unwrap().sigma, variance.sqrt(), 1e-9);
            for (share, part) in spread.variance_shares().iter().zip(parts) {
                near("share", *share, part / variance, 1e-9);
            }
        }
    }
}
