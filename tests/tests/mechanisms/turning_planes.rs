//! Balls and discs that roll on planes that turn, against d'Alembert's principle: with the poses of all bodies as
//! functions of the coordinates, written by hand and differentiated numerically, the contact does not slip and
//! `sum m (a - g) . dx + (J w' + w x J w) . dphi = dW` for every motion without slip. The running coordinates stand at
//! arbitrary angles, on which the compiler says nothing depends.

use eigentol::Role;
use eigentol::motion::accelerations;
use eigentol_compiler::compile_text;
use eigentol_compiler::mechanics::Limits;
use eigentol_consistency::check::check;
use eigentol_consistency::subject::Subject;
use eigentol_interpreter::Interpreted;
use nalgebra::{Complex, DMatrix, DVector, Isometry3, Matrix3, SVD, Unit, UnitQuaternion, Vector3};

type Pose = Isometry3<f64>;
/// The value of a coordinate.
type At<'a> = &'a dyn Fn(&str) -> f64;

fn v(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x, y, z)
}

fn turn(axis: Vector3<f64>, angle: f64) -> Pose {
    let axis = Unit::new_normalize(axis);
    Pose::from_parts(Vector3::zeros().into(), UnitQuaternion::from_axis_angle(&axis, angle))
}

fn shift(by: Vector3<f64>) -> Pose {
    Pose::translation(by.x, by.y, by.z)
}

/// A body in its centre of mass.
struct Body {
    mass: f64,
    inertia: [f64; 3],
    pose: fn(At) -> Pose,
}

/// A machine in which the first body rolls on a plane.
struct Machine {
    text: String,
    bodies: Vec<Body>,
    plane: fn(At) -> Pose,
    /// In the axes of the plane.
    normal: Vector3<f64>,
    /// Of a disc, in its axes.
    axle: Option<Vector3<f64>>,
    radius: f64,
    gravity: Vector3<f64>,
    /// Coordinates that springs hold at zero, N/m or N*m/rad.
    springs: Vec<(&'static str, f64)>,
    /// Driven coordinates and their speeds.
    driven: Vec<(&'static str, f64)>,
    /// The coordinate that contact determines.
    height: &'static str,
}

const STEP: f64 = 2e-3;

/// First and second derivative by five points.
fn derivatives(at: impl Fn(f64) -> DVector<f64>) -> [DVector<f64>; 2] {
    let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| at(k * STEP));
    [
        (&a - &b * 8.0 + &d * 8.0 - &e) / (12.0 * STEP),
        (-&a + &b * 16.0 - &c * 30.0 + &d * 16.0 - &e) / (12.0 * STEP * STEP),
    ]
}

fn rotation_of(pose: &Pose) -> Matrix3<f64> {
    *pose.rotation.to_rotation_matrix().matrix()
}

/// The vector of a skew matrix.
fn axial(m: &Matrix3<f64>) -> Vector3<f64> {
    v(m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)]) / 2.0
}

/// Position, velocity and acceleration of the origin; angular velocity and acceleration.
struct Motion {
    x: Vector3<f64>,
    v: Vector3<f64>,
    a: Vector3<f64>,
    w: Vector3<f64>,
    dw: Vector3<f64>,
    axes: Matrix3<f64>,
}

fn motion(pose: impl Fn(f64) -> Pose) -> Motion {
    let flat = |t: f64| {
        let pose = pose(t);
        let rotation = rotation_of(&pose);
        let entries = pose.translation.vector.iter().chain(rotation.iter());
        DVector::from_iterator(12, entries.copied())
    };
    let [first, second] = derivatives(flat);
    let part = |d: &DVector<f64>| Vector3::from_column_slice(&d.as_slice()[..3]);
    let axes = rotation_of(&pose(0.0));
    let turned = |d: &DVector<f64>| Matrix3::from_column_slice(&d.as_slice()[3..]);
    let (d1, d2) = (turned(&first), turned(&second));
    Motion {
        x: pose(0.0).translation.vector,
        v: part(&first),
        a: part(&second),
        w: axial(&(d1 * axes.transpose())),
        dw: axial(&(d2 * axes.transpose() + d1 * d1.transpose())),
        axes,
    }
}

