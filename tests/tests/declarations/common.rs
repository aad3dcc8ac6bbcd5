//! The declarations that the tests read, from one that is usual to one that uses everything.

use eigentol_compiler::model::mechanism::Mechanism;
use eigentol_compiler::model::resolve::resolve;
use eigentol_compiler::syntax::ast::Ast;
use eigentol_compiler::syntax::parse::parse;

pub(crate) const DOUBLE_PENDULUM: &str = "
    /// Two uniform bars hinged in series on a shaft that spins at a constant rate.
    #[allow(dead_code)]
    pub mechanism RotatingDoublePendulum {
        /// Speed of the shaft.
        input omega: rpm;
        design m1 = 3.0 kg;
        design m2 = 3.0 kg;
        design l1 = 1.0 m +/- 3%;
        /// Length of the outer bar.
        design l2 = 1000 mm +/- 30 mm;
        let total = m1 + m2;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        point tip: bar2 at [0, 0, -l2];
        output tip_height = position(tip).z;
        output tip_radius = distance_from_axis(tip, z);
        output bend = theta2 - theta1;
    }";

/// Every item, every operator, every kind of argument; declared in an unusual order.
pub(crate) const EVERYTHING: &str = "
    pub(crate) mechanism Everything {
        input n: 1; input v: km/h; input f: 1/s; input g: kg/(m*s^2);
        design a = -(2 + 3) * 4 mm +/- 0.5 mm;
        design b = 3kg*m/s^2;
        design c = 5 1/s +/- 2.5%;
        design angle = 30 deg;
        design r = 0.2m;
        let late = early ^ 2 + [1, 2, 3].x * r^2;
        let early = 2 * r - 1 cm;
        let v1 = [r, 0, -r] / 2;
        let w1 = cross(v1, [1, 0, 0]) + v1 * 2;
        let s1 = -r^-2^2 * 1 m^4 + -(1 / (2 m)^2 ^ 2) * r^4;
        let t1 = atan2(r, 1 m) + atan(0.5) + norm(v1) / r + dot(v1, v1) / (r * r) + exp(ln(2));
        gravity [0, 0, -9.81] m/s^2;
        body p: point(mass: 1 kg);
        body d: disk(mass: 1 kg, radius: r, axis: [1, 0, 1], center: [0, r, 0]);
        body c1: cylinder(mass: 500 g, radius: r, length: 2 * r, axis: -y);
        body q: box(mass: 1 lb, size: [1, 2, 3] inch,);
        body s: sphere(mass: 1 t, radius: 1 ft);
        body i3: rigid(mass: 1 kg, inertia: [1, 1, 1] kg*m^2);
        body i6: rigid(mass: 1 kg, inertia: [1 kg*m^2, 1 kg*m^2, 1 kg*m^2, 0, 0.1 kg*m^2, 0], center: v1);
        joint j1: prismatic([1, 0, 1]) from ground to p
            at [0, 0, r] rotated(z, 30 deg) rotated(x, angle), at [0, 0, 1 mm] rotated(y, 5 deg) on p;
        joint j2: fixed from p to d rotated(w1, pi / 2);
        joint j3: revolute(-x) from c1 to p, at v1 on p, driven at 2 * c;
        joint j4: revolute(v1) from p to q, driven at n * f;
        joint j5: revolute(z) from q to s;
        joint j6: revolute(z) from s to i3;
        joint j7: revolute(z) from i3 to i6;
        point o: ground;
        point e: i6 at [r, 0, 0];
        force k: spring(on: j5, stiffness: 10 N*m/rad, rest: 5 deg);
        force l: damper(on: j1, damping: 0.1 N*s/m);
        force m: spring_damper(from: o, to: e, stiffness: 100 N/m, damping: 1 N*s/m, length: 0.2 m);
        output reach = distance(e, o) + 2 * r * cos(j5);
        output ratio = sin(j5) / max_ratio;
        let max_ratio = sqrt(2);
    }";

pub(crate) const WITHOUT_BODIES: &str = "mechanism Empty { }";

