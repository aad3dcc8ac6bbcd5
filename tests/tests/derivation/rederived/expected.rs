//! A mode solved again, in one form for both families.

use eigentol::sensitivity::Quantity;
use eigentol_tests::rederived::{ComplexDerived, Derived, GeneralMode, UndampedMode};

/// One mode solved again, of either family; an undamped shape is stored as complex.
pub(super) struct Expected {
    pub(super) s: Option<[Derived; 2]>,
    pub(super) lambda: Option<Derived>,
    pub(super) quantities: Vec<(Quantity, Derived)>,
    pub(super) right: Vec<[Derived; 2]>,
    pub(super) left: Vec<[Derived; 2]>,
}

fn pair(x: &ComplexDerived) -> [Derived; 2] {
    [x.re.clone(), x.im.clone()]
}

impl Expected {
    pub(super) fn general(mode: GeneralMode) -> Self {
        Self {
            quantities: vec![
                (Quantity::Frequency, mode.s.im.clone()),
                (Quantity::NaturalFrequency, mode.magnitude.clone()),
                (Quantity::DampingRatio, mode.damping_ratio.clone()),
                (Quantity::Growth, mode.s.re.clone()),
                (Quantity::LogDecrement, mode.log_decrement.clone()),
            ],
            s: Some(pair(&mode.s)),
            lambda: None,
            right: mode.right.iter().map(pair).collect(),
            left: mode.left.iter().map(pair).collect(),
        }
    }

    pub(super) fn undamped(mode: UndampedMode) -> Self {
        let zero = |x: &Derived| Derived {
            value: 0.0,
            gradient: vec![0.0; x.gradient.len()],
            hessian: vec![vec![0.0; x.gradient.len()]; x.gradient.len()],
        };
        let shape: Vec<[Derived; 2]> = mode.shape.iter().map(|x| [x.clone(), zero(x)]).collect();
        let s = mode.omega.as_ref().map(|omega| [zero(omega), omega.clone()]);
        let omega = mode.omega.iter();
        Self {
            s,
            quantities: omega.map(|x| (Quantity::Frequency, x.clone())).collect(),
            lambda: Some(mode.lambda),
            right: shape.clone(),
            left: shape,
        }
    }
}
