//! Random mechanisms full of special cases, by number: each can be made again by itself.

use std::collections::BTreeMap;

use eigentol_compiler::base::census;
use eigentol_compiler::mechanics::Limits;
use eigentol_oracle::declaration::declaration;
use eigentol_oracle::model::{Force, ForceLaw, Value};
use eigentol_oracle::random::{Plan, Random, Setting};
use rayon::prelude::{IntoParallelIterator, ParallelIterator};

use crate::check::{Outcome, check};
use crate::closing;
use crate::subject::Subject;

/// Most free coordinates: what goes wrong shows in a few, and larger trees take most of the time.
const MOST: usize = 4;

/// Why a tree may be refused: the beginnings of the messages.
const REASONS: [&str; 5] = [
    "no coordinate changes what",
    "no mass moves when",
    "nothing in `Tree` is free to move",
    "nothing resists",
    "the equations of motion depend on the driven coordinate",
];

/// What a tree came to.
pub enum Tree {
    /// Compared, with the special cases that its derivation took.
    Compared(Outcome, BTreeMap<String, u64>),
    /// Without steady motion, or with a coordinate that nothing resists or that has no inertia.
    Refused(Vec<String>),
}

/// Over many trees.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// Trees compared, and trees the compiler refused.
    pub compared: u64,
    /// See [`Tree::Refused`].
    pub refused: u64,
    /// Numbers of trees refused for another reason than that it has no steady motion or that a coordinate is loose.
    pub odd: Vec<u64>,
    /// Numbers of trees with differences.
    pub wrong: Vec<u64>,
    /// Values compared, and those of which rounding left little.
    pub values: usize,
    /// See [`Outcome::blurred`].
    pub blurred: usize,
    /// By special case: in how many trees it was taken.
    pub taken: BTreeMap<String, u64>,
}

impl Summary {
    fn with(mut self, number: u64, tree: Tree) -> Self {
        match tree {
            Tree::Refused(messages) => {
                self.refused += 1;
                let known = |message: &String| REASONS.iter().any(|one| message.starts_with(one));
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

/// The declaration of tree `number`. Most have nothing but springs on their coordinates, because forces have few special cases and
/// take most of the time.
pub fn text(number: u64) -> String {
    let mut random = Random::new(number ^ 0x51AC_1A15);
    let settings = [
        Setting::Still,
        Setting::Spinning,
        Setting::Conveyed,
        Setting::Climbing,
    ];
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
    if !all_forces {
        let free = model.free();
        let springs = free.into_iter().enumerate().map(|(k, coordinate)| Force {
            name: format!("force{k}"),
            law: ForceLaw::Spring {
                coordinate,
                stiffness: Value::Number(30.0),
                rest: Value::Number(0.0),
            },
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
    let limits = Limits {
        explicit_partials: 150,
        ..Limits::NONE
    };
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
        .fold(Summary::default, |summary, number| {
            summary.with(number, tree(number))
        })
        .reduce(Summary::default, Summary::merged)
}
