//! What constraints exert does no work on motions that they allow: the column of a reaction is the row of its constraint.

use eigentol::{Mechanism, Role};
use eigentol_compiler::program;
use eigentol_tests::corpus::Visitor;
use eigentol_tests::{loops, wheels};

use super::Numbers;

#[derive(Default)]
struct Work {
    positions: usize,
    velocities: usize,
}

impl Visitor for Work {
    fn visit<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        &mut self,
        name: &'static str,
        declaration: &'static str,
        machine: M,
    ) where
        M: Mechanism<N, U, P, O> + Copy,
    {
        let program = program(declaration.parse().expect("tokens")).expect("a right declaration");
        let mut numbers = Numbers::new(7);
        let role = |i: usize| M::DESCRIPTION.coordinates[i].role;
        for _ in 0..3 {
            let at = numbers.arguments(&machine, &[("q", N), ("u", U), ("b", P)]);
            let at: Vec<&[f64]> = at.iter().map(Vec::as_slice).collect();
            let linear = program.evaluate("linear", &at).expect("in the contract");
            let damping = |i: usize, j: usize| linear[1][i * N + j];
            let stiffness = |i: usize, j: usize| linear[2][i * N + j];
            for row in 0..N {
                let by_rate = |j: usize| match (role(row), role(j)) {
                    (Role::PositionReaction, Role::Position) => stiffness(row, j),
                    (Role::VelocityReaction, Role::Position) => damping(row, j),
                    (Role::VelocityReaction, Role::Speed) => stiffness(row, j),
                    _ => 0.0,
                };
                match role(row) {
                    Role::PositionReaction => self.positions += 1,
                    Role::VelocityReaction => self.velocities += 1,
                    _ => continue,
                }
                let motions = (0..N).filter(|&j| matches!(role(j), Role::Position | Role::Speed));
                let most = motions
                    .clone()
                    .fold(0.0_f64, |most, j| most.max(by_rate(j).abs()));
                assert!(most > 0.0, "{name}: nothing moves constraint {row}");
                for j in motions {
                    let (held, demanded) = (stiffness(j, row), by_rate(j));
                    assert!(
                        (held - demanded).abs() <= 1e-12 * most,
                        "{name}: reaction {row} on {j} is {held}, its constraint changes by {demanded}"
                    );
                }
            }
        }
    }
}

#[test]
fn reactions_do_no_work() {
    let mut work = Work::default();
    loops::visit(&mut work);
    wheels::visit(&mut work);
    assert!(work.positions >= 40 && work.velocities >= 20);
}
