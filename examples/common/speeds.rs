//! The speeds of a sweep: evenly spaced over the range, and closer where the stiffness vanishes.

/// Distances from the critical speed, relative to it, farthest first.
const CLOSE: [f64; 4] = [0.02, 0.01, 0.004, 0.001];

/// `count` ascending speeds from `low` to `high`: up to four pairs close to `critical`, the others evenly spaced.
pub fn around(count: usize, (low, high): (f64, f64), critical: f64) -> Vec<f64> {
    let pairs = (count / 5).min(CLOSE.len());
    let even = count - 2 * pairs;
    let step = (high - low) / (even.max(2) - 1) as f64;
    let mut speeds: Vec<f64> = (0..even)
        .map(|k| (low + step * k as f64).min(high))
        .collect();
    for distance in &CLOSE[..pairs] {
        speeds.extend([critical * (1.0 - distance), critical * (1.0 + distance)]);
    }
    speeds.sort_by(f64::total_cmp);
    speeds
}

/// Speeds for a smooth curve: many, and increasingly dense towards `critical`, which is itself excluded.
pub fn dense((low, high): (f64, f64), critical: f64) -> Vec<f64> {
    let even = (0..=320).map(|k| low + (high - low) * f64::from(k) / 320.0);
    let close = (0..40).flat_map(|k| {
        let distance = 0.1 * 0.75f64.powi(k);
        [critical * (1.0 - distance), critical * (1.0 + distance)]
    });
    let mut speeds: Vec<f64> = even.chain(close).collect();
    speeds.retain(|&speed| speed != critical);
    speeds.sort_by(f64::total_cmp);
    speeds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_kept_and_speeds_ascend() {
        for count in [1, 2, 3, 5, 12, 89, 200] {
            let speeds = around(count, (0.0, 8.0), 3.836);
            assert_eq!(speeds.len(), count);
            assert!(speeds.is_sorted());
            assert_eq!(speeds[0], 0.0);
            assert!(count == 1 || speeds[count - 1] == 8.0);
        }
        let speeds = around(89, (0.0, 8.0), 3.836);
        assert!(
            speeds
                .iter()
                .any(|speed| (speed / 3.836 - 1.0).abs() < 0.002)
        );
        assert!(speeds.iter().any(|speed| (speed - 4.2).abs() < 1e-12));
    }

    #[test]
    fn curves_avoid_the_critical_speed() {
        let speeds = dense((0.0, 8.0), 4.0);
        assert!(speeds.is_sorted() && !speeds.contains(&4.0));
    }
}
