//! The same mechanism as an open chain and as a cut loop: in random trees one joint is replaced by a `free` joint between the
//! same frames, and declared once more as a joint that is `cut`. Freedom, residual, matrices, and derivatives by inputs and
//! design variables agree at random states that are assembled, whatever the reactions are.

#[path = "cut_loops/pair.rs"]
mod pair;
#[path = "cut_loops/pose.rs"]
mod pose;

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

use eigentol_tests::random::on_plans;

use pair::Pair;

/// Largest error relative to the size of the terms.
const TOLERANCE: f64 = 1e-12;

fn agrees_on(trees: u32) {
    let compared = Cell::new(0);
    let words = RefCell::new(BTreeSet::new());
    on_plans(trees, |plan| {
        for placed in [true, false] {
            let Some(pair) = Pair::new(plan, placed) else {
                continue;
            };
            pair.compare(plan.seed)
                .unwrap_or_else(|report| panic!("{report}\n{pair}"));
            compared.set(compared.get() + 1);
            words.borrow_mut().insert(pair.word());
        }
    });
    let (compared, words) = (compared.get(), words.take());
    assert!(compared >= trees, "{compared} pairs compared");
    assert_eq!(words.len(), 7, "every kind that can be cut: {words:?}");
}

#[test]
fn a_cut_loop_is_the_open_chain() {
    agrees_on(40);
}

#[test]
#[ignore = "takes a minute"]
fn many_cut_loops_are_the_open_chains() {
    agrees_on(240);
}
