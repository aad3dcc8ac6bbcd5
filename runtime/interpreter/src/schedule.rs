//! Orders the operations into runs of the same kind, so that the kind is dispatched once for many operations.

use eigentol_compiler::algebra::{Operator, Unary};
use eigentol_compiler::program::{Instruction, Kernel, Operand, Operation};

/// The operation of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Code {
    Unary(Unary),
    Binary(Operator),
    /// Sine and cosine of one angle.
    SinCos,
}

/// Mutually independent operations of one kind, by the index of their instructions; for a sine also the index of the
/// cosine.
pub(crate) struct Run {
    pub(crate) code: Code,
    pub(crate) members: Vec<(usize, Option<usize>)>,
}

/// Arranges the instructions of a kernel into runs: repeatedly all ready operations of the most frequent kind.
pub(crate) fn runs(kernel: &Kernel) -> Vec<Run> {
    let instructions = &kernel.instructions;
    let partners = partners(instructions);
    let needs = |index: usize| {
        let operands = instructions[index].operation.operands();
        operands.into_iter().filter_map(|operand| match operand {
            Operand::Instruction(needed) => Some(needed),
            Operand::Constant(_) | Operand::Parameter(..) => None,
        })
    };
    let mut missing: Vec<usize> = (0..instructions.len()).map(|index| needs(index).count()).collect();
    // The users of an instruction stand side by side in one list, up to where those of the next begin.
    let mut ends = vec![0; instructions.len()];
    (0..instructions.len()).flat_map(needs).for_each(|needed| ends[needed] += 1);
    let mut before = 0;
    for end in &mut ends {
        before += std::mem::replace(end, before);
    }
    let mut users = vec![0; before];
    for index in 0..instructions.len() {
        for needed in needs(index) {
            users[ends[needed]] = index;
            ends[needed] += 1;
        }
    }
    let users_of =
        |index: usize| users[index.checked_sub(1).map_or(0, |before| ends[before])..ends[index]].iter().copied();
    let mut ready: Vec<(Code, Vec<usize>)> = Vec::new();
    let make_ready = |ready: &mut Vec<(Code, Vec<usize>)>, index: usize| {
        let Some(code) = code(instructions, &partners, index) else {
            return;
        };
        match ready.iter_mut().find(|(other, _)| *other == code) {
            Some((_, members)) => members.push(index),
            None => ready.push((code, vec![index])),
        }
    };
    for (index, missing) in missing.iter().enumerate() {
        if *missing == 0 {
            make_ready(&mut ready, index);
        }
    }
    let mut runs = Vec::new();
    while let Some(most) =
        (0..ready.len()).max_by_key(|&k| (ready[k].1.len(), ready.len() - k)).filter(|&k| !ready[k].1.is_empty())
    {
        let (code, members) = (ready[most].0, std::mem::take(&mut ready[most].1));
        let members: Vec<_> =
            members.into_iter().map(|index| (index, partners[index].filter(|_| code == Code::SinCos))).collect();
        for &(first, second) in &members {
            for done in std::iter::once(first).chain(second) {
                for user in users_of(done) {
                    missing[user] -= 1;
                    if missing[user] == 0 {
                        make_ready(&mut ready, user);
                    }
                }
            }
        }
        runs.push(Run { code, members });
    }
    runs
}

/// Pairs each sine with the cosine of the same angle, and vice versa.
fn partners(instructions: &[Instruction]) -> Vec<Option<usize>> {
    let mut partners = vec![None; instructions.len()];
    let mut open: Vec<(Operand, bool, usize)> = Vec::new();
    for (index, instruction) in instructions.iter().enumerate() {
        let (angle, is_sine) = match instruction.operation {
            Operation::Unary(Unary::Sin, angle) => (angle, true),
            Operation::Unary(Unary::Cos, angle) => (angle, false),
            _ => continue,
        };
        let other = open.iter().position(|&(other, sine, _)| other == angle && sine != is_sine);
        match other {
            Some(position) => {
                let (_, _, other) = open.swap_remove(position);
                partners[index] = Some(other);
                partners[other] = Some(index);
            }
            None => open.push((angle, is_sine, index)),
        }
    }
    partners
}

/// The kind of an instruction; `None` for a cosine that is computed together with its sine.
fn code(instructions: &[Instruction], partners: &[Option<usize>], index: usize) -> Option<Code> {
    match instructions[index].operation {
        Operation::Unary(Unary::Sin, _) if partners[index].is_some() => Some(Code::SinCos),
        Operation::Unary(Unary::Cos, _) if partners[index].is_some() => None,
        Operation::Unary(operator, _) => Some(Code::Unary(operator)),
        Operation::Binary(operator, ..) => Some(Code::Binary(operator)),
    }
}
