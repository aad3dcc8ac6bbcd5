//! A pendulum on a turntable whose foundation is shaken up and down.

machine! {
    /// The shaking changes the weight, and with it the balance of a pendulum that the spin has raised.
    pub mechanism ShakenTurntable {
        input omega: rad/s;
        input buzz: rad/s;
        design length = 0.6 m +/- 2 mm;
        design amplitude = 0.5 mm +/- 0.2 mm;
        design factor = 1.5 +/- 1%;
        gravity 9.81 m/s^2 along -z;
        body floor: massless;
        body table: disk(mass: 4 kg, radius: 0.5 m, axis: z);
        body bar: rod(mass: 1 kg, length: length, along: -z);
        body bob: point(mass: 0.5 kg);
        joint heave: prismatic(z) from ground to floor, shaken(amplitude: amplitude, frequency: buzz);
        joint spin: revolute(-z) from floor to table, driven at omega;
        joint swing: revolute(y) from table to bar at [0.2, 0, 0] m;
        joint slide: prismatic(z) from bar to bob at [0, 0, -length], slide shaken(velocity: 2 mm/s, order: factor of spin, phase: 1 rad);
        force hinge: spring(on: swing, stiffness: 2 N*m/rad);
        force friction: damper(on: swing, damping: 0.05 N*m*s/rad);
        force drive: harmonic(on: swing, moment: 0.02 N*m, order: factor of spin);
        point tip: bob;
        output height = position(tip).z;
        output holding = reaction_force(heave).z;
        output torque = reaction_moment(spin).z;
    }
}