/// Everything that an open mechanism may consist of beyond the hinges and sliders of the others.
pub(crate) const OPEN_MECHANISM: &str = "
    pub mechanism OpenMechanism {
        input omega: rad/s; input thrust: kN;
        design r = 10 cm +/- 0.1 mm;
        design skew = 0 deg +/- 0.5 deg;
        design rho = 7850 kg/m^3 +/- 1%;
        design pitch = -5 mm;
        let arm = [r, 0, 0];
        gravity 9.81 m/s^2 along -z;

        body frame: massless;
        body rail: rod(density: 2 kg/m, length: 1 m, along: x);
        body plate: disk(density: 3 kg/m^2, radius: 2 * r, axis: z);
        body pipe: tube(density: rho, inner: r / 2, outer: r, length: 1 m, axis: y, center: arm);
        body sleeve: tube(mass: 1 kg, inner: 8 mm, outer: 1 cm, length: 5 cm, axis: -x);
        body drum: cylinder(density: rho, radius: r, length: 3 cm, axis: z)
            + rod(mass: 1 kg, length: r, along: z) at 2 * arm + [0, 0, r] rotated(y, 90 deg)
            - cylinder(density: rho, radius: r / 4, length: 3 cm, axis: z) at [r / 2, 0, 0] rotated(x, skew)
            + box(density: 1 g/cm^3, size: [1, 2, 3] cm) - sphere(density: 1 g/cm^3, radius: 4 mm);
        body hub: rigid(mass: 2 kg, inertia: [3, 3, 1, 0, 0, 0.1] kg*m^2, center: [0, 0, 50 cm], about: [0, 0, 10 cm]);
        body nut: point(mass: 100 g, center: arm) at arm;
        body drone: sphere(density: 300 kg/m^3, radius: r);
        body wobbler: sphere(mass: 1 kg, radius: r);

        joint mount: fixed from ground to frame;
        joint spin: revolute([sin(skew), 0, cos(skew)]) from frame to rail, driven at omega;
        joint thread: screw(x, lead: pitch) from rail to nut at arm rotated(x, skew), rotated(y, skew) on nut;
        joint sheath: cylindrical(slide: z, roll: -z) from rail to sleeve, slide driven at 1 mm/s, roll driven at 2 * omega;
        joint wrist: universal(flap: y, lag: [0, skew, 1]) from rail to drum at [1 m, 0, 0];
        joint table: planar(u: x, v: [1, 1, 0], turn: z) from frame to plate, turn driven at omega;
        joint hip: spherical(psi: z, theta: x, phi: z) from pipe to frame at [0, 0, 1 m] on frame;
        joint tether: free(x: x, y: [1, 2, 0], z: [0, 1, 1], yaw: z, pitch_angle: y, roll_angle: x) from plate to drone;
        joint head: spherical(a1: z, a2: y, a3: x) from drone to hub, a1 driven at -omega;
        joint tail: screw([0, 0, 1], lead: 1 inch) from hub to wobbler, tail driven at 3 rpm;

        point o: ground;
        point anchor: ground at [0, 0, 2 m] rotated(z, 30 deg) rotated(x, skew);
        point grip: drum at arm rotated(y, 90 deg);
        point knob: drone rotated(x, pi);

        force f1: spring(on: flap, stiffness: 10 N*m/rad, rest: 1 deg);
        force f2: damper(on: u, damping: 1 N*s/m);
        force f3: spring(on: thread, stiffness: 1 N*m);
        force f4: tension(from: anchor, to: grip,
            law: 1 N * exp((length - 10 cm) / r) + 2 N*s/m * rate + thrust * (length / 1 m)^3);
        force f5: generalized(on: lag, value: -1 N*m * sin(2 * lag) - 3 N*m*s * rate(lag) * cos(flap)
            + 1 N * position(grip).x * distance(grip, o) / r + 1 N * distance_from_axis(grip, -z));
        force f6: generalized(on: v, value: -2 N/m * (v - u) - thrust * rate(v) / (1 m/s));
        force f7: potential(energy: 3 N*m * (1 - cos(flap - lag)) + 2 N/m * distance(knob, anchor)^2
            + 1 J * angle(position(knob), [0, 0, 1])^2);
        force f8: bushing(from: anchor, to: knob, stiffness: [1, 2, 3] kN/m, turning_damping: [0, 0, 0.1] N*m*s/rad);
        force f9: bushing(from: o, to: grip, damping: arm * 1 N*s/m^2, turning_stiffness: [1, 1, 1] N*m/rad);
        force f10: load(at: knob, force: [0, 0, thrust]);
        force f11: load(at: grip, force: [1, 0, 0] N, moment: [0, 0, 1] N*m);
        force f12: follower(at: grip, moment: arm * 1 N);
        force f13: drag(at: knob, damping: 0.1 N*s/m, turning_damping: 0.1 N*m*s/rad);
        force f14: drag(at: grip, turning_damping: 0.1 N*m*s);

        output tension_of_joint = norm(reaction_force(wrist));
        output bending = reaction_moment(spin).y / 2;
        output energy = 2 * kinetic_energy();
        output swing = angle(position(grip) - position(o), position(anchor));
        output lean = (flap + 2 * lag) / 3;
        output gap = distance(grip, anchor) - slide;
    }";

/// All of them, for tests that only compare.
pub(crate) const DECLARATIONS: [&str; 4] =
    [DOUBLE_PENDULUM, EVERYTHING, OPEN_MECHANISM, WITHOUT_BODIES];

pub(crate) fn read(source: &str) -> Ast {
    let tokens = source.parse().expect("the source consists of Rust tokens");
    parse(tokens).unwrap_or_else(|errors| panic!("{errors}"))
}

pub(crate) fn resolved(source: &str) -> Mechanism {
    resolve(&read(source)).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The nominal design of a mechanism.
pub(crate) fn nominal(mechanism: &Mechanism) -> Vec<f64> {
    mechanism
        .design
        .iter()
        .map(|design| design.nominal)
        .collect()
}
