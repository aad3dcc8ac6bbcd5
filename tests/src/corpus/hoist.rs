//! A driven slide: a uniform rise leaves a steady state, and the load hangs as if at rest.

machine! {
    /// A load swinging on a jib that turns and rises at constant speeds, its inclined trolley held by a spring.
    pub mechanism Hoist {
        input slewing: deg/s;
        input rise: m/min;
        design jib = 6 m +/- 20 mm;
        design rope = 2.4 m +/- 10 mm;
        design load = 0.35 t +/- 5 kg;
        design pull = 9000 N/m +/- 5%;
        design incline = 8 deg +/- 0.5 deg;
        gravity 9.81 m/s^2 along -z;
        body post: massless;
        body cage: disk(mass: 120 lb, radius: 1 ft, axis: [1, 1, 0]);
        body trolley: point(mass: 60 kg);
        body hook: massless;
        body ball: sphere(mass: load, radius: 15 inch, center: [0, 0, -rope]);
        joint slew: revolute(z) from ground to post, driven at slewing;
        joint climb: prismatic(z) from post to cage, driven at rise;
        joint run: prismatic([1, 0, 0]) from cage to trolley at [jib / 2, 0, 0] rotated(y, incline);
        joint in_plane: revolute(y) from trolley to hook rotated(y, -incline);
        joint out_of_plane: revolute(x) from hook to ball;
        force tackle: spring(on: run, stiffness: pull, rest: 0.5 * jib / 6);
        point hanging: ball at [0, 0, -rope];
        output radius = distance_from_axis(hanging, [0, 0, 2]);
        output lag_angle = out_of_plane;
    }
}
