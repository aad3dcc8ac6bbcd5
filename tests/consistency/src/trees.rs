//! Random mechanisms full of special cases, each reproducible from its number.

use std::collections::BTreeMap;

use eigentol_compiler::census;
use eigentol_compiler::mechanics::Limits;
use eigentol_oracle::declaration::declaration;
use eigentol_oracle::model::{Force, ForceLaw, Value};
use eigentol_oracle::random::{Plan, Random, Setting};
use rayon::prelude::{IntoParallelIterator, ParallelIterator};

use crate::check::{Outcome, check};
use crate::closing;
use crate::subject::Subject;

/// The most free coordinates a tree may have: a few are enough to show a fault, and larger trees take most of the time.
const MOST: usize = 4;

/// Acceptable reasons for refusing a tree, by a part of the message.
const REASONS: [&str; 5] = [
    "no coordinate changes what",
    "no mass moves when",
    "nothing in `Tree` is free to move",
    ", which nothing holds",
    "the equations of motion depend on the driven coordinate",
];

/// The result for one tree.
pub enum Tree {
    /// Compared; with the special cases that its derivation used.
    Compared(Outcome, BTreeMap<String, u64>),
    /// Refused: no steady motion, a load along a free direction, or a coordinate without inertia.
    Refused(Vec<String>),
}

/// The results of many trees.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// Number of trees compared.
    pub compared: u64,
    /// Number of trees refused, see [`Tree::Refused`].
    pub refused: u64,
    /// Numbers of the trees refused for an unexpected reason.
    pub odd: Vec<u64>,
    /// Numbers of trees with differences.
    pub wrong: Vec<u64>,
    /// Number of values compared.
    pub values: usize,
    /// See [`Outcome::blurred`].
    pub blurred: usize,
    /// For each special case, the number of trees that used it.
    pub taken: BTreeMap<String, u64>,
}

impl Summary {
    fn with(mut self, number: u64, tree: Tree) -> Self {
        match tree {
            Tree::Refused(messages) => {
                self.refused += 1;
                let known = |message: &String| REASONS.iter().any(|one| message.contains(one));
                if !messages.iter().all(known) {
                    self.odd.push(number);
                }
            }
            Tree::Compared(outcome, taken) => {
                self.compared += 1;
                self.values += outcome.compared;
                self.blurred += outcome.blurred;
                if !outcome.differences.is_empty() {
                    self.wrong.push(number);
                }
                for case in taken.into_keys() {
                    *self.taken.entry(case).or_default() += 1;
                }
            }
        }
        self
    }

    fn merged(mut self, other: Self) -> Self {
        self.compared += other.compared;
        self.refused += other.refused;
        self.odd.extend(other.odd);
        self.wrong.extend(other.wrong);
        self.values += other.values;
        self.blurred += other.blurred;
        for (case, count) in other.taken {
            *self.taken.entry(case).or_default() += count;
        }
        self
    }
}

/// The declaration of tree `number`. Most trees have only springs on their coordinates: other forces have few special
/// cases but take most of the time.
pub fn text(number: u64) -> String {
    let mut random = Random::new(number ^ 0x51AC_1A15);
    let settings = [Setting::Still, Setting::Spinning, Setting::Conveyed, Setting::Climbing];
    let (all_forces, closes) = (random.chance(0.2), random.chance(0.25));
    let plan = Plan {
        setting: match closes && random.chance(0.6) {
            // a loop around a drive has no steady state
            true => Setting::Still,
            false => random.of(&settings),
        },
        bodies: random.of(&[2, 2, 3, 3, 3, 4]),
        rotor: random.chance(0.2),
        special: random.chance(0.95),
        seed: number,
    };
    let mut model = plan.draft(random.clone());
    while model.free().len() > MOST {
        random.bits();
        model = plan.draft(random.clone());
    }
    let mut model = plan.with_inerters(model);
    if !all_forces {
        let free = model.free();
        let springs = free.into_iter().enumerate().map(|(k, coordinate)| Force {
            name: format!("force{k}"),
            law: ForceLaw::Spring { coordinate, stiffness: Value::Number(30.0), rest: Value::Number(0.0) },
        });
        model.forces = springs.collect();
    }
    let text = declaration(&model);
    if !closes {
        return text;
    }
    let end = text.rfind('}').expect("a closing brace");
    let items = closing::items(&model, &mut random);
    format!("{}    {items}\n}}\n", &text[..end])
}

/// Compiles tree `number` and compares its kernels.
pub fn tree(number: u64) -> Tree {
    let limits = Limits { explicit_partials: 150, ..Limits::NONE };
    census::take();
    match Subject::new(&text(number), limits) {
        Ok(subject) => {
            let taken = census::take();
            Tree::Compared(check(&subject, &subject.state(number)), taken)
        }
        Err(messages) => Tree::Refused(messages),
    }
}

/// Trees `from..to`.
pub fn summary(from: u64, to: u64) -> Summary {
    (from..to)
        .into_par_iter()
        .fold(Summary::default, |summary, number| summary.with(number, tree(number)))
        .reduce(Summary::default, Summary::merged)
}
