//! A top in steady precession: two of its three angles are driven, the third finds its equilibrium.

machine! {
    /// A top on a fixed point, precessing and spinning at constant rates.
    pub mechanism SteadyTop {
        input precession: rad/s;
        input spin: rpm;
        design mass = 0.5 kg +/- 1 g;
        design radius = 40 mm +/- 0.1 mm;
        design height = 60 mm +/- 0.2 mm;
        design cord = 0.2 N/m +/- 2%;
        gravity 9.81 m/s^2 along -z;
        body top: disk(mass: mass, radius: radius, axis: z, center: [0, 0, height])
            + cylinder(mass: 80 g, radius: 5 mm, length: 100 mm, axis: z) at [0, 0, 50 mm];
        joint pivot: spherical(psi: z, theta: x, phi: z) from ground to top,
            psi driven at precession, phi driven at spin;
        point nose: top at [0, 0, 100 mm];
        point hook: ground at [0, 0, 300 mm];
        force stay: tension(from: nose, to: hook, law: cord * (length - 50 mm) + 0.01 N*s/m * rate);
        force field: potential(energy: 0.01 N * position(nose).z);
        output lean = angle(position(nose), [0, 0, 1 m]);
        output support = reaction_force(pivot).z;
    }
}
