//! Errors of solving a mechanism, in the user's terms.

mod reason;

pub use reason::{NoDerivative, NotClosed, NotFound};

use thiserror::Error as ThisError;

use crate::{Text, Unit};

/// A constant of the program. Under this name, serde does not expect it in the data it reads.
type Word = &'static str;

/// A failure of one of the solvers. Values are SI.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Error {
    /// An input, a design variable or a start value is NaN or infinite.
    #[error("{kind} `{name}` is {value}: give a finite value")]
    NotFinite {
        /// Kind of quantity: `input`, `design variable`, `start value of coordinate` ...
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::word"))]
        kind: Word,
        /// Its declared name.
        name: Text,
        /// Its value.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        value: f64,
    },
    /// A list does not have one value for each input, design variable or unknown.
    #[error("{found} {kind} given where the mechanism has {expected}")]
    WrongLength {
        /// Kind of list: `inputs`, `design variables`, `start values` ...
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::word"))]
        kind: Word,
        /// Number of values given.
        found: usize,
        /// Number of values that the mechanism needs.
        expected: usize,
    },
    /// A physical requirement is violated.
    #[error("{quantity} must be {requirement}, but is {}", six_digits(*value))]
    Unphysical {
        /// The quantity at fault, for example `mass of bar1`.
        quantity: Text,
        /// The requirement.
        requirement: Text,
        /// Its value.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        value: f64,
    },
    /// The residual or its derivatives are NaN or infinite although all arguments are finite.
    #[error(
        "{what} of `{mechanism}` is not finite at q = {coordinates:?}: the state lies outside the \
         domain of an expression"
    )]
    OutsideDomain {
        /// Name of the mechanism.
        mechanism: Text,
        /// What was evaluated.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::word"))]
        what: Word,
        /// State at which it was evaluated.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        coordinates: Vec<f64>,
    },
    /// An output is NaN or infinite at an equilibrium.
    #[error(
        "output `{output}` has no finite value at q = {coordinates:?}: it divides by zero, or leaves the domain of a \
         function"
    )]
    InfiniteOutput {
        /// Name of the output.
        output: Text,
        /// The equilibrium.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        coordinates: Vec<f64>,
    },
    /// An output has a value at an equilibrium but no derivative, so nothing says how it vibrates.
    #[error(
        "output `{output}` has a value here but no derivative, like the length of a vector that is zero, so it has no \
         amplitude of vibration: leave it out, or make outputs of the components"
    )]
    NotSmooth {
        /// Name of the output.
        output: Text,
    },
    /// No equilibrium was found from the start value.
    #[error(
        "no equilibrium found after {iterations} iterations ({reason}); last state q = {coordinates:?}, \
         relative residual {relative_residual:.3e}: try another start value"
    )]
    NoEquilibrium {
        /// Why the search ended.
        reason: NotFound,
        /// Iterations spent.
        iterations: usize,
        /// Last state.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        coordinates: Vec<f64>,
        /// Residual there, relative to its forces and stiffnesses.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        relative_residual: f64,
    },
    /// The constraints cannot all be met from the start values.
    #[error(
        "the mechanism cannot be assembled: {reason}. `{constraint}` stays open by {gap:.6e} {unit}{}",
        listed(.others)
    )]
    NotAssembled {
        /// Why it cannot.
        reason: NotClosed,
        /// The row with the largest gap, relative to the motions that could close it.
        constraint: Text,
        /// Its gap, SI.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        gap: f64,
        /// Unit of the gap: `m` or `rad`, for a constraint on velocities `m/s` or `rad/s`; empty for a dimensionless
        /// number.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::word"))]
        unit: Word,
        /// The other open rows and their gaps, SI.
        others: Vec<(Text, f64)>,
        /// State with the smallest gaps.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        coordinates: Vec<f64>,
        /// Iterations spent.
        iterations: usize,
    },
    /// Constraints become dependent at exactly this configuration, so the linearisation does not determine how the
    /// mechanism can move.
    #[error(
        "singular configuration: the mechanism is at a dead centre or where motions branch, and constraints are \
         redundant only here ({}), so the linearised mechanism does not say how it can move",
        names(.constraints)
    )]
    SingularConfiguration {
        /// The dependent rows.
        constraints: Vec<Text>,
    },
    /// The search ended next to a singular configuration in which the forces do not balance. On the way there they seem
    /// to balance, through reactions that grow without bound.
    #[error(
        "no equilibrium: near q = {coordinates:?} constraints become redundant ({}), and no finite reactions balance \
         the forces: start farther away, on the side to which the mechanism is to move",
        names(.constraints)
    )]
    UnboundedReactions {
        /// The dependent rows.
        constraints: Vec<Text>,
        /// Last state.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        coordinates: Vec<f64>,
    },
    /// At the equilibrium a beam has turned so far that its coordinates describe it badly.
    #[error(
        "at the equilibrium beam `{beam}` turns by {degrees:.0} degrees between its root and another section, and no beam \
         may turn by more than 150: divide it into two in series"
    )]
    BentTooFar {
        /// Name of the beam.
        beam: Text,
        /// The angle, degrees.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        degrees: f64,
    },
    /// The mass matrix is not positive definite: a coordinate moves no mass.
    #[error(
        "the mass matrix is singular: coordinate `{coordinate}` moves no mass of its own, so it has no \
         natural frequency"
    )]
    SingularMass {
        /// The coordinate whose pivot vanishes.
        coordinate: Text,
    },
    /// A shaft is not one that can be computed, or its modes were not found.
    #[error("shafts: {reason}")]
    Shaft {
        /// What is wrong.
        reason: Text,
    },
    /// A question that takes all modes or all equations, of a mechanism with shafts.
    #[error(
        "{what}: not for mechanisms with a `shaft`, whose equations are not all compiled; chains of `beam`s have them"
    )]
    NotWithShafts {
        /// What was asked.
        what: Text,
    },
    /// The stiffness matrix is singular: the equilibrium is a critical state.
    #[error(
        "the stiffness matrix is singular at this equilibrium: its shift by design variables is not defined. At a \
         critical state only the critical value has derivatives; a direction without stiffness needs a spring or a drive"
    )]
    CriticalState,
    /// A redundant constraint agrees with the others only at these values of the variables.
    #[error(
        "constraint `{constraint}` agrees with the others at these values only: the mechanism cannot be assembled with \
         another `{variable}`, so there are no derivatives. Free a direction that the constraints hold twice"
    )]
    ClosesHereOnly {
        /// The redundant constraint.
        constraint: Text,
        /// The input or design variable that breaks it.
        variable: Text,
    },
    /// The member of a family of steady motions cannot be held by these unknowns.
    #[error("{}", not_held(.unknowns, *.dimension))]
    NotHeld {
        /// The unknowns that were to be held.
        unknowns: Vec<Text>,
        /// The number of parameters of the family; zero if the steady motion is the only one nearby.
        dimension: usize,
    },
    /// The loads along a motion that nothing resists balance only at these values of the variables.
    #[error(
        "nothing holds {}, and the loads along it balance at these values only: with another `{variable}` there is no \
         equilibrium, so there are no derivatives. Hold it by a spring, let it run against a drag, or make one load a \
         function of the other",
        names(.coordinates)
    )]
    BalancesHereOnly {
        /// The coordinates that move together.
        coordinates: Vec<Text>,
        /// The input or design variable that breaks the balance.
        variable: Text,
    },
    /// The stiffness matrix is not symmetric, so undamped symmetric modes do not exist.
    #[error("the stiffness matrix is not symmetric (relative difference {asymmetry:.3e}): ask for general modes")]
    NonsymmetricStiffness {
        /// Largest difference of mirrored elements, relative to the largest element.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        asymmetry: f64,
    },
    /// Undamped modes were requested, but speeds or constraints on velocities make motions of first order.
    #[error("speeds and constraints on velocities have no undamped symmetric modes: ask for general modes")]
    NoUndampedModes,
    /// The eigenvalue iteration did not converge, or a pair failed its residual check.
    #[error("mode {} was not found to working accuracy: relative residual {residual:.3e}", .mode + 1)]
    ModesNotFound {
        /// Position of the worst pair, from 0.
        mode: usize,
        /// Its residual relative to the sizes of `Khat` and `lambda Mhat`.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        residual: f64,
    },
    /// The coefficients are periodic in the angle of a drive, and not by a small part.
    #[error(
        "the coefficients are periodic in the angle of the drive, and not by a small part: harmonics that are left out move an \
         eigenvalue by about {:.1} %. That takes the theory of Floquet, which is not supported",
        100.0 * .error
    )]
    PeriodicCoefficients {
        /// Estimated relative error of an eigenvalue.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        error: f64,
    },
    /// Blades on a support that is not symmetric about their axis have different values.
    #[error(
        "`{}` and `{}` differ: unequal blades on a support that is not symmetric make the coefficients periodic. That takes the \
         theory of Floquet, which is not supported. Give them one value; each may keep a tolerance of its own",
        .variables[0], .variables[1]
    )]
    UnequalBlades {
        /// Names of design variables.
        variables: [Text; 2],
    },
    /// The square of an eigenvalue exceeds the range of a double.
    #[error(
        "the eigenvalue of mode {} is {size:.3e} 1/s, and its square exceeds the range of a double: a mass is far too \
         small, or a stiffness, a damping or a speed far too great",
        .mode + 1
    )]
    EigenvalueRange {
        /// Position of the mode, from 0.
        mode: usize,
        /// `|s|`, 1/s.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        size: f64,
    },
    /// The frequency of a mode was requested that does not oscillate.
    #[error("mode {} does not oscillate (lambda = {lambda:.6e}): it has no frequency", .mode + 1)]
    NotOscillating {
        /// Position of the mode, from 0.
        mode: usize,
        /// Its eigenvalue, 1/s^2.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        lambda: f64,
    },
    /// A mode was requested that does not exist.
    #[error("there is no mode {}: the mechanism has {count}", .mode + 1)]
    NoSuchMode {
        /// The position requested.
        mode: usize,
        /// How many modes there are.
        count: usize,
    },
    /// A mode belongs to a cluster of nearly equal eigenvalues and has no derivative of its own.
    #[error(
        "mode {} lies in a cluster of nearly equal eigenvalues: it has no derivative of its own",
        .mode + 1
    )]
    ClusteredMode {
        /// Position of the mode, from 0.
        mode: usize,
    },
    /// A part of a shaft between stations that stand still vibrates at the frequency of a mode, as in a bar on which nothing acts:
    /// how its ends resist is known beside it only.
    #[error(
        "a part of a shaft vibrates between stations that stand still at the frequency of mode {}: it has first derivatives \
         only",
        .mode + 1
    )]
    NextToPole {
        /// Position of the mode, from 0.
        mode: usize,
    },
    /// Modes have merged into one defective eigenvalue (a single mode with its conjugate), or are so close to it that
    /// rounding hides their coupling.
    #[error(
        "{} a defective eigenvalue. It splits as the square root of any change and has no derivative; move the operating \
         point or sample the whole problem",
        merged(.modes)
    )]
    Defective {
        /// Positions of the modes, from 0.
        modes: Vec<usize>,
    },
    /// A forced vibration was requested of a mechanism that nothing excites.
    #[error("`{mechanism}` has no excitation: declare an `unbalance`, a `harmonic` force or a `shaken` joint")]
    NoExcitation {
        /// Name of the mechanism.
        mechanism: Text,
    },
    /// The frequency of an excitation is zero.
    #[error(
        "excitation `{excitation}` has the frequency zero: it does not shake but loads steadily. Give its frequency, or \
         the speed that it follows, another value"
    )]
    NoFrequency {
        /// Declared name of the excitation.
        excitation: Text,
    },
    /// An excitation drives a vibration that nothing limits.
    #[error(
        "excitation `{excitation}` drives {} at {} rad/s without any resistance: there is no steady vibration. Add damping, \
         or move the frequency",
        resonant(*.mode), six_digits(*frequency)
    )]
    Resonance {
        /// Declared name of the excitation.
        excitation: Text,
        /// Its frequency, rad/s.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        frequency: f64,
        /// Position of the mode with this natural frequency, from 0, if there is one.
        mode: Option<usize>,
    },
    /// No sign change was found in the range.
    #[error(
        "no {what} in the range {} to {} of input `{input}`",
        six_digits(unit.from_si(*low)),
        valued(*high, unit)
    )]
    NotInRange {
        /// What was searched for: `critical value` or `crossing`.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::word"))]
        what: Word,
        /// Name of the input.
        input: Text,
        /// Lower end, SI.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        low: f64,
        /// Upper end, SI.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        high: f64,
        /// Unit of the input.
        unit: Unit,
    },
    /// A branch of equilibria cannot be followed any farther.
    #[error(
        "the branch cannot be followed beyond {} of input `{input}` ({reason}); last equilibrium q = {coordinates:?}",
        valued(*value, unit)
    )]
    BranchLost {
        /// Why it cannot.
        reason: NotFound,
        /// Name of the input.
        input: Text,
        /// Its value at the last equilibrium, SI.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        value: f64,
        /// Unit of the input.
        unit: Unit,
        /// Coordinates of the last equilibrium.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        coordinates: Vec<f64>,
    },
    /// A derivative of a critical value, a crossing or an output does not exist.
    #[error("the sensitivity does not exist: {reason}")]
    NoSensitivity {
        /// Why there is none.
        reason: NoDerivative,
    },
    /// A setting is invalid.
    #[error("{setting}: {reason}")]
    Setting {
        /// The setting.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::word"))]
        setting: Word,
        /// Why it is refused.
        reason: String,
    },
    /// A handle belongs to another mechanism: its index is out of range.
    #[error("there is no {kind} number {index} in `{mechanism}`, which has {count}")]
    UnknownHandle {
        /// `coordinate`, `input` or `design variable`.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::word"))]
        kind: Word,
        /// The handle's index.
        index: usize,
        /// Name of the mechanism.
        mechanism: Text,
        /// How many of that kind the mechanism has.
        count: usize,
    },
    /// Nothing has this name.
    #[error("`{mechanism}` has no {kind} `{name}`: it has {}", names(.known))]
    UnknownName {
        /// `coordinate`, `input`, `design variable` or `output`.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::word"))]
        kind: Word,
        /// The name that was searched for.
        name: String,
        /// Name of the mechanism.
        mechanism: Text,
        /// The names that exist.
        known: Vec<Text>,
    },
    /// The probability cannot be computed from a design point.
    #[error("{}. Sampling needs no design point", unreliable(.0))]
    NoReliability(Box<eigentol_statistics::Error>),
    /// No tolerances within their limits meet the requirements.
    #[error(
        "no tolerances within the limits meet the requirements: at the best ones found, requirement {} fails with \
         probability {probability:.3e} where {wanted:.3e} is allowed",
        .requirement + 1
    )]
    Infeasible {
        /// The best nominal values found, SI.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        nominal: Vec<f64>,
        /// The best half-widths found, SI.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        half_widths: Vec<f64>,
        /// Position of the requirement with the largest shortfall.
        requirement: usize,
        /// Its probability of failure to first order.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        probability: f64,
        /// The probability that is allowed.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        wanted: f64,
    },
    /// A response has no value at some of the designs that a method needs.
    #[error(
        "response {} has no value at {missing} of the {needed} designs that {method} needs: sample instead, which counts them",
        .response + 1
    )]
    NoResponse {
        /// Position of the response, from 0.
        response: usize,
        /// Number of designs at which it has no value.
        missing: usize,
        /// Number of designs needed.
        needed: usize,
        /// The method that needs them.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::word"))]
        method: Word,
    },
    /// No design that was solved has the response that a requirement limits.
    #[error(
        "requirement {} cannot be judged: no design solved has a value of `{response}`{}",
        .requirement + 1, nominally(reason.as_deref())
    )]
    NoDesignTells {
        /// Position of the requirement, from 0.
        requirement: usize,
        /// Name of the response.
        response: String,
        /// Why the nominal design lacks it; `None` if that one has it.
        reason: Option<Box<Error>>,
    },
    /// Samples of different runs cannot be merged.
    #[error("these samples belong to another run: {what} is {own} here and {other} there")]
    OtherRun {
        /// The fact that differs.
        what: String,
        /// Its value in the run being added to.
        own: String,
        /// Its value in the other run.
        other: String,
    },
    /// Samples to be added are already there.
    #[error("samples {start} to below {end} have been added already")]
    SamplesOverlap {
        /// Number of the first such sample.
        start: u64,
        /// One past the last such sample.
        end: u64,
    },
    /// Samples of a run are missing.
    #[error("samples are missing: {}", ranges(.missing))]
    SamplesMissing {
        /// The missing ranges.
        missing: Vec<core::ops::Range<u64>>,
    },
    /// The work was stopped before there was any result.
    #[error("stopped before there was an answer")]
    Stopped,
    /// The worker threads could not be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(String),
}

