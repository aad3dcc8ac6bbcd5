//! Stated constants, in an order in which each uses only earlier ones.

use std::collections::BTreeSet;

use proc_macro2::Ident;

use super::expected::Expected;
use super::resolver::Resolver;
use super::scope::Meaning;
use super::typed::{Quantity, Typed, ValueContext};
use crate::base::ids::ConstantId;
use crate::model::expression::Expr;
use crate::model::mechanism::Constant;
use crate::syntax::ast::{ItemKind, Stated};

/// Progress in resolving a `let`.
#[derive(Clone, Copy, PartialEq)]
enum State {
    Waiting,
    /// Its own dependencies are being resolved.
    Open,
    Done,
}

impl Resolver<'_> {
    pub(super) fn named_constants(&mut self) {
        let named: Vec<&Stated> = self
            .ast
            .items
            .iter()
            .filter_map(|item| match &item.kind {
                ItemKind::Let(named) => Some(named),
                _ => None,
            })
            .collect();
        self.lets = vec![None; named.len()];
        let uses: Vec<Vec<usize>> = named.iter().map(|named| self.used_lets(named)).collect();
        let mut state = vec![State::Waiting; named.len()];
        let mut in_cycle = vec![false; named.len()];
        for start in 0..named.len() {
            // Depth first with an explicit stack: a chain of lets may be too long for recursion.
            let mut path: Vec<(usize, usize)> = Vec::new();
            if state[start] == State::Waiting {
                state[start] = State::Open;
                path.push((start, 0));
            }
            while let Some((current, next)) = path.last_mut() {
                let current = *current;
                let Some(&used) = uses[current].get(*next) else {
                    path.pop();
                    state[current] = State::Done;
                    if !in_cycle[current] {
                        self.lets[current] = self.constant(named[current]);
                    }
                    continue;
                };
                *next += 1;
                match state[used] {
                    State::Waiting => {
                        state[used] = State::Open;
                        path.push((used, 0));
                    }
                    State::Done => {}
                    State::Open => {
                        let start = path.iter().position(|&(index, _)| index == used);
                        let cycle: Vec<usize> = path[start.unwrap_or(0)..].iter().map(|&(index, _)| index).collect();
                        self.report_cycle(&cycle, &named, &in_cycle);
                        for index in cycle {
                            in_cycle[index] = true;
                        }
                    }
                }
            }
        }
    }

    /// Reports constants that depend on themselves.
    fn report_cycle(&mut self, cycle: &[usize], named: &[&Stated], known: &[bool]) {
        if cycle.iter().any(|&index| known[index]) {
            return;
        }
        let Some(&first) = cycle.first() else {
            return;
        };
        let names: Vec<String> =
            cycle.iter().chain([&first]).map(|&index| format!("`{}`", named[index].name)).collect();
        let name = &named[first].name;
        let message = format!("`{name}` is defined by itself: {}", names.join(" uses "));
        self.diagnostics.error(name, message);
    }

    /// The lets that a value uses, each once.
    fn used_lets(&self, named: &Stated) -> Vec<usize> {
        let lets = named.value.names().into_iter().filter_map(|name| match self.scope.find(&name.to_string()) {
            Some(Meaning::Let(index)) => Some(index),
            _ => None,
        });
        lets.collect::<BTreeSet<_>>().into_iter().collect()
    }

    fn constant(&mut self, named: &Stated) -> Option<Typed> {
        let Stated { name, unit, value } = named;
        let what = format!("`{name}`");
        let typed = self.value(value, ValueContext::Parameter)?;
        if let Some(unit) = unit {
            let (dimension, unit) = self.declared_unit(unit);
            let (Typed::Scalar(_, quantity) | Typed::Vector(_, quantity) | Typed::Matrix(_, quantity)) = typed;
            self.expect(quantity, Expected::in_unit(dimension?, &unit.symbol), &what, value)?;
        }
        match typed {
            Typed::Scalar(expr, quantity) => {
                self.require_finite(std::slice::from_ref(&expr), &what, value.extent);
                Some(Typed::Scalar(self.shared(name.clone(), expr), promoted(quantity)))
            }
            // A vector becomes three constants, so that it is computed once however often it is used.
            Typed::Vector(vector, quantity) => {
                let mut axes = ["x", "y", "z"].into_iter();
                self.require_finite(&vector, &what, value.extent);
                let vector = vector.map(|expr| {
                    let axis = axes.next().unwrap_or_default();
                    self.shared(self.component_name(name, axis), expr)
                });
                Some(Typed::Vector(vector, promoted(quantity)))
            }
            Typed::Matrix(matrix, quantity) => {
                let mut axes = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"].into_iter();
                self.require_finite(matrix.as_flattened(), &what, value.extent);
                let matrix = matrix.map(|row| {
                    row.map(|expr| {
                        let axes = axes.next().unwrap_or_default();
                        self.shared(self.component_name(name, axes), expr)
                    })
                });
                Some(Typed::Matrix(matrix, promoted(quantity)))
            }
        }
    }

    /// Enters a constant; a plain number is used directly.
    pub(super) fn shared(&mut self, name: Ident, value: Expr) -> Expr {
        let id = ConstantId::new(self.constants.len());
        let reference = match &value {
            Expr::Number(number) => Expr::Number(*number),
            _ => Expr::Constant(id),
        };
        self.constants.push(Constant { name, value });
        reference
    }

    /// A name that is not used otherwise.
    fn component_name(&self, name: &Ident, axis: &str) -> Ident {
        let mut text = format!("{name}_{axis}");
        while self.scope.find(&text).is_some() {
            text.push('_');
        }
        Ident::new(&text, name.span())
    }
}

/// A constant zero counts as a plain number: only a literal zero fits every dimension.
fn promoted(quantity: Quantity) -> Quantity {
    Quantity::Of(quantity.dimension())
}
