//! The derived functions as text for snapshots: cost and results of each, requirements and properties.

use std::fmt::{self, Display, Formatter};

use super::functions::Functions;

impl Display for Functions {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let properties = self.properties;
        writeln!(f, "symmetric stiffness: {}", properties.symmetric_stiffness)?;
        writeln!(f, "damping: {:?}", properties.damping)?;
        if self.free.count > 0 {
            writeln!(f, "free directions: {}", self.free.count)?;
        }
        for requirement in &self.requirements {
            writeln!(f, "{}: {}", requirement.quantity, requirement.requirement)?;
        }
        for pose in &self.poses {
            writeln!(f, "{}: singular where its axes lie in one plane", pose.joint)?;
        }
        for function in &self.functions {
            let cost = function.cost(&self.graph);
            let parameters: Vec<&str> = function.parameters.iter().map(|p| p.name).collect();
            let results: Vec<String> = function.results.iter().map(|r| format!("{} {:?}", r.name, r.shape)).collect();
            writeln!(
                f,
                "{}({}) -> {}: {} + {}",
                function.name,
                parameters.join(", "),
                results.join(", "),
                cost.operations,
                cost.functions
            )?;
        }
        Ok(())
    }
}
