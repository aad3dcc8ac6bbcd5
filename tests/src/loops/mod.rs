//! Mechanisms with closed loops and couplings, whose solutions in minimal coordinates are stored in `truth/loops.json`.
//!
//! Their loops are closed in every way that the language offers: cut joints, chosen by the declaration or by the
//! compiler; coincident points; distances; couplings and equations of coordinates, both at rest and running.

use crate::corpus::machines;

machines! {
    five_bar: FiveBar,
    four_bar: FourBar,
    geared_coasting: GearedCoasting,
    geared_motor: GearedMotor,
    geared_rotors: GearedRotors,
    geared_unbalance: GearedUnbalance,
    governor: Governor,
    porter_governor: PorterGovernor,
    shaken_linkage: ShakenLinkage,
    slider_crank: SliderCrank,
}
