//! A tree, and the same tree with one joint cut.

use std::collections::BTreeSet;
use std::fmt::{self, Display};

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_compiler::program::Program;
use eigentol_oracle::agreement::Case;
use eigentol_oracle::declaration::declaration;
use eigentol_oracle::model::{Joint, Model, Word};
use eigentol_oracle::random::{Plan, Random};
use nalgebra::DMatrix;

use super::double::{Closing, LOOSE, cut_text, without_forces_on};
use super::pose::{Embedding, embedding};

struct Compiled {
    program: Program,
    /// The names of the unknowns: coordinates, then reactions.
    names: Vec<String>,
    reactions: usize,
}

impl Compiled {
    fn new(text: &str) -> Result<Self, Vec<String>> {
        let tokens = text.parse().expect("tokens");
        let none = Limits { explicit_partials: 0, partial_operations: usize::MAX, motion_linear: 0 };
        let found = compile(tokens, none).map_err(|mistakes| {
            let messages = mistakes.iter().map(|mistake| mistake.message.clone());
            messages.collect::<Vec<_>>()
        })?;
        let unknowns = &found.functions.unknowns;
        let is_reaction = |role: &Role| matches!(role, Role::PositionReaction);
        Ok(Self {
            names: unknowns.iter().map(|one| one.name.clone()).collect(),
            reactions: unknowns.iter().filter(|one| is_reaction(&one.role)).count(),
            program: found.program,
        })
    }

    /// Every array that is compared: a matrix with one row per unknown.
    fn arrays(&self, x: &[f64], u: &[f64], b: &[f64]) -> [DMatrix<f64>; 6] {
        let evaluate = |kernel: &str| {
            let found = self.program.evaluate(kernel, &[x, u, b]);
            found.unwrap_or_else(|| panic!("there is a kernel {kernel}"))
        };
        let matrix = |array: &[f64]| {
            let columns = array.len() / x.len();
            DMatrix::from_row_slice(x.len(), columns, array)
        };
        let residual = evaluate("residual");
        let linear = evaluate("linear");
        let partials = evaluate("residual_partials");
        [&residual[0], &linear[0], &linear[1], &linear[2], &partials[0], &partials[1]].map(|array| matrix(array))
    }
}

/// `None` if nothing balances a load.
fn resisted(text: &str) -> Option<Compiled> {
    Compiled::new(text)
        .inspect_err(|mistakes| {
            let unresisted = |mistake: &String| mistake.ends_with("which nothing holds");
            assert!(mistakes.iter().all(unresisted), "{mistakes:?}\n{text}");
        })
        .ok()
}

/// A tree, the joint cut in its double, and both compiled.
pub(crate) struct Pair {
    model: Model,
    joint: usize,
    closing: Closing,
    case: Case,
    pub(crate) embedding: Embedding,
    open: Compiled,
    cut: Compiled,
    text: String,
}

impl Pair {
    /// `None` if no joint can be cut this way, or if nothing balances a load without the forces on the cut joint.
    pub(crate) fn new(plan: Plan, closing: Closing) -> Option<Self> {
        let mut random = Random::new(plan.seed);
        let tree = plan.model();
        let can_be_cut = |joint: &Joint| {
            let driven = joint.steps.iter().any(|step| step.drive.is_some());
            let word = match closing.by_constraints {
                true => matches!(joint.word, Word::Fixed | Word::Revolute | Word::Spherical),
                false => !matches!(joint.word, Word::Screw | Word::Free),
            };
            word && !driven
        };
        let places: Vec<usize> = (0..tree.joints.len()).filter(|&place| can_be_cut(&tree.joints[place])).collect();
        // choose a kind first, because most joints are hinges
        let kinds: BTreeSet<Word> = places.iter().map(|&k| tree.joints[k].word).collect();
        let kinds: Vec<Word> = kinds.into_iter().collect();
        if kinds.is_empty() {
            return None;
        }
        let kind = random.of(&kinds);
        let of_kind: Vec<usize> = places.into_iter().filter(|&k| tree.joints[k].word == kind).collect();
        let joint = random.of(&of_kind);
        let model = without_forces_on(tree, joint);
        if model.free().is_empty() {
            return None;
        }
        let open = resisted(&declaration(&model))?;

        let case = Case::random(&model, plan.seed);
        let free = model.free();
        let values: Vec<f64> =
            free.iter().zip(&case.at[0]).filter(|(coordinate, _)| coordinate.joint == joint).map(|(_, &q)| q).collect();
        let embedding = embedding(&model.joints[joint], &values, &case.at[2], closing.placed);
        let text = cut_text(&model, joint, &embedding, closing);
        // A body on a ball joint that turns freely about the vertical: this rotation is a coordinate of the double but
        // not of the ball joint.
        let cut = resisted(&text)?;
        Some(Self { model, joint, closing, case, embedding, open, cut, text })
    }