/// Coordinates by name with their rates and accelerations.
#[derive(Clone)]
struct Course(Vec<(String, [f64; 3])>);

impl Course {
    fn at(&self, t: f64) -> impl Fn(&str) -> f64 {
        move |name| {
            let own = self.0.iter().find(|pair| pair.0 == name);
            let [q, rate, acceleration] = own.expect(name).1;
            q + t * rate + t * t * acceleration / 2.0
        }
    }

    fn set(&mut self, name: &str, order: usize, value: f64) {
        let own = self.0.iter_mut().find(|pair| pair.0 == name);
        own.expect("a coordinate").1[order] = value;
    }

    fn get(&self, name: &str, order: usize) -> f64 {
        self.0.iter().find(|pair| pair.0 == name).expect("a coordinate").1[order]
    }
}

impl Machine {
    fn motion(&self, pose: fn(At) -> Pose, course: &Course, from: f64) -> Motion {
        motion(|t| pose(&course.at(from + t)))
    }

    /// The gap, and the velocity at the contact of the wheel relative to the plane.
    fn contact(&self, course: &Course, time: f64) -> (f64, Vector3<f64>) {
        let wheel = self.motion(self.bodies[0].pose, course, time);
        let plane = self.motion(self.plane, course, time);
        let n = plane.axes * self.normal.normalize();
        let outward = match self.axle {
            None => n,
            Some(axle) => {
                let axle = wheel.axes * axle;
                (n - axle * n.dot(&axle)).normalize()
            }
        };
        let contact = wheel.x - outward * self.radius;
        let own = wheel.v + wheel.w.cross(&(contact - wheel.x));
        let other = plane.v + plane.w.cross(&(contact - plane.x));
        ((contact - plane.x).dot(&n), own - other)
    }

