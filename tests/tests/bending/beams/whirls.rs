//! The sense in which spinning beams whirl.

use crate::beams::compared::study;

/// Frequencies and whirl ratios of the lowest pair of a spinning round cantilever.
fn lowest_pair(speed: f64) -> [(f64, f64); 2] {
    let study = study(
        &format!(
            "mechanism Shaft {{
                body shaft: beam(length: 1 m, along: x, up: z, section: tube(outer: 80 mm, inner: 40 mm),
                    density: 7850 kg/m^3, modulus: 2 GPa, bending: 4) spinning at {speed} rad/s;
                joint clamp: fixed from ground to shaft;
            }}"
        ),
        None,
    );
    let modes = study.modes().expect("modes");
    let whirls = study.whirls().expect("whirls");
    let mut pairs = (0..2).map(|k| {
        let whirl = whirls[k].expect("it spins");
        (modes.modes[k].s.im.abs(), whirl.ratio.expect("a sense"))
    });
    [pairs.next().expect("a mode"), pairs.next().expect("a mode")]
}

#[test]
fn the_faster_whirl_of_a_spinning_beam_goes_with_the_spin() {
    let [(still, _), _] = {
        let [a, b] = lowest_pair(1e-3);
        assert!((a.0 - b.0).abs() < 1e-6 * a.0);
        [a, b]
    };
    for speed in [300.0, -300.0] {
        let [(slow, backward), (fast, forward)] = lowest_pair(speed);
        // Gyroscopic moments split the pair about its frequency at rest.
        assert!(slow < 0.999 * still && fast > 1.001 * still, "{slow} {still} {fast}");
        assert!((slow * fast / still.powi(2) - 1.0).abs() < 1e-3);
        assert!((backward + 1.0).abs() < 1e-9, "{backward}");
        assert!((forward - 1.0).abs() < 1e-9, "{forward}");
    }
}
