//! Every machine as tables of kernels.
//!
//! They are compiled once, here: rustc does not recompile for a test what this crate already contains, whether the test
//! calls it through these tables or by the machine's type.

use eigentol::Mechanism;
use eigentol::kernels::{BatchKernels, CurvatureKernels, MotionKernels, PictureKernels};

use crate::corpus::{self, Visitor};
use crate::{loops, machines, wheels};

/// A machine.
pub struct Machine {
    /// Name in `snake_case`.
    pub name: &'static str,
    /// Text of the declaration.
    pub declaration: &'static str,
    /// The kernels that the solvers call.
    pub kernels: Box<dyn BatchKernels>,
    /// The kernels of second derivatives.
    pub curvature: Box<dyn CurvatureKernels>,
    /// The kernels of the motion.
    pub motion: Box<dyn MotionKernels>,
    /// The kernel of pictures.
    pub picture: Box<dyn PictureKernels>,
}

struct Machines(Vec<Machine>);

impl Visitor for Machines {
    fn visit<M: Mechanism + Copy + 'static>(&mut self, name: &'static str, declaration: &'static str, machine: M) {
        self.0.push(Machine {
            name,
            declaration,
            kernels: Box::new(machine),
            curvature: Box::new(machine),
            motion: Box::new(machine),
            picture: Box::new(machine),
        });
    }
}

/// The machines of [`corpus`] and those with closed forms.
pub fn open() -> Vec<Machine> {
    let mut machines = Machines(Vec::new());
    corpus::visit(&mut machines);
    machines::visit(&mut machines);
    machines.0
}

/// The machines with constraints.
pub fn constrained() -> Vec<Machine> {
    let mut machines = Machines(Vec::new());
    loops::visit(&mut machines);
    wheels::visit(&mut machines);
    machines.0
}
