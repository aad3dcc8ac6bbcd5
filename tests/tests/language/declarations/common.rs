//! The declarations that the tests read, from an ordinary one to one that uses everything.

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

/// Everything that an open mechanism may contain beyond the hinges and sliders of the others.
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
        every angle: spring_damper(stiffness: 5 N*m/rad, damping: 0.1 N*m*s/rad, rest: skew);
        every displacement: spring(stiffness: 5 N/m);
        every displacement: damper(damping: 0.1 N*s/m);

        output tension_of_joint = norm(reaction_force(wrist));
        output bending = reaction_moment(spin).y / 2;
        output energy = 2 * kinetic_energy();
        output swing = angle(position(grip) - position(o), position(anchor));
        output lean = (flap + 2 * lag) / 3;
        output gap = distance(grip, anchor) - slide;
    }";

/// Every constraint, cut and coasting joints, and everything that refers to them. It is not a machine that could be
/// built.
pub(crate) const CLOSED_MECHANISM: &str = "
    pub mechanism ClosedMechanism {
        input omega: rad/s;
        design l = 20 cm +/- 1 mm;
        design r = 30 cm;
        design z1 = 20; design z2 = 35;
        design pitch_radius = 3 cm;
        kernels only;
        gravity 9.81 m/s^2 along -z;

        body crank: rod(mass: 1 kg, length: l, along: x);
        body coupler: rod(mass: 1 kg, length: l, along: x);
        body slider: point(mass: 1 kg);
        body carrier: point(mass: 1 kg);
        body shaft: massless;
        body rotor: disk(mass: 1 kg, radius: r, axis: y);
        body base: box(mass: 10 kg, size: [1, 1, 1] m);
        body wheel: disk(mass: 1 kg, radius: r, axis: y);
        body idler: disk(mass: 1 kg, radius: r, axis: y);
        body lock: sphere(mass: 1 kg, radius: l);

        joint turn1: revolute(y) from ground to crank;
        joint turn2: revolute(y) from crank to coupler at [l, 0, 0];
        joint lower: revolute(y) from coupler to ground at [l, 0, 0], at [0, 0, 10 cm] on ground, cut;
        joint slide: prismatic(x) from ground to slider;
        joint ball: spherical(b1: z, b2: y, b3: x) from slider to coupler cut;
        joint lift: prismatic(z) from slider to carrier;
        joint spin: revolute(y) from ground to shaft, driven at omega;
        joint flex: revolute(y) from shaft to rotor;
        joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
        joint axle: cylindrical(play: y, roll_on: y) from base to wheel, play driven at 0, roll_on coasting;
        joint idle: revolute(y) from base to idler coasting;
        joint plate: planar(p1: x, p2: y, p3: z) from base to carrier, cut, at [0, 0, l];
        joint held: revolute(x) from base to lock, driven at 0;

        point elbow: crank at [l, 0, 0];
        point knee: coupler;
        point anchor: ground at [1 m, 0, 0];
        point hub: wheel;
        point road: ground;

        constraint pin: coincident(from: elbow, to: knee);
        constraint guide: coincident(from: knee, to: elbow, along: [x, z]);
        constraint floor: coincident(from: elbow, to: knee, along: z);
        constraint square: aligned(from: elbow, to: knee);
        constraint parallel: aligned(from: elbow, to: knee, axis: [3, 0, 4]);
        constraint opposite: aligned(from: elbow, to: knee, axis: -y);
        constraint rod: distance(from: elbow, to: anchor, length: 2 * l);
        constraint mesh: coupling(of: turn1, with: turn2, ratio: -z2 / z1, offset: 5 deg);
        constraint rack: coupling(of: slide, with: turn1, ratio: pitch_radius);
        constraint pinion: coupling(of: turn1, with: slide, ratio: 50 rad/m);
        constraint tandem: coupling(of: slide, with: lift, ratio: 1, offset: -2 cm);
        constraint belt: coupling(of: spin, with: idle, ratio: 2);
        constraint slot: equation(zero: position(elbow).z - l * cos(turn2) + omega * 0 s * 1 m);
        constraint area: equation(zero: slide * lift - l^2);
        constraint pure: equation(zero: sin(turn1) + slide / l);
        constraint sum: equation(zero: turn1 + turn2 + held - 10 deg);
        constraint contact: rolling(wheel: hub, axis: y, radius: r, on: road);
        constraint bounce: rolling(wheel: hub, radius: r, on: road, normal: [0, 3, 4]);

        force brake: damper(on: idle, damping: 0.1 N*m*s/rad);
        force motor: generalized(on: roll_on, value: 1 N*m - 0.1 N*m*s * rate(yaw));
        force twist: spring(on: flex, stiffness: 10 N*m/rad);

        output pull = norm(reaction_force(pin));
        output o1 = reaction_force(guide).z;
        output o2 = reaction_moment(square).y;
        output o3 = reaction(rod);
        output o4 = reaction(mesh);
        output o5 = reaction(rack);
        output o6 = reaction(area);
        output o7 = reaction_force(contact).y;
        output o8 = reaction(pure);
        output o9 = reaction_moment(lower).x;
        output speed = rate(forward);
        output yawing = rate(yaw);
        output wheel_speed = rate(idle);
    }";

/// Every form of tolerance, with every distribution law.
pub(crate) const TOLERANCES: &str = "
    mechanism Fits {
        input omega: rpm +/- 1%;
        input load: N +/- 0.5 N uniform;
        input supply: 1 +0.1 -0.2 triangular;
        input drift: 1/s 0 -2 % lognormal;
        design length = 1 m +/- 3% truncated normal;
        design bore = 20 mm +0.021 0 mm;
        design pin = 20 mm -0.020 -0.041 mm uniform;
        design clearance = 2 * 10 mm +0.1 mm -0.05 mm triangular;
        design density = 7850 kg/m^3 +2 -1 % lognormal;
        design stiffness = 100 N/m + 10 N/m +/- 5 N/m weibull;
        design ratio = 3 +/- 0.5 beta(2, 1 / 2);
        design teeth = 20 +1 -1 normal;
        design tilt = -5 deg +10% -10% beta(0.5, 3);
        body shaft: massless;
        body bar: cylinder(density: density, length: length, radius: pin / 2, axis: x);
        joint spin: revolute(z) from ground to shaft, driven at omega * supply;
        joint theta: revolute(y) from shaft to bar;
        force hinge: spring(on: theta, stiffness: stiffness * length * bore * ratio * teeth, rest: tilt);
        force weight: load(at: tip, force: [0, 0, -load * (1 + drift * 1 s)]);
        point tip: bar at [clearance, 0, 0];
    }";

/// All of them, for tests that only compare.
pub(crate) const DECLARATIONS: [&str; 6] =
    [DOUBLE_PENDULUM, EVERYTHING, OPEN_MECHANISM, CLOSED_MECHANISM, TOLERANCES, WITHOUT_BODIES];

pub(crate) fn read(source: &str) -> Ast {
    let tokens = source.parse().expect("the source consists of Rust tokens");
    parse(tokens).unwrap_or_else(|errors| panic!("{errors}"))
}

pub(crate) fn resolved(source: &str) -> Mechanism {
    resolve(&read(source)).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The nominal design of a mechanism.
pub(crate) fn nominal(mechanism: &Mechanism) -> Vec<f64> {
    mechanism.design.iter().map(|design| design.nominal).collect()
}
