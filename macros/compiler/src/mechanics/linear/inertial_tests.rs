//! The two ways to mass, damping and stiffness against each other.

use super::inertial::Inertial;
use crate::algebra::{ExprId, Graph};
use crate::mechanics::equations::Equations;
use crate::mechanics::setup::{Context, vanish};

/// Asserts that both ways give the same, and counts the entries that are not zero; `None` if there is one way only.
pub(crate) fn compared(g: &mut Graph, context: &Context, equations: &Equations) -> Option<[usize; 3]> {
    let inertial = Inertial::new(g, context, equations);
    let walked = inertial.by_walks(g)?.map(|matrix| matrix.concat());
    let differentiated = inertial.by_differentiation(g).map(|matrix| matrix.concat());
    for (walked, differentiated) in walked.iter().zip(&differentiated) {
        let differences: Vec<ExprId> =
            walked.iter().zip(differentiated).map(|(&one, &other)| g.sub(one, other)).collect();
        let equal = vanish(g, context, &differences);
        assert!(equal.iter().all(|equal| *equal), "{equal:?}");
    }
    Some(differentiated.map(|matrix| vanish(g, context, &matrix).into_iter().filter(|zero| !zero).count()))
}