    fn check(&self, seed: u64) {
        let machine = Interpreted::from_text(&self.text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{}", self.text));
        let description = machine.description().clone();
        let unknowns = description.coordinates.clone();
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
        };
        let moves = |role| matches!(role, Role::Position | Role::Speed);
        let moving: Vec<String> =
            unknowns.iter().filter(|unknown| moves(unknown.role)).map(|unknown| unknown.name.to_string()).collect();
        let mut course = Course(Vec::new());
        for name in &moving {
            course.0.push((name.clone(), [random(), random(), 0.0]));
        }
        for (name, speed) in &self.driven {
            course.0.push(((*name).to_owned(), [2.0 * random(), *speed, 0.0]));
        }
        // the height that closes the gap
        for _ in 0..40 {
            let gap = self.contact(&course, 0.0).0;
            let height = course.get(self.height, 0);
            course.set(self.height, 0, height + 1e-4);
            let slope = (self.contact(&course, 0.0).0 - gap) / 1e-4;
            course.set(self.height, 0, height - gap / slope);
        }
        assert!(self.contact(&course, 0.0).0.abs() < 1e-12, "{}", self.text);
        // slip by the rates, which it is linear in; the nearest rates without slip
        let slip = |course: &Course| self.contact(course, 0.0).1;
        let mut still = course.clone();
        moving.iter().for_each(|name| still.set(name, 1, 0.0));
        let base = slip(&still);
        let columns: Vec<Vector3<f64>> = moving
            .iter()
            .map(|name| {
                let mut moved = still.clone();
                moved.set(name, 1, 1.0);
                slip(&moved) - base
            })
            .collect();
        let jacobian = DMatrix::from_fn(3, moving.len(), |i, k| columns[k][i]);
        let svd = SVD::new(jacobian.clone(), true, true);
        for _ in 0..3 {
            let now = slip(&course);
            let step = svd.solve(&DVector::from_column_slice(now.as_slice()), 1e-9);
            for (name, step) in moving.iter().zip(step.expect("a solution").iter()) {
                course.set(name, 1, course.get(name, 1) - step);
            }
        }
        assert!(slip(&course).norm() < 1e-8, "{}", self.text);

        let value = |k: usize, coordinate: &eigentol::CoordinateInfo| match coordinate.role {
            Role::Position => course.get(&moving[k], 0),
            Role::Speed => course.get(&moving[k], 1),
            _ => 0.0,
        };
        let q: Vec<f64> = unknowns.iter().enumerate().map(|(k, unknown)| value(k, unknown)).collect();
        let rates: Vec<f64> = (0..q.len()).map(|k| moving.get(k).map_or(0.0, |name| course.get(name, 1))).collect();
        let inputs: Vec<f64> = self.driven.iter().map(|pair| pair.1).collect();
        let design: Vec<f64> = description.design.iter().map(|value| value.nominal).collect();
        let found = accelerations(&machine, &rates, &q, &inputs, &design)
            .unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        for (k, name) in moving.iter().enumerate() {
            course.set(name, 2, found[k]);
        }

        let [drift, _] = derivatives(|t| {
            let slip = self.contact(&course, t).1;
            DVector::from_column_slice(slip.as_slice())
        });
        let size = 1.0 + found[..moving.len()].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(drift.norm() < 1e-6 * size, "slips by {drift}\n{}", self.text);

        // virtual work of inertia, weight and springs, by coordinate
        let mut work = DVector::zeros(moving.len());
        for body in &self.bodies {
            let own = self.motion(body.pose, &course, 0.0);
            let tensor = Matrix3::from_diagonal(&Vector3::from(body.inertia));
            let tensor = own.axes * tensor * own.axes.transpose();
            let force = (own.a - self.gravity) * body.mass;
            let moment = tensor * own.dw + own.w.cross(&(tensor * own.w));
            let base = self.motion(body.pose, &still, 0.0);
            for (k, name) in moving.iter().enumerate() {
                let mut moved = still.clone();
                moved.set(name, 1, 1.0);
                let moved = self.motion(body.pose, &moved, 0.0);
                work[k] += force.dot(&(moved.v - base.v)) + moment.dot(&(moved.w - base.w));
            }
        }
        for (name, stiffness) in &self.springs {
            let k = moving.iter().position(|x| x == name).expect("a coordinate");
            work[k] += stiffness * course.get(name, 0);
        }
        // what reactions at the contact do not account for
        let left = SVD::new(jacobian.transpose(), true, true);
        let reaction = left.solve(&work, 1e-9).expect("a solution");
        let rest = &work - jacobian.transpose() * reaction;
        let scale = 1.0 + work.amax();
        assert!(rest.amax() < 1e-6 * scale, "{rest}{work}\n{}", self.text);
    }

    fn check_all(&self) {
        for seed in 1..4 {
            self.check(seed);
        }
        let subject = Subject::new(&self.text, Limits::default()).expect("it compiles");
        for seed in 1..2 {
            let outcome = check(&subject, &subject.state(seed));
            assert!(outcome.differences.is_empty(), "{:#?}\n{}", outcome.differences, self.text);
        }
    }
}

const RADIUS: f64 = 0.04;
const BALL: &str = "gravity 9.81 m/s^2 along -z;
    body ball: rigid(mass: 0.5 kg, inertia: [0.00032, 0.00032, 0.00032] kg*m^2); point center: ball;";

fn ball(pose: fn(At) -> Pose) -> Body {
    Body { mass: 0.5, inertia: [3.2e-4; 3], pose }
}

/// Displacements, then turns about z, y, x.
fn fly(at: At) -> Pose {
    shift(v(at("px"), at("py"), at("pz"))) * turns(at)
}

fn turns(at: At) -> Pose {
    turn(Vector3::z(), at("psi")) * turn(Vector3::y(), at("beta")) * turn(Vector3::x(), at("phi"))
}

fn table(at: At) -> Pose {
    turn(Vector3::z(), at("spin"))
}

fn machine(more: &str, bodies: Vec<Body>, plane: fn(At) -> Pose) -> Machine {
    Machine {
        text: format!("mechanism Rolling {{ {BALL} {more} }}"),
        bodies,
        plane,
        normal: Vector3::z(),
        axle: None,
        radius: RADIUS,
        gravity: v(0.0, 0.0, -9.81),
        springs: Vec::new(),
        driven: Vec::new(),
        height: "pz",
    }
}

