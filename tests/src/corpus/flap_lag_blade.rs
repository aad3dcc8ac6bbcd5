//! A blade whose flap and lag axes cross in one universal joint.

machine! {
    /// A hinged propeller blade: flapping changes the distance from the axis, and Coriolis forces drive the lag.
    pub mechanism FlapLagBlade {
        input omega: rad/s;
        design mass = 12 kg +/- 1%;
        design length = 2 m +/- 2 mm;
        design hinge = 100 mm +/- 0.5 mm;
        design lag_stiffness = 2 kN*m/rad +/- 5%;
        gravity 9.81 m/s^2 along -z;
        body hub: massless;
        body blade: rod(mass: mass, length: length, along: x) + point(mass: 0.3 kg) at [length, 0, 0];
        joint spin: revolute(z) from ground to hub, driven at omega;
        joint root: universal(flap: -y, lag: z) from hub to blade at [hinge, 0, 0];
        force lead_lag: spring(on: lag, stiffness: lag_stiffness);
        force friction: generalized(on: flap, value: -0.5 N*m*s/rad * rate(flap));
        point tip: blade at [length, 0, 0];
        output tip_height = position(tip).z;
        output root_pull = reaction_force(root).x;
        output kinetic = kinetic_energy();
    }
}
