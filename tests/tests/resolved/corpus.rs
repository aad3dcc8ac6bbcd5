//! Every machine of the corpus: derivatives of undamped modes by the product and by solving again.

use eigentol::equilibrium::Equilibrium;
use eigentol::modes::modes;
use eigentol::sensitivity::sensitivities;
use eigentol::Mechanism;
use eigentol_tests::resolved::{Comparison, State, every_machine};

#[derive(Default)]
struct UndampedGradients {
    points: usize,
}

impl Comparison for UndampedGradients {
    fn compare<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        &mut self,
        what: &str,
        machine: &M,
        at: &Equilibrium<N, U, P>,
        state: &State,
    ) where
        M: Mechanism<N, U, P, O> + Copy,
    {
        self.points += 1;
        println!("{what}: {:?} {:?}", at.coordinates, at.stability);
        let shifts = state.equilibrium();
        for q in &shifts { println!("   dq {:?}", q.gradient); }
        println!("   s {:?}", state.eigenvalues());
        let g = state.general_modes();
        println!("   zeta {:?}", g.iter().map(|m| m.as_ref().map(|m| m.damping_ratio.value)).collect::<Vec<_>>());
        let found = modes(at);
        let Ok(found) = found else { println!("  {:?}", found.err()); return };
        let all = sensitivities(machine, at, &found).expect("s");
        let resolved = state.undamped_modes();
        let mut worst = 0.0f64;
        for r in 0..N {
            let Some(mode) = &resolved[r] else { println!("   repeated {r}"); continue; };
            let own = &all.modes[r];
            let expected = &mode.lambda.gradient;
            let scale = expected.iter().fold(mode.lambda.value.abs(), |s, x| s.max(x.abs()));
            worst = worst.max((mode.lambda.value - found.modes[r].lambda).abs() / mode.lambda.value.abs());
            for (one, other) in own.lambda_by_design.iter().chain(&own.lambda_by_input).zip(expected) {
                worst = worst.max((one-other).abs() / other.abs().max(1e-3 * scale));
            }
        }
        println!("   worst {worst:e}");
    }
}

#[test]
fn first_derivatives_of_undamped_modes() {
    let mut gradients = UndampedGradients::default();
    every_machine(&mut gradients);
}
