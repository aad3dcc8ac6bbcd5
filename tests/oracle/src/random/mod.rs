//! Random mechanisms: trees that nobody would draw, and trees full of the special cases for which the compiler has
//! dedicated code.
//!
//! Every model has a steady state and a regular mass matrix. Joints are declared in random order and in either
//! direction; axes are not normalised; values are numbers or multiples of design variables, some shared by several
//! values. Bodies are sums of shapes with holes, every joint keyword and every force law occurs, and drives appear
//! wherever they leave a steady state. Trees of [`Plan::special`] take axes, angles, offsets, masses and inertias from
//! small sets: parallel and equal axes, right angles, zeros, and values close to these.

mod expressions;
mod forces;
mod joints;
mod shapes;
mod tree;
mod values;

use nalgebra::DMatrix;
use proptest::prelude::{Just, Strategy, any, prop_oneof};
use proptest::test_runner::{Config, RngAlgorithm, TestError, TestRng, TestRunner};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::agreement::Case;
use crate::matrices::{Oracle, State};
use crate::model::{Force, ForceLaw, Model, Motion, Value};

/// How the mechanism is mounted on the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// No drive; gravity in any direction.
    Still,
    /// A body driven about the vertical, with gravity along it; further bodies may stand beside it on the ground.
    Spinning,
    /// A body driven along straight lines, gravity in any direction: by Galileo's principle nothing changes.
    Conveyed,
    /// A body driven along the vertical, carrying a body driven about the vertical.
    Climbing,
}

/// A recipe for a random model.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// How the model is mounted on the ground.
    pub setting: Setting,
    /// Number of bodies besides the rotor and the driven bodies of the setting.
    pub bodies: usize,
    /// Adds one more body, driven about its own axis of symmetry.
    pub rotor: bool,
    /// Takes values from small sets.
    pub special: bool,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Plan {
    /// The model of this plan.
    ///
    /// # Panics
    /// When a hundred consecutive attempts have a singular mass matrix.
    pub fn model(&self) -> Model {
        let mut random = Random::new(self.seed);
        for _ in 0..100 {
            let model = self.draft(random.clone());
            if !model.free().is_empty() && is_regular(&model) {
                return self.with_inerters(model);
            }
            random = Random::new(random.bits());
        }
        panic!("no regular model: {self:?}");
    }

    /// Inerters on some coordinates, from numbers of their own: whatever else a seed draws stays.
    pub fn with_inerters(&self, mut model: Model) -> Model {
        let mut random = Random::new(!self.seed);
        for coordinate in model.free() {
            if random.chance(0.1) {
                let inertance = Value::Number(random.between(0.1, 2.0));
                let name = format!("inerter{}", model.forces.len());
                model.forces.push(Force { name, law: ForceLaw::Inerter { coordinate, inertance } });
            }
        }
        model
    }

    /// The first attempt, whether or not its mass matrix is regular.
    pub fn draft(&self, random: Random) -> Model {
        tree::Builder::new(random, self.special).build(self)
    }
}

/// All plans with up to seven bodies. Shrinking removes bodies.
pub fn plans() -> impl Strategy<Value = Plan> {
    let setting =
        prop_oneof![Just(Setting::Still), Just(Setting::Spinning), Just(Setting::Conveyed), Just(Setting::Climbing),];
    let switches = (any::<bool>(), any::<bool>());
    (setting, 1..=7_usize, switches, any::<u64>()).prop_map(|(setting, bodies, (rotor, special), seed)| {
        let driven = match setting {
            Setting::Still => 0,
            Setting::Spinning | Setting::Conveyed => 1,
            Setting::Climbing => 2,
        };
        let bodies = bodies.min(7 - driven - usize::from(rotor));
        Plan { setting, bodies, rotor, special, seed }
    })
}

/// Runs a check on the given number of random plans, always the same ones, and shrinks any plan on which it panics.
///
/// # Panics
/// With the smallest failing plan, and the message of the check.
pub fn on_plans(cases: u32, check: impl Fn(Plan)) {
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 20, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let run = TestRunner::new_with_rng(config, rng).run(&plans(), |plan| {
        check(plan);
        Ok(())
    });
    match run {
        Ok(()) => {}
        Err(TestError::Fail(reason, plan)) => panic!("{plan:?}\n{reason}"),
        Err(TestError::Abort(reason)) => panic!("{reason}"),
    }
}

/// A random state of the free coordinates, well away from poses in which a joint loses a freedom.
pub fn position(model: &Model, random: &mut Random) -> Vec<f64> {
    let limit = |coordinate| match model.step(coordinate).motion {
        Motion::Slide => 0.4,
        Motion::Turn | Motion::Screw { .. } => 1.2,
    };
    let free = model.free();
    let mut q = free.iter().map(|&coordinate| random.between(-1.0, 1.0) * limit(coordinate)).collect::<Vec<_>>();
    joints::leave_singular_poses(model, &mut q);
    q
}

/// Whether at three states the mass matrix, scaled to a unit diagonal, is well away from singular, and no two points
/// that pull each other coincide.
fn is_regular(model: &Model) -> bool {
    let oracle = Oracle::new(model);
    (0..3).all(|seed| {
        let [q, u, b] = Case::random(model, seed).at;
        let motion = oracle.motion(&State::at_rest(&q, &u, &b));
        let mass = motion.mass;
        let scaled = |i: usize, j: usize| mass[i][j] / (mass[i][i] * mass[j][j]).sqrt();
        let heavy = (0..q.len()).all(|i| mass[i][i] > 1e-6);
        let apart = motion.applied.iter().all(|force| force.is_finite());
        apart && heavy && DMatrix::from_fn(q.len(), q.len(), scaled).symmetric_eigenvalues().min() > 1e-5
    })
}

/// A seeded random number generator, the same on every machine.
#[derive(Clone, Debug)]
pub struct Random(ChaCha8Rng);

impl Random {
    /// From a seed.
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Uniform in `[low, high)`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// An index below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        assert!(count > 0, "something to choose from");
        (self.bits() % count as u64) as usize
    }

    /// True with the given probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    /// `size` with a random sign.
    pub fn signed(&mut self, size: f64) -> f64 {
        if self.chance(0.5) { size } else { -size }
    }

    /// A random element of a list.
    pub fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// A vector with components in `[-limit, limit)`.
    pub fn vector(&mut self, limit: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.between(-limit, limit))
    }

    /// Puts a list in random order.
    pub fn shuffle<T>(&mut self, list: &mut [T]) {
        for last in (1..list.len()).rev() {
            list.swap(last, self.below(last + 1));
        }
    }
}
