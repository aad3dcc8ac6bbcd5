//! Compares a mechanism as an open chain with the same mechanism as a cut loop. In random trees one joint is replaced
//! by a `free` joint between the same frames, and is declared again as a `cut` joint or as equivalent point
//! constraints. Freedom, residual, matrices, and derivatives by inputs and design variables agree at random assembled
//! states for any reactions.

mod double;
mod pair;
mod pose;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::panic::resume_unwind;
use std::thread;

use eigentol_oracle::model::Word;
use eigentol_oracle::random::{Plan, on_plans};

use double::Closing;
use pair::Pair;
use pose::Embedding;

/// Largest error relative to the size of the terms.
const TOLERANCE: f64 = 1e-12;

const CLOSINGS: [Closing; 4] =
    [Closing::new(true, false), Closing::new(false, false), Closing::new(true, true), Closing::new(false, true)];

/// How often each kind of joint was cut, by a joint and by constraints.
type Seen = BTreeMap<(bool, Word), u32>;

/// Whether constraints close the loop, and the kind of the joint; `None` if there is no such pair.
fn compared(plan: Plan, closing: Closing) -> Option<(bool, Word)> {
    let pair = Pair::new(plan, closing)?;
    pair.compare(plan.seed).unwrap_or_else(|report| panic!("{report}\n{pair}"));
    Some((closing.by_constraints, pair.word()))
}

fn agrees_on(trees: u32) -> Seen {
    let seen = RefCell::new(Seen::new());
    on_plans(trees, |plan| {
        // The compiler takes nearly all the time.
        let kinds = thread::scope(|scope| {
            let start = |closing| scope.spawn(move || compared(plan, closing));
            CLOSINGS.map(start).map(|one| one.join().unwrap_or_else(|fault| resume_unwind(fault)))
        });
        for kind in kinds.into_iter().flatten() {
            *seen.borrow_mut().entry(kind).or_default() += 1;
        }
    });
    let seen = seen.take();
    assert_eq!(seen.len(), 7 + 3, "every kind that can be cut: {seen:?}");
    assert!(seen.values().sum::<u32>() >= trees, "{seen:?}");
    seen
}

#[test]
fn a_cut_loop_is_the_open_chain() {
    agrees_on(32);
}

/// A comparison that cannot fail proves nothing: a gap, a wrong tangent, and a tangent taken as straight are detected.
#[test]
fn faults_are_found() {
    let counts = RefCell::new([0; 3]);
    on_plans(24, |plan| {
        let Some(mut pair) = Pair::new(plan, CLOSINGS[0]) else {
            return;
        };
        let right = pair.embedding.clone();
        let faults: [fn(&mut Embedding); 3] = [
            |embedding| embedding.value[3] += 1e-9,
            |embedding| embedding.slope.iter_mut().for_each(|all| all[4] += 1e-9),
            |embedding| embedding.curvature.iter_mut().flatten().for_each(|all| *all = [0.0; 6]),
        ];
        for (place, fault) in faults.into_iter().enumerate() {
            pair.embedding = right.clone();
            fault(&mut pair.embedding);
            counts.borrow_mut()[place] += u32::from(pair.compare(plan.seed).is_err());
        }
    });
    // A fixed joint has no tangent, a prismatic one a straight one.
    let [gaps, tangents, curvatures] = counts.take();
    assert!(gaps >= 8, "{gaps}");
    assert!(tangents >= 5, "{tangents}");
    assert!(curvatures >= 3, "{curvatures}");
}

#[test]
#[ignore = "takes a minute"]
fn many_cut_loops_are_the_open_chains() {
    let seen = agrees_on(150);
    assert!(seen.values().all(|&count| count >= 10), "{seen:?}");
}
