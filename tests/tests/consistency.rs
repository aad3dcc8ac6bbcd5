//! Checks each kernel against the equations of motion for every test machine: open, closed, rolling or coasting.

use eigentol::Mechanism;
use eigentol_compiler::mechanics::Limits;
use eigentol_consistency::check::check;
use eigentol_consistency::subject::Subject;
use eigentol_tests::corpus::{self, Visitor};
use eigentol_tests::{loops, machines, wheels};

struct Names(Vec<(&'static str, &'static str)>);

impl Visitor for Names {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, declaration: &'static str, _: M) {
        self.0.push((name, declaration));
    }
}

#[test]
fn kernels_of_every_machine_are_consistent() {
    let mut all = Names(Vec::new());
    for visit in [corpus::visit, machines::visit, loops::visit, wheels::visit] {
        visit(&mut all);
    }
    assert!(all.0.len() >= 38, "{}", all.0.len());
    for (name, declaration) in all.0 {
        let subject = Subject::new(declaration, Limits::default())
            .unwrap_or_else(|mistakes| panic!("{name}: {mistakes:?}"));
        for seed in 1..4 {
            let outcome = check(&subject, &subject.state(seed));
            assert!(
                outcome.differences.is_empty(),
                "{name}: {:#?}",
                outcome.differences
            );
        }
    }
}
