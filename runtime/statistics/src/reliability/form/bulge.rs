//! Bulges that push the limit away from known design points (Der Kiureghian and Dakessian 1998, *Multiple design points
//! in first and second-order reliability*, Structural Safety 20, equations 12 to 16).

use super::design_point::DesignPoint;
use crate::reliability::limit_state::LimitValue;
use crate::reliability::vector::{add_scaled, dot};

/// Radius of a bulge as a fraction of `beta`.
const RADIUS: f64 = 1.1;
/// Shift of the limit along its normal due to a bulge, as a fraction of `beta`.
const SHIFT: f64 = 0.75;

/// `height (1 - |z - centre|^2 / radius^2)^2` inside the radius.
pub(super) struct Bulge {
    centre: Vec<f64>,
    height: f64,
    square_of_radius: f64,
}

impl Bulge {
    /// The bulge at a design point, unless that is the origin. If the origin fails, the bulge is negative.
    pub(super) fn over(design_point: &DesignPoint) -> Option<Self> {
        if design_point.beta == 0.0 {
            return None;
        }
        let relative_height = (1.0 - (SHIFT / RADIUS).powi(2)).powi(-2);
        Some(Self {
            centre: design_point.point.clone(),
            height: relative_height * SHIFT * design_point.beta * design_point.gradient_norm,
            square_of_radius: (RADIUS * design_point.beta).powi(2),
        })
    }

    pub(super) fn add_to(&self, limit: &mut LimitValue, z: &[f64]) {
        let away = add_scaled(z, -1.0, &self.centre);
        let depth = 1.0 - dot(&away, &away) / self.square_of_radius;
        if depth <= 0.0 {
            return;
        }
        limit.value += self.height * depth * depth;
        let slope = -4.0 * self.height * depth / self.square_of_radius;
        for (gradient, away) in limit.gradient.iter_mut().zip(away) {
            *gradient += slope * away;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reliability::closest::Residuals;

    #[test]
    fn gradients_are_derivatives() {
        for beta in [2.0, -3.0] {
            let bulge = Bulge::over(&DesignPoint {
                point: vec![0.6 * beta, 0.8 * beta],
                beta,
                direction: vec![0.6, 0.8],
                gradient_norm: 5.0,
                residuals: Residuals { limit: 0.0, direction: 0.0 },
            })
            .unwrap();
            let added = |z: &[f64]| {
                let mut limit = LimitValue { value: 0.0, gradient: vec![0.0; 2] };
                bulge.add_to(&mut limit, z);
                limit
            };
            let z = [0.5 * beta, 0.3 * beta];
            for i in 0..2 {
                let (mut ahead, mut behind) = (z, z);
                ahead[i] += 1e-5;
                behind[i] -= 1e-5;
                let difference = (added(&ahead).value - added(&behind).value) / 2e-5;
                assert!((added(&z).gradient[i] - difference).abs() < 1e-7);
            }
            // A shifted linear limit is zero on the normal at `(1 + SHIFT) beta`: there, as at this mirrored point, the
            // bulge adds so much.
            let beyond = [0.6 * beta * (1.0 - SHIFT), 0.8 * beta * (1.0 - SHIFT)];
            assert!((added(&beyond).value - 5.0 * SHIFT * beta).abs() < 1e-12);
            assert_eq!(added(&[-0.2 * beta, -0.2 * beta]).value, 0.0);
        }
    }
}
