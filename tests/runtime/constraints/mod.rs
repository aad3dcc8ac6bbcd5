//! Equilibria of mechanisms with constraints, against closed forms and minimal coordinates.

mod assembly;
mod bordered;
mod equilibria;
mod models;
mod random;
mod redundancy;
mod running;
mod sampling;
