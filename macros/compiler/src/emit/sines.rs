//! Sines and cosines that are computed side by side.

use crate::algebra::Unary;
use crate::program::{Kernel, Operand, Operation};

/// Angles whose sines and cosines do not depend on others of the group; in long kernels a single angle.
pub(super) struct Group {
    /// Each angle with the instructions for its sine and its cosine.
    pub(super) angles: Vec<(Operand, [Option<usize>; 2])>,
    /// The last of these instructions; nothing before it uses any of them.
    pub(super) last: usize,
}

/// Maximum number of instructions of a kernel for which grouping pays: in longer kernels the cost of sines and cosines
/// is negligible, and code that computes two at a time is longer.
const FEW: usize = 2048;

/// The groups, and the group of every instruction, if any. A single function of a single angle is not grouped.
pub(super) fn groups(kernel: &Kernel) -> (Vec<Group>, Vec<Option<usize>>) {
    let mut groups: Vec<Group> = Vec::new();
    let mut depth = vec![0; kernel.instructions.len()];
    for (index, instruction) in kernel.instructions.iter().enumerate() {
        let operands = instruction.operation.operands();
        let below = operands
            .map(|operand| match operand {
                Operand::Instruction(index) => depth[index],
                _ => 0,
            })
            .max()
            .unwrap_or(0);
        let (which, angle) = match instruction.operation {
            Operation::Unary(Unary::Sin, angle) => (0, angle),
            Operation::Unary(Unary::Cos, angle) => (1, angle),
            _ => {
                depth[index] = below;
                continue;
            }
        };
        depth[index] = below + 1;
        let group_index = if kernel.instructions.len() <= FEW {
            below
        } else {
            let has_angle = |group: &Group| group.angles.iter().any(|(known, _)| *known == angle);
            groups.iter().position(has_angle).unwrap_or(groups.len())
        };
        if groups.len() == group_index {
            groups.push(Group { angles: Vec::new(), last: index });
        }
        let group = &mut groups[group_index];
        group.last = index;
        match group.angles.iter_mut().find(|(known, _)| *known == angle) {
            Some((_, functions)) => functions[which] = Some(index),
            None => {
                let mut functions = [None; 2];
                functions[which] = Some(index);
                group.angles.push((angle, functions));
            }
        }
    }
    let mut membership = vec![None; kernel.instructions.len()];
    for (number, group) in groups.iter().enumerate() {
        let members: Vec<usize> = group.angles.iter().flat_map(|(_, f)| *f).flatten().collect();
        if members.len() > 1 {
            for index in members {
                membership[index] = Some(number);
            }
        }
    }
    (groups, membership)
}
