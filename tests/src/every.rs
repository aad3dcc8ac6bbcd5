//! Springs and dampers on every free coordinate, and a mechanism of which only the equations are needed.

use crate::corpus::machine;

machine! {
    /// A gripper: two fingers that a slider spreads through a loop, and an arm that nothing but a damper resists.
    pub mechanism Gripper {
        input omega: rad/s;
        design stiffness = 20 N*m/rad +/- 5%;
        let damping = 0.2 N*m*s/rad;
        kernels only;
        gravity 9.81 m/s^2 along -z;
        body table: massless;
        body arm: rod(mass: 2 kg, length: 50 cm, along: x);
        body finger: rod(mass: 100 g, length: 10 cm, along: x);
        body link: rod(mass: 50 g, length: 10 cm, along: x);
        body slider: point(mass: 200 g);
        body nail: sphere(mass: 10 g, radius: 5 mm);
        joint spin: revolute(z) from ground to table, driven at omega;
        joint lift: prismatic(z) from table to arm;
        joint finger_angle: revolute(-y) from arm to finger at [50 cm, 0, 0];
        joint pin: revolute(-y) from finger to link at [10 cm, 0, 0];
        joint wrist: revolute(-y) from link to slider at [10 cm, 0, 0];
        joint guide: prismatic(x) from arm to slider at [50 cm, 0, 2 cm];
        joint tip: universal(a: x, b: y) from finger to nail at [5 cm, 0, 0];
        force own: spring(on: a, stiffness: 1 N*m/rad);
        every angle: spring_damper(stiffness: stiffness, damping: damping, rest: 10 deg);
        every displacement: damper(damping: 3 N*s/m);
    }
}