fn not_held(unknowns: &[Text], dimension: usize) -> String {
    let names = names(unknowns);
    match (dimension, unknowns.len()) {
        (0, _) => format!(
            "{names} cannot be held at a value: this steady motion is not one of a family, its equations determine it"
        ),
        (_, count) if count > dimension => {
            format!("a family of {dimension} cannot hold {names}: let {} of them go", count - dimension)
        }
        _ => format!(
            "{names} cannot all be chosen in this family of {dimension}: one follows from the others, so let it go"
        ),
    }
}

fn names(names: &[Text]) -> String {
    if names.is_empty() {
        return "none".to_owned();
    }
    let quoted: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}

fn ranges(all: &[core::ops::Range<u64>]) -> String {
    let each: Vec<_> = (all.iter()).map(|range| format!("{} to below {}", range.start, range.end)).collect();
    each.join(", ")
}

/// Why the nominal design lacks a response.
fn nominally(reason: Option<&Error>) -> String {
    reason.map_or_else(String::new, |reason| format!(". At the nominal design, {reason}"))
}

/// The mode in resonance, counted from 1 as in all messages.
fn resonant(mode: Option<usize>) -> String {
    match mode {
        Some(mode) => format!("mode {} in resonance", mode + 1),
        None => "a vibration".to_owned(),
    }
}

