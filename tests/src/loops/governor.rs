//! The fly-ball governor: two loops, each closed by a joint that is declared `cut`.

use crate::corpus::machine;

machine! {
    /// Two arms with balls on a driven shaft, two links from the arms down to a sleeve with a spring.
    pub mechanism Governor {
        input omega: rad/s;
        design arm = 180 mm +/- 0.5 mm;
        design knee = 110 mm +/- 0.3 mm;
        design link = 120 mm +/- 0.3 mm;
        design offset = 30 mm +/- 0.2 mm;
        design ball = 1.2 kg +/- 20 g;
        design sleeve = 2 kg +/- 50 g;
        design stiffness = 1200 N/m +/- 5%;
        design rest = -180 mm +/- 1 mm;
        let foot = 20 mm;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body collar: point(mass: sleeve);
        body arm_right: rod(mass: 150 g, length: arm, along: -z)
            + sphere(mass: ball, radius: 35 mm) at [0, 0, -arm];
        body arm_left: rod(mass: 150 g, length: arm, along: -z)
            + sphere(mass: ball, radius: 35 mm) at [0, 0, -arm];
        body link_right: rod(mass: 100 g, length: link, along: -z);
        body link_left: rod(mass: 100 g, length: link, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint slide: prismatic(z) from shaft to collar;
        joint lift_right: revolute(-y) from shaft to arm_right at [offset, 0, 0];
        joint lift_left: revolute(y) from shaft to arm_left at [-offset, 0, 0];
        joint knee_right: revolute(-y) from arm_right to link_right at [0, 0, -knee];
        joint knee_left: revolute(y) from arm_left to link_left at [0, 0, -knee];
        joint foot_right: revolute(-y) from link_right to collar at [0, 0, -link], at [foot, 0, 0] on collar, cut;
        joint foot_left: revolute(y) from link_left to collar at [0, 0, -link], at [-foot, 0, 0] on collar, cut;
        force main: spring(on: slide, stiffness: stiffness, rest: rest);
        point ball_center: arm_right at [0, 0, -arm];
        output foot_force = norm(reaction_force(foot_right));
        output hinge_force = norm(reaction_force(lift_right));
        output hinge_pull = reaction_force(lift_right).x;
        output weight = reaction_force(spin).z;
        output ball_circle = 2 * distance_from_axis(ball_center, z);
    }
}
