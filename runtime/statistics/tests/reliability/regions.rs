//! Several failure regions.

use eigentol_statistics::reliability::lines::LineSettings;
use eigentol_statistics::reliability::{FormSettings, LimitState, failure_regions};

use crate::common::{below, close, estimate, limit};

/// Failure beyond 3 on one side and beyond 4 on the other; the search from the origin finds only the far region.
fn two_sided() -> impl LimitState<Error = core::convert::Infallible> {
    limit(3, |z| ((3.0 + z[0]) * (4.0 - z[0]), vec![1.0 - 2.0 * z[0], 0.0, 0.0]))
}

#[test]
fn bulges_uncover_the_other_side() {
    // Without restarts, only the bulges are tested.
    let settings = FormSettings { restarts: 0, ..FormSettings::default() };
    let found = failure_regions(&two_sided(), &settings).unwrap();
    let betas: Vec<f64> = found.design_points.iter().map(|p| p.beta).collect();
    assert_eq!(betas.len(), 2, "{betas:?}");
    assert!(found.exhausted);
    close(betas[0], 3.0, 1e-9);
    close(betas[1], 4.0, 1e-9);
    close(found.design_points[0].point[0], -3.0, 1e-9);
}

/// Regions at right angles, one farther away than the other.
#[test]
fn bulges_uncover_what_is_beside() {
    let corner = limit(2, |z| {
        let (a, b) = (3.0 - z[0], 3.5 - z[1]);
        (a * b, vec![-b, -a])
    });
    let settings = FormSettings { restarts: 0, ..FormSettings::default() };
    let found = failure_regions(&corner, &settings).unwrap();
    let betas: Vec<f64> = found.design_points.iter().map(|p| p.beta).collect();
    assert_eq!(betas.len(), 2, "{betas:?}");
    close(betas[0], 3.0, 1e-8);
    close(betas[1], 3.5, 1e-8);
}

#[test]
fn lines_sum_over_regions() {
    let limit = two_sided();
    let found = failure_regions(&limit, &FormSettings::default()).unwrap();
    let settings = LineSettings { coefficient_of_variation: 0.01, ..LineSettings::default() };
    let judged = estimate(&limit, &found.design_points, &settings);
    assert!(judged.settled);
    close(judged.probability.value, below(-3.0) + below(-4.0), 0.03);
}

/// Infinitely many design points: their number is capped, and the result says that there may be more.
#[test]
fn a_ring_of_design_points_is_capped() {
    let ring = limit(2, |z| (9.0 - z[0] * z[0] - z[1] * z[1], vec![-2.0 * z[0], -2.0 * z[1]]));
    let settings = FormSettings { regions: 3, restarts: 10, ..FormSettings::default() };
    let found = failure_regions(&ring, &settings).unwrap();
    assert_eq!(found.design_points.len(), 3);
    assert!(!found.exhausted);
    for point in &found.design_points {
        close(point.beta, 3.0, 1e-9);
    }
}

#[test]
fn the_same_seed_finds_the_same() {
    let find = || failure_regions(&two_sided(), &FormSettings::default()).unwrap();
    assert_eq!(find(), find());
}
