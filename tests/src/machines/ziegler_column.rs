//! Ziegler's column under a follower force (H. Ziegler, Die Stabilitaetskriterien der Elastomechanik, 1952).
//!
//! Masses `2 m` and `m`, equal hinges `k` and `c`. With `p = P l / k` and `x = w^2 m l^2 / k`, undamped:
//! `2 x^2 - (7 - 2 p) x + 1 = 0`. Flutter begins at `p = 7/2 - sqrt(2)`, with damping at
//! `p = 41/28 + c^2 / (2 m l^2 k)`.

use crate::corpus::machine;

machine! {
    /// Two light bars with masses at their ends on elastic hinges, pressed by a force along the second bar.
    pub mechanism ZieglerColumn {
        input load: N;
        design mass = 2 kg +/- 1%;
        design length = 0.5 m +/- 1%;
        design stiffness = 30 N*m/rad +/- 3%;
        design damping = 0 N*m*s/rad;
        body lower: point(mass: 2 * mass, center: [0, 0, length]);
        body upper: point(mass: mass, center: [0, 0, length]);
        joint base: revolute(y) from ground to lower;
        joint knee: revolute(y) from lower to upper at [0, 0, length];
        force at_base: spring(on: base, stiffness: stiffness);
        force at_knee: spring(on: knee, stiffness: stiffness);
        force rub_base: damper(on: base, damping: damping);
        force rub_knee: damper(on: knee, damping: damping);
        point tip: upper at [0, 0, length];
        force thrust: follower(at: tip, force: [0, 0, -load]);
    }
}
