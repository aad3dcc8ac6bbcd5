//! Equal instances around an axis, by the names of what belongs to them.

use std::collections::BTreeMap;

use super::resolver::Resolver;
use super::typed::ValueContext;
use crate::base::ids::{CoordinateId, DesignId};
use crate::base::names::{LINK, joined, written};
use crate::model::mechanism::{DesignVariable, Ring};
use crate::syntax::ast::{Cyclic, Unread};

impl Resolver<'_> {
    pub(super) fn rings(&mut self, design: &[DesignVariable]) -> Vec<Ring> {
        self.ast.all().filter_map(|of| self.ring(of, design)).collect()
    }

    fn ring(&mut self, of: &Cyclic, design: &[DesignVariable]) -> Option<Ring> {
        let about = self.direction(&of.about, ValueContext::Parameter)?;
        let names = self.declared_coordinates.iter().map(|coordinate| coordinate.name.to_string()).collect();
        let coordinates = self.common(of, names)?;
        let names = design.iter().map(|variable| variable.name.to_string()).collect();
        let design = self.common(of, names)?;
        if coordinates.is_empty() && self.ast.unread.iter().all(Unread::is_nameless) {
            let first = joined(&of.name.to_string(), &of.members.start.to_string());
            let message = format!("`{}` has no coordinate", written(&first));
            self.report(
                of.name.span(),
                message,
                Some("what stands around an axis moves: it is an instance or a joint of an array".to_owned()),
            );
        }
        let design = design.into_values().map(|ids| ids.into_iter().map(DesignId::new).collect());
        let coordinates =
            coordinates.into_iter().map(|(name, ids)| (name, ids.into_iter().map(CoordinateId::new).collect()));
        Some(Ring {
            name: of.name.clone(),
            members: of.members.len(),
            about,
            coordinates: coordinates.collect(),
            design: design.collect(),
        })
    }

    /// What every instance of a ring has, by its name in it.
    fn common(&mut self, of: &Cyclic, names: Vec<String>) -> Option<BTreeMap<String, Vec<usize>>> {
        let prefixes: Vec<String> = of.members.clone().map(|k| joined(&of.name.to_string(), &k.to_string())).collect();
        let mut found: BTreeMap<String, Vec<Option<usize>>> = BTreeMap::new();
        for (id, name) in names.into_iter().enumerate() {
            for (k, prefix) in prefixes.iter().enumerate() {
                let rest =
                    name.strip_prefix(prefix).filter(|rest| rest.chars().next().is_none_or(|first| first == LINK));
                if let Some(rest) = rest {
                    found
                        .entry(rest.trim_start_matches(LINK).to_owned())
                        .or_insert_with(|| vec![None; prefixes.len()])[k] = Some(id);
                }
            }
        }
        for (name, ids) in &found {
            let lacking = ids.iter().position(Option::is_none);
            if let (Some(lacking), true) = (lacking, self.ast.unread.iter().all(Unread::is_nameless)) {
                let has = ids.iter().position(Option::is_some).unwrap_or_default();
                let [lacking, has] = [lacking, has].map(|k| written(&prefixes[k]).into_owned());
                let name = written(name);
                let message =
                    format!("`{lacking}` lacks the `{name}` that `{has}` has, so they are not equal around an axis");
                return self.refuse_with(of.name.span(), message, None);
            }
        }
        Some(found.into_iter().map(|(name, ids)| (name, ids.into_iter().flatten().collect())).collect())
    }
}
