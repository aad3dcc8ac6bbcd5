//! Wheels that roll without slip. Their reference values are in `truth/rolling.json`.

use crate::corpus::machines;

machines! {
    cart: PushedCart,
    caster: TowedCaster,
    disk: RollingDisk,
    trailer: CirclingTrailer,
    whipple: WhippleBicycle,
}