    /// `dQ/dq`, one row per coordinate of the double.
    fn tangent(&self) -> DMatrix<f64> {
        let free = self.model.free();
        let positions = self.cut.names.len() - self.cut.reactions;
        let mut tangent = DMatrix::zeros(positions, free.len());
        for (column, &coordinate) in free.iter().enumerate() {
            if coordinate.joint != self.joint {
                let row = self.row(&self.model.step(coordinate).name);
                tangent[(row, column)] = 1.0;
                continue;
            }
            for (k, slope) in self.embedding.slope[coordinate.step].iter().enumerate() {
                tangent[(self.row(LOOSE[k]), column)] = *slope;
            }
        }
        tangent
    }

    fn row(&self, name: &str) -> usize {
        let place = self.cut.names.iter().position(|other| other == name);
        place.unwrap_or_else(|| panic!("{name} is an unknown: {self}"))
    }

    /// The assembled state with random reactions.
    fn state(&self, seed: u64) -> Vec<f64> {
        let mut random = Random::new(seed ^ 0xC0FF_EE00);
        let mut x: Vec<f64> = self.cut.names.iter().map(|_| random.between(-9.0, 9.0)).collect();
        let free = self.model.free();
        for (coordinate, q) in free.iter().zip(&self.case.at[0]) {
            if coordinate.joint != self.joint {
                x[self.row(&self.model.step(*coordinate).name)] = *q;
            }
        }
        for (name, value) in LOOSE.iter().zip(self.embedding.value) {
            x[self.row(name)] = value;
        }
        x
    }

    /// `sum_i r_i d2 Q_i / dq dq`, `r` the residual.
    fn curvature(&self, residual: &DMatrix<f64>) -> DMatrix<f64> {
        let free = self.model.free();
        DMatrix::from_fn(free.len(), free.len(), |i, j| {
            let [one, other] = [free[i], free[j]];
            if one.joint != self.joint || other.joint != self.joint {
                return 0.0;
            }
            let own = &self.embedding.curvature[one.step][other.step];
            let terms = LOOSE.iter().zip(own);
            terms.map(|(name, second)| residual[(self.row(name), 0)] * second).sum()
        })
    }

    /// The keyword of the cut joint.
    pub(crate) fn word(&self) -> Word {
        self.model.joints[self.joint].word
    }

    /// The largest error relative to the size of the terms; if they disagree, every difference.
    pub(crate) fn compare(&self, seed: u64) -> Result<f64, String> {
        let freedom = self.cut.names.len() - 2 * self.cut.reactions;
        let n = self.open.names.len();
        let motions = self.model.joints[self.joint].steps.len();
        if freedom != n || self.cut.reactions != 6 - motions {
            return Err(format!("freedom {freedom}, not {n}"));
        }
        let [q, u, b] = &self.case.at;
        let x = self.state(seed);
        let open = self.open.arrays(q, u, b);
        let cut = self.cut.arrays(&x, u, b);
        let positions = x.len() - self.cut.reactions;
        let tangent = self.tangent();

        let mut report = Report::default();
        let gaps = cut[0].rows_range(positions..).into_owned();
        report.compare("gaps", &gaps, &(0.0 * &gaps), 1.0);
        let jacobian = cut[3].view((positions, 0), (self.cut.reactions, positions));
        let motion = jacobian * &tangent;
        let size = jacobian.amax() * tangent.amax();
        report.compare("Phi_q P", &motion, &(0.0 * &motion), size);

        let names = ["residual", "mass", "damping", "stiffness", "by input", "by design"];
        // If the free joint has no placements, the state itself moves with the design.
        let compared = if self.closing.placed { 6 } else { 5 };
        for k in 0..compared {
            let rows = cut[k].rows_range(..positions);
            let square = (1..=3).contains(&k);
            let inner = match square {
                true => rows.columns_range(..positions) * &tangent,
                false => rows.into_owned(),
            };
            let mut reduced = tangent.transpose() * &inner;
            if k == 3 {
                reduced += self.curvature(&cut[0]);
            }
            let terms = rows.amax() * tangent.amax().powi(if square { 2 } else { 1 });
            report.compare(names[k], &reduced, &open[k], terms.max(cut[0].amax()));
        }
        report.outcome()
    }
}

#[derive(Default)]
struct Report {
    worst: f64,
    text: String,
}

impl Report {
    fn compare(&mut self, what: &str, d_matrix: &DMatrix<f64>, expected: &DMatrix<f64>, size: f64) {
        if d_matrix.shape() != expected.shape() {
            self.text += &format!("{what}: {:?}, not {:?}\n", d_matrix.shape(), expected.shape());
            return;
        }
        for (one, other) in d_matrix.iter().zip(expected) {
            let error = (one - other).abs() / size.max(expected.amax()).max(1e-3);
            // NaN is not agreement.
            let agrees = error <= super::TOLERANCE;
            if !agrees {
                self.text += &format!("{what}: {one:e}, not {other:e}\n");
            }
            self.worst = self.worst.max(error);
        }
    }

    fn outcome(self) -> Result<f64, String> {
        match self.text.is_empty() {
            true => Ok(self.worst),
            false => Err(self.text),
        }
    }
}

impl Display for Pair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}", declaration(&self.model), self.text)
    }
}
