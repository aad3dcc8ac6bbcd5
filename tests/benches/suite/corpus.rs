//! Machines of the tests, by their declarations.
#![allow(unreachable_pub, unused_imports, reason = "files of another crate, where others use what they declare")]

macro_rules! machine {
    ($($declaration:tt)*) => {
        eigentol::mechanism! { $($declaration)* }
    };
}
use machine;

#[path = "../../src/corpus/bearing_rotor.rs"]
mod bearing_rotor;
#[path = "../../src/corpus/chain_of_eight.rs"]
mod chain_of_eight;
#[path = "../../src/loops/five_bar.rs"]
mod five_bar;
#[path = "../../src/corpus/screw_press.rs"]
mod screw_press;

pub(crate) use bearing_rotor::BearingRotor;
pub(crate) use chain_of_eight::ChainOfEight;
pub(crate) use five_bar::FiveBar;
pub(crate) use screw_press::ScrewPress;