/// The modes that have merged, counted from 1 as in all messages.
fn merged(modes: &[usize]) -> String {
    let numbers: Vec<String> = modes.iter().map(|mode| (mode + 1).to_string()).collect();
    match &numbers[..] {
        [one] => format!("mode {one} and its conjugate have merged into"),
        all => format!("modes {} have merged into", all.join(", ")),
    }
}

/// Why there is no probability, in the words of a requirement.
fn unreliable(error: &eigentol_statistics::Error) -> String {
    match error {
        eigentol_statistics::Error::NoLimitValue { place, reason } => {
            let place = match *place {
                "at the origin" => "at the nominal design",
                place => place,
            };
            format!("a requirement cannot be judged {place}: {reason}")
        }
        error => error.to_string(),
    }
}

fn listed(others: &[(Text, f64)]) -> String {
    others.iter().map(|(name, gap)| format!(", `{name}` by {gap:.6e}")).collect()
}

impl Error {
    /// An invalid setting.
    #[doc(hidden)]
    pub fn setting(setting: Word, reason: impl Into<String>) -> Self {
        Self::Setting { setting, reason: reason.into() }
    }
}

impl From<eigentol_statistics::Error> for Error {
    fn from(error: eigentol_statistics::Error) -> Self {
        match error {
            eigentol_statistics::Error::Setting { setting, reason } => Self::setting(setting, reason),
            eigentol_statistics::Error::WrongLength { kind, found, expected } => {
                Self::WrongLength { kind, found, expected }
            }
            error @ (eigentol_statistics::Error::NoLimitValue { .. }
            | eigentol_statistics::Error::NoDesignPoint { .. }) => Self::NoReliability(Box::new(error)),
            eigentol_statistics::Error::Overlap { start, end } => Self::SamplesOverlap { start, end },
            other => Self::setting("statistics", other.to_string()),
        }
    }
}

/// Rounds away the digits of a computed value that rounding errors affect.
fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// A value in SI with its declared unit.
fn valued(value: f64, unit: &Unit) -> String {
    [six_digits(unit.from_si(value)).to_string().as_str(), &unit.symbol].join(" ").trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::Error;

    /// Messages count modes from 1 and name no function.
    #[test]
    fn sentences() {
        let merged = |modes: &[usize]| Error::Defective { modes: modes.to_vec() };
        let start = |error: Error| error.to_string();
        assert!(start(merged(&[0])).starts_with("mode 1 and its conjugate have merged into a"));
        assert!(start(merged(&[0, 2])).starts_with("modes 1, 3 have merged into a defective"));
        assert!(!start(Error::CriticalState).contains('`'));
        let none = eigentol_statistics::Error::NoLimitValue {
            place: "at the origin",
            reason: "it has no equilibrium".to_owned(),
        };
        let expected = "a requirement cannot be judged at the nominal design: it has no equilibrium. Sampling needs no \
                        design point";
        assert_eq!(Error::from(none).to_string(), expected);
    }
}
