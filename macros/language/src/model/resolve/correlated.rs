//! Correlations of design variables.

use std::collections::BTreeSet;

use super::resolver::Resolver;
use super::scope::Meaning;
use crate::base::ids::DesignId;
use crate::base::names::{fits, written};
use crate::model::mechanism::{Correlation, DesignVariable};
use crate::syntax::ast::{self, Unread};

impl Resolver<'_> {
    pub(super) fn correlations(&mut self, design: &[DesignVariable]) -> Vec<Correlation> {
        let (mut correlations, mut known) = (Vec::new(), BTreeSet::new());
        let names: Vec<String> = design.iter().map(|one| written(&one.name.to_string()).into_owned()).collect();
        for of in self.ast.all::<ast::Correlated>() {
            let (mut meant, mut all_known) = (Vec::new(), true);
            for (pattern, extent) in &of.names {
                let before = meant.len();
                meant.extend((0..names.len()).filter(|k| fits(pattern, &names[*k])));
                if meant.len() > before {
                    continue;
                }
                all_known = false;
                // It may be one that could not be read.
                if self.ast.unread.iter().all(Unread::is_nameless) {
                    let is_design = |meaning| matches!(meaning, Meaning::Design(_));
                    let near = self.scope.nearest(pattern, is_design).map(|near| format!("did you mean `{near}`?"));
                    self.report(*extent, format!("unknown design variable `{pattern}`"), near);
                }
            }
            meant.sort_unstable();
            meant.dedup();
            if all_known && meant.len() == 1 {
                self.diagnostics.error(of.keyword, "a correlation is one of two design variables or more");
            }
            for (k, &first) in meant.iter().enumerate() {
                for &second in &meant[k + 1..] {
                    if !known.insert([first, second]) {
                        let message = format!("`{}` and `{}` are correlated already", names[first], names[second]);
                        self.diagnostics.error(of.keyword, message);
                        return correlations;
                    }
                    let variables = [first, second].map(DesignId::new);
                    correlations.push(Correlation { variables, correlation: of.correlation });
                }
            }
        }
        correlations
    }
}
