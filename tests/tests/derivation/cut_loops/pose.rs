//! The pose that a joint gives its `to` side, as coordinates of a `free` joint, with first and second derivatives in
//! hyper-dual numbers. Shares no code with the compiler.

use eigentol::Real;
use eigentol_oracle::model::{Joint, Motion, Placement, Step, Value};
use eigentol_tests::hyper::Hyper;

type Matrix = [[Hyper; 3]; 3];

#[derive(Clone, Copy)]
struct Pose {
    rotation: Matrix,
    origin: [Hyper; 3],
}

fn number(value: f64) -> Hyper {
    Hyper::constant(value)
}

fn sum(terms: [Hyper; 3]) -> Hyper {
    terms[0] + terms[1] + terms[2]
}

fn times(a: &Matrix, v: [Hyper; 3]) -> [Hyper; 3] {
    a.map(|row| sum(std::array::from_fn(|k| row[k] * v[k])))
}

/// Rodrigues' formula: `e e^T + cos (1 - e e^T) + sin [e]x`.
fn turn(axis: [f64; 3], angle: Hyper) -> Matrix {
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let e = axis.map(|x| x / length);
    let (sine, cosine) = angle.sin_cos();
    let cross = [[0.0, -e[2], e[1]], [e[2], 0.0, -e[0]], [-e[1], e[0], 0.0]];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let square = number(e[i] * e[j]);
            let one = number(f64::from(u8::from(i == j)));
            square + cosine * (one - square) + sine * number(cross[i][j])
        })
    })
}

impl Pose {
    const fn of(rotation: Matrix, origin: [Hyper; 3]) -> Self {
        Self { rotation, origin }
    }

    fn then(self, inner: Self) -> Self {
        let columns: [[Hyper; 3]; 3] =
            std::array::from_fn(|j| times(&self.rotation, std::array::from_fn(|i| inner.rotation[i][j])));
        let moved = times(&self.rotation, inner.origin);
        Self {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i])),
            origin: std::array::from_fn(|i| self.origin[i] + moved[i]),
        }
    }

    fn inverse(self) -> Self {
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| self.rotation[j][i]));
        Self { rotation, origin: times(&rotation, self.origin).map(|x| -x) }
    }
}

fn at_rest() -> Pose {
    Pose::of(turn([1.0, 0.0, 0.0], number(0.0)), [number(0.0); 3])
}

fn value(value: Value, design: &[f64]) -> f64 {
    match value {
        Value::Number(number) => number,
        Value::Design { variable, factor } => factor * design[variable],
    }
}

fn placement(placement: &Placement, design: &[f64]) -> Pose {
    let origin = placement.offset.map(|one| number(value(one, design)));
    let start = Pose { origin, ..at_rest() };
    placement.rotations.iter().fold(start, |pose, (axis, angle)| {
        let rotation = turn(*axis, number(value(*angle, design)));
        pose.then(Pose { rotation, ..at_rest() })
    })
}

fn step(step: &Step, q: Hyper, design: &[f64]) -> Pose {
    let length = step.axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let along = |size: Hyper| step.axis.map(|x| number(x / length) * size);
    match step.motion {
        Motion::Slide => Pose { origin: along(q), ..at_rest() },
        Motion::Turn => Pose { rotation: turn(step.axis, q), ..at_rest() },
        Motion::Screw { lead } => Pose { rotation: turn(step.axis, q), origin: along(q * number(value(lead, design))) },
    }
}

/// The last three axes of a `free` joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turns {
    Zyx,
    Zxz,
}

impl Turns {
    pub(crate) fn axes(self) -> [[f64; 3]; 3] {
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        match self {
            Self::Zyx => [z, y, x],
            Self::Zxz => [z, x, z],
        }
    }

    fn angles(self, r: &Matrix) -> [Hyper; 3] {
        match self {
            Self::Zyx => [r[1][0].atan2(r[0][0]), (-r[2][0]).asin(), r[2][1].atan2(r[2][2])],
            Self::Zxz => [r[0][2].atan2(-r[1][2]), r[2][2].acos(), r[2][0].atan2(r[2][1])],
        }
    }
}

/// Six coordinates of a `free` joint, and their derivatives by the coordinates of the joint it replaces.
#[derive(Clone)]
pub(crate) struct Embedding {
    pub(crate) turns: Turns,
    pub(crate) value: [f64; 6],
    /// First derivatives, by coordinate of the joint.
    pub(crate) slope: Vec<[f64; 6]>,
    pub(crate) curvature: Vec<Vec<[f64; 6]>>,
}

/// With `placed`, the free joint has the placements of the joint; otherwise none.
pub(crate) fn embedding(joint: &Joint, q: &[f64], design: &[f64], placed: bool) -> Embedding {
    let pose = |along: [Option<usize>; 2]| {
        let moved = joint.steps.iter().zip(q).enumerate();
        let motion = moved.fold(at_rest(), |pose, (k, (one, &value))| {
            let [first, second] = along.map(|along| f64::from(u8::from(along == Some(k))));
            let q = Hyper::new([value, first, second, 0.0]);
            pose.then(step(one, q, design))
        });
        if placed {
            return motion;
        }
        let [from, to] = [&joint.from_placement, &joint.to_placement].map(|one| placement(one, design));
        from.then(motion).then(to.inverse())
    };
    let here = pose([None; 2]);
    // Each is far from its singular pose where the other is near its own.
    let turns = match here.rotation[2][0].value().abs() < 0.7 {
        true => Turns::Zyx,
        false => Turns::Zxz,
    };
    let coordinates = |along| -> [Hyper; 6] {
        let Pose { rotation, origin } = pose(along);
        let ([x, y, z], [a, b, c]) = (origin, turns.angles(&rotation));
        [x, y, z, a, b, c]
    };
    let part = |along, k: usize| coordinates(along).map(|one| one.parts()[k]);
    let count = joint.steps.len();
    Embedding {
        turns,
        value: part([None; 2], 0),
        slope: (0..count).map(|i| part([Some(i), None], 1)).collect(),
        curvature: (0..count).map(|i| (0..count).map(|j| part([Some(i), Some(j)], 3)).collect()).collect(),
    }
}
