//! Porter's governor, with its massless links declared as distances.

use crate::corpus::machine;

machine! {
    /// Two arms with balls on a driven shaft, massless links down to a sleeve with a spring and a dashpot.
    pub mechanism PorterGovernor {
        input omega: rad/s;
        design arm = 180 mm +/- 0.5 mm;
        design knee = 110 mm +/- 0.3 mm;
        design link = 120 mm +/- 0.3 mm;
        design offset = 30 mm +/- 0.2 mm;
        design ball = 1.2 kg +/- 20 g;
        design sleeve = 2 kg +/- 50 g;
        design stiffness = 1200 N/m +/- 5%;
        design rest = -180 mm +/- 1 mm;
        design friction = 25 N*s/m +/- 2 N*s/m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body collar: point(mass: sleeve);
        body arm_right: rod(mass: 150 g, length: arm, along: -z)
            + sphere(mass: ball, radius: 35 mm) at [0, 0, -arm];
        body arm_left: rod(mass: 150 g, length: arm, along: -z)
            + sphere(mass: ball, radius: 35 mm) at [0, 0, -arm];
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint slide: prismatic(z) from shaft to collar;
        joint lift_right: revolute(-y) from shaft to arm_right at [offset, 0, 0];
        joint lift_left: revolute(y) from shaft to arm_left at [-offset, 0, 0];
        point knee_right: arm_right at [0, 0, -knee];
        point knee_left: arm_left at [0, 0, -knee];
        point foot_right: collar at [20 mm, 0, 0];
        point foot_left: collar at [-20 mm, 0, 0];
        constraint rod_right: distance(from: knee_right, to: foot_right, length: link);
        constraint rod_left: distance(from: foot_left, to: knee_left, length: link);
        force main: spring(on: slide, stiffness: stiffness, rest: rest);
        force dashpot: damper(on: slide, damping: friction);
        point ball_center: arm_left at [0, 0, -arm];
        output rod_tension = reaction(rod_right);
        output hinge_force = norm(reaction_force(lift_right));
        output ball_circle = 2 * distance_from_axis(ball_center, z);
    }
}
