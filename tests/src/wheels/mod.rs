//! Wheels that roll without slip. Their reference values are in `truth/rolling.json`.

use crate::corpus::Visitor;

pub mod cart;
pub mod caster;
pub mod disk;
pub mod trailer;
pub mod whipple;

pub use cart::PushedCart;
pub use caster::TowedCaster;
pub use disk::RollingDisk;
pub use trailer::CirclingTrailer;
pub use whipple::WhippleBicycle;

/// Passes every machine to a visitor.
pub fn visit(visitor: &mut impl Visitor) {
    visitor.visit("cart", cart::DECLARATION, PushedCart);
    visitor.visit("caster", caster::DECLARATION, TowedCaster);
    visitor.visit("disk", disk::DECLARATION, RollingDisk);
    visitor.visit("trailer", trailer::DECLARATION, CirclingTrailer);
    visitor.visit("whipple", whipple::DECLARATION, WhippleBicycle);
}
