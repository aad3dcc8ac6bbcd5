//! A rotor in an oil film: non-symmetric matrices, and curves over the speed and over a design variable.

machine! {
    /// A rigid rotor in an oil film that couples its axes; stiffness and damping change with the speed, damping with
    /// the temperature.
    pub mechanism FilmRotor {
        input speed: rpm;
        design mass = 49 kg +/- 1%;
        design film = 1 +/- 10%;
        design temperature = 50 +/- 3;
        curve kxx: [2000, 4000, 6000, 8000, 10000, 12000] rpm -> [12.15, 12.39, 12.44, 12.46, 12.47, 12.48] MN/m;
        curve kxy: [2000, 5000, 12000] rpm -> [20.4, 51.4, 123.3] MN/m;
        curve kyx: [2000, 4000, 8000, 12000] rpm -> [-26.91, -44.58, -84.02, -124.6] MN/m;
        curve kyy: [2000, 12000] rpm -> [7.5, 6.3] MN/m;
        curve cxy: [2000, 3000, 4000, 6000, 9000, 12000] rpm -> [-58.2, -39.3, -29.6, -19.8, -13.2, -9.9] kN*s/m;
        curve viscosity: [20, 40, 60, 90] -> [1.8, 1.2, 0.8, 0.5];
        let across = [[0, cxy(speed), 0], [cxy(speed), 0, 0], [0, 0, 0]];
        let along = [[208, 0, 0], [0, 240, 0], [0, 0, 0]] kN*s/m;
        body slide: massless;
        body center: massless;
        body wheel: disk(mass: mass, radius: 150 mm, axis: z);
        joint x_sway: prismatic(x) from ground to slide;
        joint y_sway: prismatic(y) from slide to center;
        joint spin: revolute(z) from center to wheel, driven at speed;
        point seat: ground;
        point journal: center;
        force film_force: bushing(from: seat, to: journal,
            stiffness: film * [[kxx(speed), kxy(speed), 0], [kyx(speed), kyy(speed), 0], [0, 0, 0]],
            damping: viscosity(temperature) * (along + across));
        output drag = viscosity(temperature) * kyy(speed) / 1 MN/m;
    }
}
