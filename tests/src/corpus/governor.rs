//! One arm of the steam engine's speed governor.

machine! {
    /// A flyball on an arm hinged beside the spindle, drawn in by a spring from the collar below; the collar's place is
    /// set by the engineer.
    pub mechanism Governor {
        /// Speed of the spindle.
        input speed: rpm;
        /// Height of the collar's eye below the hinge.
        input collar: mm;
        design arm = 180 mm +/- 0.5 mm;
        design ball = 1.2 kg +/- 20 g;
        design offset = 25 mm +/- 0.2 mm;
        design stiffness = 250 N/m +/- 5%;
        design friction = 0.05 N*m*s/rad;
        let ball_radius = (3 * ball / (4 * pi * 7200 kg/m^3))^(1/3);
        let eye = [8 mm, 0, -0.6 * arm];
        gravity 9.81 m/s^2 along -z;
        body spindle: cylinder(mass: 2 kg, radius: 12 mm, length: 400 mm, axis: z);
        body rocker: rod(mass: 150 g, length: arm, along: -z);
        body flyball: sphere(mass: ball, radius: ball_radius);
        joint spin: revolute(z) from ground to spindle, driven at speed;
        joint lift: revolute(-y) from spindle to rocker at [offset, 0, 0];
        joint screwed: fixed from rocker to flyball at [0, 0, -arm - ball_radius];
        point on_arm: rocker at eye;
        point on_collar: spindle at [offset / 2, 0, -collar];
        force draw: spring_damper(from: on_collar, to: on_arm, stiffness: stiffness, damping: 2 N*s/m, length: 90 mm);
        force rub: damper(on: lift, damping: friction);
        point ball_center: flyball;
        output ball_circle = 2 * distance_from_axis(ball_center, z);
        output spring_length = distance(on_arm, on_collar);
    }
}
