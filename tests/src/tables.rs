//! Every machine as tables of kernels.
//!
//! They are compiled here, once: rustc does not compile again for a test what the crate below it holds already, whether the test
//! calls it through these tables or by the machine's type.

use eigentol::Mechanism;
use eigentol::kernels::{BatchKernels, CurvatureKernels, MotionKernels, PictureKernels};

use crate::corpus::{self, Visitor};
use crate::{loops, machines, wheels};

/// A machine.
pub struct Machine {
    /// In `snake_case`.
    pub name: &'static str,
    /// One token after the other.
    pub declaration: &'static str,
    /// What the solvers call.
    pub kernels: Box<dyn BatchKernels>,
    /// Those of second derivatives.
    pub curvature: Box<dyn CurvatureKernels>,
    /// The kernels of the motion.
    pub motion: Box<dyn MotionKernels>,
    /// The kernel of pictures.
    pub picture: Box<dyn PictureKernels>,
}

struct Machines(Vec<Machine>);

impl Visitor for Machines {
    fn visit<M: Mechanism + Copy + 'static>(
        &mut self,
        name: &'static str,
        declaration: &'static str,
        machine: M,
    ) {
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
    let mut found = Machines(Vec::new());
    corpus::visit(&mut found);
    machines::visit(&mut found);
    found.0
}

/// Those with constraints.
pub fn constrained() -> Vec<Machine> {
    let mut found = Machines(Vec::new());
    loops::visit(&mut found);
    wheels::visit(&mut found);
    found.0
}
