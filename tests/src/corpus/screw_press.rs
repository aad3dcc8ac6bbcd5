//! A screw, a cylindrical guide and a floating head: the remaining joints and loads.

machine! {
    /// A fly press at rest under load: a screw lifts the ram, whose tool floats in springs and is pulled askew.
    pub mechanism ScrewPress {
        design lead = 20 mm +/- 0.05 mm;
        design arm = 0.4 m +/- 1 mm;
        design ram_mass = 25 kg +/- 0.1 kg;
        design tool_spring = 50 kN/m +/- 3%;
        design misalignment = 0.5 deg +/- 0.2 deg;
        gravity 9.81 m/s^2 along -z;
        body flywheel: rod(mass: 18 kg, length: 2 * arm, along: x, center: [0, 0, 0]);
        body ram: box(mass: ram_mass, size: [200, 200, 300] mm);
        body tool: rigid(mass: 4 kg, inertia: [0.03, 0.03, 0.02, 0.001, 0, 0] kg*m^2, center: [0, 0, -50 mm], about: [0, 0, 0]);
        joint thread: screw(z, lead: lead) from ground to flywheel;
        joint guide: cylindrical(drop: z, turn: z) from flywheel to ram at [0, 0, -0.3 m] rotated(x, misalignment);
        joint float: free(px: x, py: y, pz: z, yaw: z, pitch: y, roll: x) from ram to tool at [0, 0, -0.15 m];
        point collar: flywheel at [0, 0, -0.3 m];
        point crown: ram;
        point face: ram at [0, 0, -0.15 m] rotated(z, 10 deg);
        point shank: tool;
        point tip: tool at [0, 0, -100 mm] rotated(y, 5 deg);
        force torsion: spring(on: thread, stiffness: 300 N*m/rad, rest: 10 deg);
        force hang: bushing(from: collar, to: crown, stiffness: [0, 0, 1e5] N/m, turning_stiffness: [0, 0, 500] N*m/rad);
        force cage: bushing(from: face, to: shank,
            stiffness: [tool_spring, tool_spring, 2 * tool_spring], damping: [10, 10, 20] N*s/m,
            turning_stiffness: [400, 400, 300] N*m/rad, turning_damping: [1, 1, 1] N*m*s/rad);
        force work: load(at: tip, force: [30, 0, 200] N, moment: [0, 1, 0] N*m);
        force scrape: follower(at: tip, force: [0, 15, 0] N);
        output wedge = reaction_moment(guide).x;
        output gap = distance(crown, tip);
    }
}