const ROLL: &str = "constraint roll: rolling(wheel: center, radius: 4 cm, on: plate);";

/// However the ball's travel is declared: on a table that turns it can only stand still.
const TRAVEL: [&str; 2] = [
    "joint fly: free(px: x, py: y, pz: z, psi: z, beta: y, phi: x) from ground to ball;",
    "body a: massless; body b: massless; body c: massless; joint px: prismatic(x) from ground to a, coasting;
     joint py: prismatic(y) from a to b, coasting; joint pz: prismatic(z) from b to c;
     joint own: spherical(psi: z, beta: y, phi: x) from c to ball;",
];

const SPRINGS: &str = "force kx: spring(on: px, stiffness: 3 N/m); force ky: spring(on: py, stiffness: 3 N/m);";

#[test]
fn a_driven_table() {
    let table_text = "input omega: rad/s; body table: massless;
        joint spin: revolute(z) from ground to table, driven at omega; point plate: table;";
    for (travel, springs) in [(TRAVEL[0], false), (TRAVEL[0], true), (TRAVEL[1], false)] {
        {
            let held = if springs { SPRINGS } else { "" };
            let mut machine = machine(&format!("{table_text} {travel} {ROLL} {held}"), vec![ball(fly)], table);
            machine.driven = vec![("spin", 6.0)];
            if springs {
                machine.springs = vec![("px", 3.0), ("py", 3.0)];
            }
            machine.check_all();
        }
    }
}

#[test]
fn travel_on_a_turning_table_is_free() {
    let declared = |travel: &str, table: &str| {
        let text = format!("mechanism Rolling {{ {BALL} {table} {travel} {ROLL} }}");
        compile_text(&text, Limits::default()).unwrap_or_else(|error| panic!("{error}"))
    };
    let turning = "input omega: rad/s; body table: massless;
        joint spin: revolute(z) from ground to table, driven at omega; point plate: table;";
    let [free, standing] = TRAVEL.map(|travel| declared(travel, turning).functions.free);
    let note = "slip depends on `px` and `py`: no coasting, only standing still, so free like other coordinates";
    assert!(standing.notes.iter().any(|own| own == note), "{:?}", standing.notes);
    assert!(!free.notes.iter().any(|own| own.contains("slip")), "{:?}", free.notes);
    assert_eq!(free.count, standing.count);
    // on a table at rest it goes on
    let rest = declared(TRAVEL[1], "point plate: ground;").functions.free;
    assert!(!rest.notes.iter().any(|own| own.contains("slip")), "{:?}", rest.notes);
}

#[test]
fn a_table_that_coasts() {
    let table_text = "body table: rigid(mass: 2 kg, inertia: [0.3, 0.3, 0.5] kg*m^2);
        joint spin: revolute(z) from ground to table, coasting; point plate: table;";
    for travel in TRAVEL {
        let disc = Body { mass: 2.0, inertia: [0.3, 0.3, 0.5], pose: table };
        machine(&format!("{table_text} {travel} {ROLL}"), vec![ball(fly), disc], table).check_all();
    }
}

/// The plane stands askew and turns in itself. Where gravity pulls along it, nothing is steady.
#[test]
fn an_inclined_table() {
    fn tilted(at: At) -> Pose {
        turn(Vector3::x(), 0.3) * turn(Vector3::z(), at("spin"))
    }
    fn askew(at: At) -> Pose {
        turn(v(0.0, 1.0, 2.0), at("spin"))
    }
    let mut fixed = machine(
        &format!(
            "kernels only; input omega: rad/s; body frame: massless; body table: massless;
             joint tilt: fixed from ground to frame rotated(x, 0.3 rad);
             joint spin: revolute(z) from frame to table, driven at omega; point plate: table; {} {ROLL}",
            TRAVEL[0]
        ),
        vec![ball(fly)],
        tilted,
    );
    fixed.driven = vec![("spin", -4.0)];
    fixed.check_all();
    let mut own = machine(
        &format!(
            "input omega: rad/s; body table: massless;
             joint spin: revolute([0, 1, 2]) from ground to table, driven at omega; point plate: table; {}
             constraint roll: rolling(wheel: center, radius: 4 cm, on: plate, normal: [0, 1, 2]);",
            TRAVEL[0]
        ),
        vec![ball(fly)],
        askew,
    );
    let normal = v(0.0, 1.0, 2.0);
    own.text = own.text.replace("along -z", "along [0, -1, -2]");
    own.gravity = normal.normalize() * -9.81;
    own.normal = normal;
    own.driven = vec![("spin", 5.0)];
    own.check_all();
}

