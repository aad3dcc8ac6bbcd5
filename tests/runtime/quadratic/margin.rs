//! Margins: closed forms, and derivatives against differences.

use eigentol::second_order::{Margin, Quadratic, margin};
use eigentol::{Error, Tolerances, Vector};

use super::{close, coupled, independent, within};

fn of(model: &Quadratic, tolerances: &Tolerances, band: (f64, f64)) -> Margin {
    margin(model, tolerances, &[band]).unwrap()
}

#[test]
fn one_variable_has_closed_forms() {
    let model = Quadratic { value: 10.0, slopes: [2.0].into(), curvature: [[0.0]].into() };
    let tolerances = Tolerances::new([0.75], 3.0, None).unwrap();
    // sigma = 0.5: the band from 11 to 12 spans 2 to 4 standard deviations.
    let found = of(&model, &tolerances, (11.0, 12.0));
    close(found.sigma, 0.5, 1e-15);
    close(found.distance, 2.0, 1e-15);
    // Phi(4) - Phi(2) in 50-digit arithmetic.
    close(found.first_order, 0.022_718_460_706_346_09, 1e-13);
    close(found.corrected.value, found.first_order, 1e-14);
    let slopes = found.derivatives.unwrap();
    let (at_2, at_4) = (0.053_990_966_513_188_06, 0.000_133_830_225_764_885_37);
    close(slopes.by_low, -at_2 / 0.5, 1e-13);
    close(slopes.by_high, at_4 / 0.5, 1e-13);
    close(slopes.by_mean, (at_2 - at_4) / 0.5, 1e-13);
    close(slopes.by_sigma, (2.0 * at_2 - 4.0 * at_4) / 0.5, 1e-13);
    close(slopes.by_design[0], 2.0 * slopes.by_mean, 1e-15);
    close(slopes.by_half_width[0], slopes.by_sigma * 2.0 / 3.0, 1e-15);
    // A band that moves with the quantity.
    within(slopes.along(1.0, 0.0, 1.0, 1.0), 0.0, 1e-15);
    // Inside, below, and half-infinite bands.
    close(of(&model, &tolerances, (8.0, 10.5)).distance, -1.0, 1e-15);
    close(of(&model, &tolerances, (7.0, 9.0)).distance, 2.0, 1e-15);
    let above = of(&model, &tolerances, (11.0, f64::INFINITY));
    close(above.first_order, 0.022_750_131_948_179_21, 1e-13);
    close(above.distance, 2.0, 1e-15);
    assert_eq!(above.derivatives.unwrap().by_high, 0.0);
    let all = of(&model, &tolerances, (f64::NEG_INFINITY, f64::INFINITY));
    assert_eq!((all.first_order, all.distance), (1.0, f64::NEG_INFINITY));
    assert_eq!(all.derivatives.unwrap().by_mean, 0.0);
}

/// The model about a shifted nominal design: value and slopes change, curvature does not.
fn shifted(model: &Quadratic, k: usize, by: f64) -> Quadratic {
    let mut x = [0.0; 4];
    x[k] = by;
    Quadratic {
        value: super::value_at(model, &x),
        slopes: Vector::from_fn(4, |i| model.slopes[i] + model.curvature[i][k] * by),
        ..model.clone()
    }
}

#[test]
fn derivatives_match_differences() {
    const STEP: f64 = 1e-6;
    let (model, correlated) = coupled();
    let free = Tolerances::new(correlated.half_widths(), 3.0, None).unwrap();
    for tolerances in [correlated, free] {
        for band in [(7.5, 8.5), (5.0, 7.2), (f64::NEG_INFINITY, 6.0)] {
            let slopes = of(&model, &tolerances, band).derivatives.unwrap();
            let difference = |at: &dyn Fn(f64) -> f64| (at(STEP) - at(-STEP)) / (2.0 * STEP);
            for k in 0..4 {
                let by_design = difference(&|h| of(&shifted(&model, k, h), &tolerances, band).first_order);
                within(slopes.by_design[k], by_design, 1e-9);
                let by_half_width = difference(&|h| {
                    let mut half_widths = tolerances.half_widths().to_vec();
                    half_widths[k] += h;
                    let correlation = tolerances.correlation().cloned();
                    let moved = Tolerances::new(half_widths, tolerances.sigma_level(), correlation);
                    of(&model, &moved.unwrap(), band).first_order
                });
                within(slopes.by_half_width[k], by_half_width, 1e-9);
            }
            let by_low = difference(&|h| of(&model, &tolerances, (band.0 + h, band.1)).first_order);
            within(slopes.by_low, by_low, 1e-9);
            let by_high = difference(&|h| of(&model, &tolerances, (band.0, band.1 + h)).first_order);
            within(slopes.by_high, by_high, 1e-9);
            // A band around a running speed u, and a quantity with derivative 0.3 by this speed.
            let along = difference(&|h| {
                let moved = Quadratic { value: model.value + 0.3 * h, ..model.clone() };
                of(&moved, &tolerances, (band.0 + 0.9 * h, band.1 + 1.1 * h)).first_order
            });
            within(slopes.along(0.3, 0.0, 0.9, 1.1), along, 1e-9);
            // Everything that changes the first-order standard deviation: a common factor of the slopes.
            let sigma = of(&model, &tolerances, band).sigma;
            let by_sigma = difference(&|h| {
                let moved = Quadratic { slopes: model.slopes.map(|s| s * (1.0 + h / sigma)), ..model.clone() };
                of(&moved, &tolerances, band).first_order
            });
            within(slopes.by_sigma, by_sigma, 1e-9);
        }
    }
}

