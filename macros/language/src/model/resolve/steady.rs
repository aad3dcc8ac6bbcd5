//! Values that select one of a family of steady motions.

use super::coordinates::{DeclaredMotion, dimension, rate_dimension};
use super::resolver::Resolver;
use crate::base::ids::CoordinateId;
use crate::model::mechanism::Steady;
use crate::syntax::ast::Named;

impl Resolver<'_> {
    pub(super) fn steady_values(&mut self) -> Vec<Steady> {
        let mut all: Vec<Steady> = Vec::new();
        for named in self.ast.all::<Named>() {
            if let Some(steady) = self.steady(named) {
                if all.iter().any(|x| x.coordinate == steady.coordinate) {
                    let message = format!("`{}` is given a steady value twice", named.name);
                    self.diagnostics.error(&named.name, message);
                } else {
                    all.push(steady)
                }
            }
        }
        all
    }

    fn steady(&mut self, Named { name, value }: &Named) -> Option<Steady> {
        let (coordinate, quantity) = self.coordinate(name)?;
        let what = format!("the steady value of `{name}`");
        let (dimension, what) = match self.motion_of(coordinate) {
            DeclaredMotion::Free => (dimension(quantity), what),
            DeclaredMotion::Coasting => (rate_dimension(quantity), format!("the steady speed of `{name}`")),
            DeclaredMotion::Driven => {
                let message = format!("`{name}` is driven: its drive gives its speed");
                let help = "only a free coordinate, or the speed of a coasting one, can select a steady motion";
                return self.refuse_with_help(name, message, help);
            }
            DeclaredMotion::Shaken => {
                let message = format!("`{name}` is shaken about zero: it has no other steady value");
                return self.refuse(name, message);
            }
        };
        let value = self.scalar_of(value, dimension, &what)?;
        Some(Steady { coordinate, name: name.clone(), value })
    }

    fn motion_of(&self, coordinate: CoordinateId) -> DeclaredMotion {
        let declared = self.coordinates.get(coordinate.index());
        declared.map_or(DeclaredMotion::Free, |declared| declared.motion)
    }
}