/// One disc carries another; the ball's place is told from the ground or from the first.
#[test]
fn a_table_on_a_table() {
    let discs = |at: &str| {
        format!(
            "input u: rad/s; input w: rad/s; body lower: massless; body table: massless;
             joint turn: revolute(z) from ground to lower, driven at u;
             joint spin: revolute(z) from lower to table at {at}, driven at w; point plate: table;"
        )
    };
    fn both(at: At) -> Pose {
        turn(Vector3::z(), at("turn")) * turn(Vector3::z(), at("spin"))
    }
    fn beside(at: At) -> Pose {
        turn(Vector3::z(), at("turn")) * shift(v(0.3, 0.0, 0.0)) * turn(Vector3::z(), at("spin"))
    }
    fn on_the_lower(at: At) -> Pose {
        turn(Vector3::z(), at("turn")) * fly(at)
    }
    let driven = vec![("turn", 2.0), ("spin", 3.0)];
    let mut central = machine(&format!("{} {} {ROLL}", discs("[0, 0, 0]"), TRAVEL[0]), vec![ball(fly)], both);
    central.driven = driven.clone();
    central.check_all();
    let carried = TRAVEL[0].replace("from ground", "from lower");
    // nothing balances the pull outwards
    let mut eccentric = machine(
        &format!("kernels only; {} {carried} {ROLL}", discs("[0.3, 0, 0] m")),
        vec![ball(on_the_lower)],
        beside,
    );
    eccentric.driven = driven;
    eccentric.check_all();
    // from the ground the centre of the table goes round
    let text = format!("mechanism Rolling {{ {BALL} {} {} {ROLL} }}", discs("[0.3, 0, 0] m"), TRAVEL[0]);
    let refused = Interpreted::from_text(&text).expect_err("not steady").to_string();
    assert!(refused.contains("depend on the driven coordinate `turn`"), "{refused}");
}

/// What carries the ball turns about the normal of a plane at rest.
#[test]
fn a_carrier_that_turns() {
    fn carried(at: At) -> Pose {
        turn(Vector3::z(), at("spin")) * fly(at)
    }
    fn rest(_: At) -> Pose {
        Pose::identity()
    }
    let travel = TRAVEL[0].replace("from ground", "from carrier");
    let mut driven = machine(
        &format!(
            "input omega: rad/s; body carrier: massless; joint spin: revolute(z) from ground to carrier, driven at omega;
             point plate: ground; {travel} {ROLL}"
        ),
        vec![ball(carried)],
        rest,
    );
    driven.driven = vec![("spin", 3.0)];
    driven.check_all();
    let coasting = machine(
        &format!(
            "body carrier: rigid(mass: 2 kg, inertia: [0.3, 0.3, 0.5] kg*m^2);
             joint spin: revolute(z) from ground to carrier, coasting; point plate: ground; {travel} {ROLL}"
        ),
        vec![ball(carried), Body { mass: 2.0, inertia: [0.3, 0.3, 0.5], pose: table }],
        rest,
    );
    coasting.check_all();
}

/// Both the plane and what carries the ball are driven.
#[test]
fn a_carrier_over_a_turning_table() {
    fn carried(at: At) -> Pose {
        turn(Vector3::z(), at("round")) * fly(at)
    }
    let travel = TRAVEL[0].replace("from ground", "from carrier");
    let mut machine = machine(
        &format!(
            "input omega: rad/s; input w: rad/s; body carrier: massless; body table: massless;
             joint spin: revolute(z) from ground to table, driven at omega;
             joint round: revolute(z) from ground to carrier, driven at w;
             point plate: table; {travel} {ROLL}"
        ),
        vec![ball(carried)],
        table,
    );
    machine.driven = vec![("spin", 3.0), ("round", -2.0)];
    machine.check_all();
}

