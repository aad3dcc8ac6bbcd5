//! Placements on both sides of a joint, a joint declared from child to parent, and a strut.

machine! {
    /// A chair on a pole hinged to the rim of a carousel, the pole braced by a strut to the mast.
    pub mechanism Carousel {
        input turns: rev/min;
        design rim = 4 m +/- 1 cm;
        design pole = 3.2 m +/- 1 cm;
        design rider = 75 kg +/- 30 kg;
        design strut = 1.8 kN/m +/- 5%;
        design splay = 12 deg +/- 0.5 deg;
        let seat = [0.5 m, 0.5 m, 0.4 m];
        gravity 9.81 m/s^2 along -z;
        body mast: cylinder(mass: 900 kg, radius: 0.3 m, length: 6 m, axis: z, center: [0, 0, -1 m]);
        body rod_and_eye: rod(mass: 9 kg, length: pole, along: z, center: [0, 0, pole / 2]);
        body chair: box(mass: rider + 14 kg, size: seat, center: [0, 0, -seat.z / 2]);
        joint spin: revolute(z) from ground to mast, driven at turns;
        joint tilt: revolute([0, 1, 0]) from rod_and_eye to mast
            at [0, 0, pole], at [rim, 0, 0] rotated(z, splay) rotated(y, 3 deg) on mast;
        joint bolt: fixed from rod_and_eye to chair rotated(y, 5 deg);
        joint sway: revolute(x) from chair to weight at [0, 0, 0.2 m], at [0, 0, 10 cm] on weight;
        body weight: point(mass: 3 kg, center: [0, 0, -0.15 m]);
        point on_mast: mast at [0, 0, -1.2 m];
        point on_pole: rod_and_eye at 0.5 * [0, 0, pole];
        force brace: spring_damper(from: on_mast, to: on_pole, stiffness: strut, length: norm([rim, 0, 1 m]));
        force stiff_tilt: spring(on: tilt, stiffness: 40 N*m/deg);
        force rubber: spring(on: sway, stiffness: 6 N*m/rad, rest: -splay / 4);
        force grease: damper(on: sway, damping: 0.3 N*m*s/rad);
        point feet: weight at [0, 0, -0.15 m];
        output radius = distance_from_axis(feet, z);
        output height = position(feet).z + 4 m;
        output strut_length = distance(on_mast, on_pole);
    }
}