#[test]
fn a_tolerance_of_zero_still_has_a_derivative() {
    let model = Quadratic { value: 0.0, slopes: [1.0, 2.0].into(), curvature: [[0.0; 2]; 2].into() };
    let matrix = [[1.0, 0.5], [0.5, 1.0]];
    let tolerances = Tolerances::new([1.0, 0.0], 1.0, Some(matrix.into())).unwrap();
    let slopes = of(&model, &tolerances, (1.0, f64::INFINITY)).derivatives.unwrap();
    // sigma = sqrt(1 + 2 T + 4 T^2), so dsigma/dT = 1 at T = 0.
    close(slopes.by_half_width[1], slopes.by_sigma, 1e-15);
    assert!(slopes.by_half_width[1] > 0.2);
}

#[test]
fn nothing_varies() {
    let (model, _) = coupled();
    let still = independent([0.0; 4]);
    let outside = of(&model, &still, (8.0, 9.0));
    assert_eq!((outside.first_order, outside.corrected.value), (0.0, 0.0));
    assert_eq!(outside.distance, f64::INFINITY);
    assert!(outside.derivatives.is_none());
    let inside = of(&model, &still, (6.0, 9.0));
    assert_eq!((inside.first_order, inside.corrected.value), (1.0, 1.0));
    assert_eq!(inside.distance, f64::NEG_INFINITY);
    assert_eq!(of(&model, &still, (7.0, 9.0)).distance, 0.0);
    // Curvature without slope: first order sees nothing, the corrected probability does.
    let flat = Quadratic { value: 0.0, slopes: [0.0].into(), curvature: [[2.0]].into() };
    let found = of(&flat, &independent([1.0]), (-1.0, 1.0));
    assert_eq!(found.first_order, 1.0);
    close(found.corrected.value, 0.682_689_492_137_085_9, 1e-13);
    assert!(found.derivatives.is_none());
}

#[test]
fn nonsense_is_refused() {
    let (model, tolerances) = coupled();
    for band in [(f64::NAN, 1.0), (1.0, f64::NAN), (3.0, 2.0)] {
        assert!(matches!(margin(&model, &tolerances, &[band]), Err(Error::Setting { .. })));
    }
    let broken = Quadratic { value: f64::NAN, ..model.clone() };
    let found = margin(&broken, &tolerances, &[(0.0, 1.0)]);
    assert!(matches!(found, Err(Error::NotFinite { .. })));
    // Derivatives beyond the range of a double are omitted; the others remain.
    let steep = Quadratic { value: 0.0, slopes: [1e-300].into(), curvature: [[0.0]].into() };
    let found = of(&steep, &independent([1e-20]), (0.0, 1.0));
    assert_eq!(found.sigma, 1e-320);
    assert!(found.derivatives.is_none());
    close(found.first_order, 0.5, 1e-13);
}

/// Two bands at the same distance on both sides: probabilities add up, derivatives by the mean cancel.
#[test]
fn bands_add_up() {
    let model = Quadratic { value: 10.0, slopes: [2.0].into(), curvature: [[0.0]].into() };
    let tolerances = Tolerances::new([0.75], 3.0, None).unwrap();
    let bands = [(f64::NEG_INFINITY, 9.0), (11.0, f64::INFINITY)];
    let found = margin(&model, &tolerances, &bands).unwrap();
    let one = of(&model, &tolerances, bands[1]);
    close(found.distance, 2.0, 1e-15);
    close(found.first_order, 2.0 * one.first_order, 1e-13);
    close(found.corrected.value, 2.0 * one.corrected.value, 1e-13);
    let (derivatives, one) = (found.derivatives.unwrap(), one.derivatives.unwrap());
    within(derivatives.by_mean, 0.0, 1e-15);
    close(derivatives.by_sigma, 2.0 * one.by_sigma, 1e-13);
    close(derivatives.by_high, -one.by_low, 1e-13);
}