/// The ball itself turns about the normal, on what only slides.
#[test]
fn a_ball_that_spins_about_the_normal() {
    fn spinning(at: At) -> Pose {
        shift(v(at("px"), at("py"), at("pz"))) * turn(Vector3::x(), at("a")) * turn(Vector3::z(), at("own"))
    }
    let slides = "body s: massless; body t: massless; body w: massless; joint px: prismatic(x) from ground to s;
        joint py: prismatic(y) from s to t; joint pz: prismatic(z) from t to w;";
    for (input, motion, speeds) in
        [("input omega: rad/s;", "driven at omega", vec![("own", 4.0)]), ("", "coasting", Vec::new())]
    {
        let upright = |at: At| shift(v(at("px"), at("py"), at("pz"))) * turn(Vector3::z(), at("own"));
        let mut still = machine(
            &format!(
                "kernels only; {input} {slides} joint own: revolute(z) from w to ball, {motion}; point plate: ground; {ROLL}"
            ),
            vec![ball(upright)],
            |_| Pose::identity(),
        );
        still.driven = speeds.clone();
        still.check_all();
        let mut tilting = machine(
            &format!(
                "{input} {slides} body axle: massless; joint a: revolute(x) from w to axle;
                 joint own: revolute(z) from axle to ball, {motion};
                 body table: rigid(mass: 2 kg, inertia: [0.3, 0.3, 0.5] kg*m^2);
                 joint spin: revolute(z) from ground to table, coasting; point plate: table; {ROLL}"
            ),
            vec![ball(spinning), Body { mass: 2.0, inertia: [0.3, 0.3, 0.5], pose: table }],
            table,
        );
        tilting.driven = speeds;
        tilting.check_all();
    }
}

/// The ball spins about an axis that tilts.
#[test]
fn a_spin_after_a_universal_joint() {
    fn tilting(at: At) -> Pose {
        shift(v(at("px"), at("py"), at("pz")))
            * turn(Vector3::x(), at("a"))
            * turn(Vector3::y(), at("b"))
            * turn(Vector3::z(), at("spin"))
    }
    fn rest(_: At) -> Pose {
        Pose::identity()
    }
    let before = "body s: massless; body t: massless; body fork: massless; joint px: prismatic(x) from ground to s;
        joint py: prismatic(y) from s to t; body w: massless; joint pz: prismatic(z) from t to w;
        joint tilt: universal(a: x, b: y) from w to fork;";
    for (input, motion, speeds) in
        [("input omega: rad/s;", "driven at omega", vec![("spin", 4.0)]), ("", "coasting", Vec::new())]
    {
        for (plane, own) in [
            ("point plate: ground;", rest as fn(At) -> Pose),
            (
                "body table: rigid(mass: 2 kg, inertia: [0.3, 0.3, 0.5] kg*m^2);
                 joint round: revolute(z) from ground to table, coasting; point plate: table;",
                |at| turn(Vector3::z(), at("round")),
            ),
        ] {
            let mut bodies = vec![ball(tilting)];
            if plane.contains("table") {
                bodies.push(Body { mass: 2.0, inertia: [0.3, 0.3, 0.5], pose: own });
            }
            let mut machine = machine(
                &format!("{input} {before} joint spin: revolute(z) from fork to ball, {motion}; {plane} {ROLL}"),
                bodies,
                own,
            );
            machine.driven = speeds.clone();
            machine.check_all();
        }
    }
}

