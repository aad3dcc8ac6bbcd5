//! A disk that rolls straight or in a circle. With `n = spin + yaw sin(lean)` and `k = C + m r^2`:
//!
//! - `A yaw^2 sin cos - k yaw cos n - m g r sin + stiffness lean = 0`, `yaw = torque / drag`,
//! - `|(A + m r^2) s^2 + d s + F_lean, F_yaw; G s, (A cos^2 + k sin^2) s + d| = 0`, a cubic:
//!   `F_lean = A yaw^2 cos 2 lean + k yaw (sin n - yaw cos^2) - m g r cos + stiffness`,
//!   `F_yaw = A yaw sin 2 lean - k (cos n + yaw sin cos)`,
//!   `G = cos (C n - 2 A yaw sin) + sin (k + m r^2) yaw cos`.
//!
//! Without torque, drag and spring it stays upright while `spin^2 > m g r A / (C k)`, for a thin disk `v^2 > g r / 3`.

use crate::corpus::machine;

machine! {
    /// A disk driven to spin in a cradle that leans against a spring and is turned about the vertical against drag.
    pub mechanism RollingDisk {
        /// Of the disk in its cradle.
        input spin: rad/s;
        /// About the vertical.
        input torque: N*m;
        design mass = 3 kg +/- 1%;
        design radius = 0.25 m +/- 1 mm;
        design across = 0.05 kg*m^2 +/- 1%;
        design polar = 0.09 kg*m^2 +/- 1%;
        design drag = 0.4 N*m*s/rad +/- 5%;
        design stiffness = 12 N*m/rad +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body base: massless;
        body mast: massless;
        body cradle: massless;
        body disk: rigid(mass: mass, inertia: [across, polar, across]);
        joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
        joint height: prismatic(z) from base to mast;
        joint lean: revolute(x) from mast to cradle;
        joint turn: revolute(y) from cradle to disk, driven at spin;
        point road: ground;
        point hub: disk;
        point seat: cradle;
        constraint contact: rolling(wheel: hub, axis: y, radius: radius, on: road, normal: z);
        force upright: spring(on: lean, stiffness: stiffness);
        force air: drag(at: seat, turning_damping: drag);
        force helm: load(at: seat, moment: [0, 0, torque]);
        output centripetal = reaction_force(contact).y;
        output weight = reaction_force(contact).z;
    }
}
