//! Superelements: linear parts whose matrices another program has computed.

use proc_macro2::Ident;

use super::expression::Expr;
use super::shaft::ShaftStation;
use crate::base::ids::CoordinateId;

/// A linear part that stands still and moves little. Its matrices are among the forces of the mechanism, under its name.
#[derive(Clone, Debug)]
pub struct Superelement {
    /// Declared name.
    pub name: Ident,
    /// Its stations in order.
    pub stations: Vec<ShaftStation>,
    /// The coordinates of what moves between its stations.
    pub internal: Vec<CoordinateId>,
    /// Its mass, kg.
    pub mass: Expr,
}