#[test]
fn a_disc_on_a_turning_table() {
    fn rider(at: At) -> Pose {
        shift(v(at("px"), at("py"), at("pz")))
            * turn(Vector3::z(), at("yaw"))
            * turn(Vector3::x(), at("lean"))
            * turn(Vector3::y(), at("roll"))
    }
    let travel = "body s: massless; body t: massless; body w: massless; body y: massless; body fork: massless;
        joint px: prismatic(x) from ground to s; joint py: prismatic(y) from s to t; joint pz: prismatic(z) from t to w;
        joint yaw: revolute(z) from w to y; joint lean: revolute(x) from y to fork; joint roll: revolute(y) from fork to disc;";
    for (input, table_text, motion, speeds) in [
        ("input omega: rad/s;", "body table: massless;", "driven at omega", vec![("spin", 2.0)]),
        ("", "body table: rigid(mass: 2 kg, inertia: [0.3, 0.3, 0.5] kg*m^2);", "coasting", Vec::new()),
    ] {
        let mut bodies = vec![Body { mass: 0.5, inertia: [2e-4, 4e-4, 2e-4], pose: rider }];
        if speeds.is_empty() {
            bodies.push(Body { mass: 2.0, inertia: [0.3, 0.3, 0.5], pose: table });
        }
        let mut machine = machine("", bodies, table);
        machine.text = format!(
            "mechanism Rolling {{ {input} gravity 9.81 m/s^2 along -z; {table_text}
             joint spin: revolute(z) from ground to table, {motion}; point plate: table;
             body disc: rigid(mass: 0.5 kg, inertia: [2e-4, 4e-4, 2e-4] kg*m^2); point center: disc; {travel}
             constraint contact: rolling(wheel: center, axis: y, radius: 4 cm, on: plate); }}"
        );
        machine.axle = Some(Vector3::y());
        machine.driven = speeds;
        machine.check_all();
    }
}

/// The two frequencies of a ball held by springs to the axis of the table: `truth/practice/W4_rolling.json`.
#[test]
fn frequencies_of_a_ball_on_a_turning_table() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/truth/practice/W4_rolling.json");
    let text = std::fs::read_to_string(path).expect("reference values");
    let truth: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let parameter = |name: &str| number(&truth["ball"]["parameters"][name]);
    let [m, r, j, k] = ["m", "r", "J", "k"].map(parameter);
    for travel in TRAVEL.map(|text| text.replace(", coasting", "")) {
        let text = format!(
            "mechanism Ball {{ gravity 9.81 m/s^2 along -z; input omega: rad/s;
                body ball: rigid(mass: {m} kg, inertia: {j} kg*m^2 * [1, 1, 1]); point center: ball;
                body table: massless; joint spin: revolute(z) from ground to table, driven at omega; point plate: table;
                {travel} constraint roll: rolling(wheel: center, radius: {r} m, on: plate);
                force kx: spring(on: px, stiffness: {k} N/m); force ky: spring(on: py, stiffness: {k} N/m); }}"
        );
        let compiled = compile_text(&text, Limits::default()).unwrap_or_else(|error| panic!("{error}"));
        let unknowns = &compiled.functions.unknowns;
        let n = unknowns.len();
        let mut q = vec![0.0; n];
        q[unknowns.iter().position(|unknown| unknown.name == "pz").expect("a height")] = r;
        q[unknowns.iter().position(|unknown| unknown.name == "roll.normal").expect("a force")] = m * 9.81;
        let evaluate = |kernel: &str| {
            let values = compiled.program.evaluate(kernel, &[&q, &[parameter("omega")], &[]]);
            values.expect("a kernel")
        };
        let residual = evaluate("residual");
        assert!(residual[0].iter().all(|x| x.abs() < 1e-12), "{residual:?}");
        let linear = evaluate("linear");
        let least = |frequency: f64| {
            let s = Complex::new(0.0, frequency);
            let mut pencil = DMatrix::from_fn(n, n, |i, j| {
                let [mass, damping, stiffness] = [0, 1, 2].map(|k| linear[k][i * n + j]);
                s * s * mass + s * damping + stiffness
            });
            for mut row in pencil.row_iter_mut() {
                let size = row.norm();
                row /= Complex::from(size);
            }
            SVD::new(pencil, false, false).singular_values.min()
        };
        for value in truth["ball"]["values"].as_array().expect("a list") {
            let frequency = number(value);
            assert!(least(frequency) < 1e-14, "{}", least(frequency));
            assert!(least(1.0001 * frequency) > 1e-7, "{}", least(1.0001 * frequency));
        }
    }
}
