//! The paper's matrices, evaluated literally.
//!
//! No recursion over bodies, no symbolic step, no folding: body poses are matrix products, the velocity transformation
//! is filled column by column, and its rate and every derivative come from (nested) dual numbers. Equation numbers
//! refer to Eom, Choi & Yoo as corrected in the project's theory.

mod beams;
mod bodies;
mod forces;
mod gradient;
mod kinematics;
mod linear;
mod motion;
mod picture;
mod scalar;
mod space;
mod whirl;

pub use gradient::{Along, Functional, ModeFunctional, PencilFunctional, ResidualFunctional};
pub use linear::{Linear, LinearPartials};
pub use motion::{Motion, State};
pub use picture::Place;
pub use scalar::Scalar;

use crate::model::{Branch, Coordinate, Model};

/// Evaluates a model. Unless set otherwise, driven coordinates are zero and the ground frame is the inertial frame.
#[derive(Clone, Debug)]
pub struct Oracle<'a> {
    model: &'a Model,
    tree: Vec<Branch>,
    carried: Vec<Vec<usize>>,
    free: Vec<Coordinate>,
    driven: Vec<Coordinate>,
    driven_position: Vec<f64>,
    ground: [[f64; 3]; 3],
}

impl<'a> Oracle<'a> {
    /// The oracle of a model.
    pub fn new(model: &'a Model) -> Self {
        let driven = model.driven();
        let tree = model.tree();
        Self {
            model,
            carried: kinematics::carried(&tree, model.joints.len()),
            tree,
            free: model.free(),
            driven_position: vec![0.0; driven.len()],
            driven,
            ground: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        }
    }

    /// The same mechanism with its driven coordinates at other positions; in a steady state no kernel result may
    /// change.
    pub fn with_driven(mut self, position: &[f64]) -> Self {
        assert_eq!(position.len(), self.driven.len(), "one position per driven coordinate");
        self.driven_position = position.to_vec();
        self
    }

    /// The same mechanism with the whole ground, gravity included, rotated by `angle` about `axis`. Results change only
    /// by rounding, so the difference shows how large the summed terms are.
    pub fn turned(mut self, axis: [f64; 3], angle: f64) -> Self {
        self.ground = space::rotation(axis, angle).0;
        self
    }

    /// The model.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// Number of free coordinates.
    pub fn coordinates(&self) -> usize {
        self.free.len()
    }
}
