//! The smallest possible mechanisms.

use eigentol::mechanism;

mechanism! {
    /// One coordinate and nothing else.
    pub mechanism Oscillator {
        body block: point(mass: 1 kg);
        joint x: prismatic(x) from ground to block;
        force hold: spring(on: x, stiffness: 2 N/m);
    }
}

mechanism! {
    /// An output that does not move, an input and a design variable that nothing reads.
    #[allow(unused_variables)]
    pub mechanism Idle {
        input unread: rad/s;
        design spare = 1 kg;
        body block: point(mass: 1 kg);
        joint x: prismatic(x) from ground to block;
        force hold: spring(on: x, stiffness: 2 N/m);
        output still = 3 m;
    }
}
