//! User guide to [`eigentol`]: from a pendulum to your own rotor.
//!
//! | chapter | contents |
//! | --- | --- |
//! | [From the pendulum to your own rotor](first_steps) | ten minutes with the command, then the same in Rust |
//! | [A flexible rotor](flexible_rotor) | two disks on a shaft that bends: from the declaration to the balance grade |
//! | [How to declare what](declare) | a glossary from the terms of other tools and of drawings to ours |
//! | [Parts, arrays and loops](parts) | machines that repeat themselves: bearings, blades, chains, files |
//! | [Reading a tolerance result](tolerances) | every column, and when not to trust first order |
//! | [Distributions and requirements](requirements) | how parts scatter, the probability of a good product, the cheapest tolerances |
//! | [Closed loops](loops) | linkages, and which assembly is found |
//! | [Which equilibrium](equilibria) | unstable ones, families of steady motions, machines that nothing holds |
//! | [Rotors](rotors) | whirl, Campbell diagrams, critical speeds, instability |
//! | [Forced vibration](vibration) | unbalance, shaking and harmonic loads: amplitudes, bands, the balance grade |
//! | [Blades, booms and arms](beams) | flexible beams: how many coordinates, how exact, and when not to use them |
//! | [A page that answers](live) | sliders for every value, saved files followed, in a browser or a notebook |
//! | [Inside other tools](tools) | OpenMDAO, JAX, PyTorch, CasADi, FMI: exact derivatives where you optimise or simulate |
//! | [Theory](theory) | the equations, with the numbers of the paper |
//! | [Embedding](embedding) | Python, C, build scripts, no standard library |
//! | [Performance](performance) | measurements, and where the numbers come from |
//! | [Limits](limits) | what the library does not do |
//! | [한국어 요약](korean) | a Korean summary of the paper's part |
//!
//! Every Rust block is compiled and run. Every shell command is run and its output compared.

#[doc = include_str!("first_steps.md")]
pub mod first_steps {}

#[doc = include_str!("flexible_rotor.md")]
pub mod flexible_rotor {}

#[doc = include_str!("declare.md")]
pub mod declare {}

#[doc = include_str!("parts.md")]
pub mod parts {}

#[doc = include_str!("tolerances.md")]
pub mod tolerances {}

#[doc = include_str!("requirements.md")]
pub mod requirements {}

#[doc = include_str!("loops.md")]
pub mod loops {}

#[doc = include_str!("equilibria.md")]
pub mod equilibria {}

#[doc = include_str!("rotors.md")]
pub mod rotors {}

#[doc = include_str!("vibration.md")]
pub mod vibration {}

#[doc = include_str!("beams.md")]
pub mod beams {}

#[doc = include_str!("live.md")]
pub mod live {}

#[doc = include_str!("tools.md")]
pub mod tools {}

#[doc = include_str!("theory.md")]
pub mod theory {}

#[doc = include_str!("embedding.md")]
pub mod embedding {}

#[doc = include_str!("performance.md")]
pub mod performance {}

#[doc = include_str!("limits.md")]
pub mod limits {}

#[doc = include_str!("korean.md")]
pub mod korean {}
