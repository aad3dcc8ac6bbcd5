//! Checks each kernel against the equations of motion for every test machine: open, closed, rolling or coasting.

use eigentol_compiler::mechanics::Limits;
use eigentol_consistency::check::check;
use eigentol_consistency::subject::Subject;
use eigentol_tests::{corpus, loops, machines, wheels};

#[test]
fn kernels_of_every_machine_are_consistent() {
    let all =
        [corpus::declarations(), machines::declarations(), loops::declarations(), wheels::declarations()].concat();
    assert!(all.len() >= 38, "{}", all.len());
    for (name, declaration) in all {
        let subject =
            Subject::new(declaration, Limits::default()).unwrap_or_else(|mistakes| panic!("{name}: {mistakes:?}"));
        for seed in 1..4 {
            let outcome = check(&subject, &subject.state(seed));
            assert!(outcome.differences.is_empty(), "{name}: {:#?}", outcome.differences);
        }
    }
}
