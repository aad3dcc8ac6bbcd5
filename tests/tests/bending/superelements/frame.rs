//! Frames of straight beams by finite elements (Euler and Bernoulli), and what is left of them at their stations.

use std::fmt::Write;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::shafts::random::Random;

/// How many of the nodes are stations.
const STATIONS: usize = 5;

/// A frame, with six rows for each node.
pub(super) struct Frame {
    pub(super) nodes: Vec<[f64; 3]>,
    pub(super) mass: DMatrix<f64>,
    pub(super) stiffness: DMatrix<f64>,
}

impl Frame {
    /// Two stations above three on the floor and three nodes between them, joined by beams.
    pub(super) fn random(seed: u64) -> Self {
        let mut random = Random(seed);
        let plan = [
            [0.0, 0.0, 0.4],
            [0.6, 0.0, 0.4],
            [0.0, -0.3, 0.0],
            [0.6, -0.2, 0.0],
            [0.3, 0.4, 0.0],
            [0.1, -0.1, 0.2],
            [0.5, -0.1, 0.2],
            [0.3, 0.2, 0.2],
        ];
        let nodes: Vec<[f64; 3]> = plan.iter().map(|place| place.map(|x| x + random.between(-0.05, 0.05))).collect();
        let rows = 6 * nodes.len();
        let mut frame = Self { nodes, mass: DMatrix::zeros(rows, rows), stiffness: DMatrix::zeros(rows, rows) };
        for ends in
            [[0, 5], [5, 2], [1, 6], [6, 3], [0, 7], [1, 7], [7, 4], [5, 6], [5, 7], [6, 7], [2, 3], [3, 4], [4, 2]]
        {
            let side = random.between(0.03, 0.06);
            frame.beam(ends, side, random.between(60e9, 210e9), random.between(2500.0, 7900.0));
        }
        frame
    }

    pub(super) fn stations(&self) -> &[[f64; 3]] {
        &self.nodes[..STATIONS]
    }

    /// How many modes there are between the stations.
    pub(super) fn inner(&self) -> usize {
        6 * (self.nodes.len() - STATIONS)
    }

    /// A beam of square section.
    fn beam(&mut self, ends: [usize; 2], side: f64, modulus: f64, density: f64) {
        let [from, to] = ends.map(|end| Vector3::from(self.nodes[end]));
        let length = (to - from).norm();
        let x = (to - from) / length;
        let y = Vector3::z().cross(&x).normalize();
        let turn = Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()]);
        let (area, inertia, shear) = (side * side, side.powi(4) / 12.0, modulus / 2.6);
        let mut local = [DMatrix::zeros(12, 12), DMatrix::zeros(12, 12)];
        let bars =
            [(0, modulus * area, density * area), (3, shear * 0.1406 * side.powi(4), density * side.powi(4) / 6.0)];
        for (row, stiff, heavy) in bars {
            for (i, j, sign, share) in [(0, 0, 1.0, 2.0), (0, 6, -1.0, 1.0), (6, 0, -1.0, 1.0), (6, 6, 1.0, 2.0)] {
                local[0][(row + i, row + j)] += heavy * length / 6.0 * share;
                local[1][(row + i, row + j)] += stiff / length * sign;
            }
        }
        let l = length;
        let bend = [
            [12.0, 6.0 * l, -12.0, 6.0 * l],
            [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
            [-12.0, -6.0 * l, 12.0, -6.0 * l],
            [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
        ];
        let heavy = [
            [156.0, 22.0 * l, 54.0, -13.0 * l],
            [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
            [54.0, 13.0 * l, 156.0, -22.0 * l],
            [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
        ];
        for (rows, slope) in [([1, 5, 7, 11], 1.0), ([2, 4, 8, 10], -1.0)] {
            for i in 0..4 {
                for j in 0..4 {
                    let sign = if i % 2 == j % 2 { 1.0 } else { slope };
                    local[0][(rows[i], rows[j])] += sign * density * area * l / 420.0 * heavy[i][j];
                    local[1][(rows[i], rows[j])] += sign * modulus * inertia / l.powi(3) * bend[i][j];
                }
            }
        }
        let mut turns = DMatrix::zeros(12, 12);
        (0..4).for_each(|k| turns.view_mut((3 * k, 3 * k), (3, 3)).copy_from(&turn));
        let place = |row: usize| 6 * ends[row / 6] + row % 6;
        for (local, whole) in local.iter().zip([&mut self.mass, &mut self.stiffness]) {
            let turned = turns.transpose() * local * &turns;
            for i in 0..12 {
                (0..12).for_each(|j| whole[(place(i), place(j))] += turned[(i, j)]);
            }
        }
    }

    /// Mass and stiffness at the stations and of so many modes with the stations held.
    pub(super) fn reduced(&self, modes: usize) -> [DMatrix<f64>; 2] {
        let (edge, rows) = (6 * STATIONS, self.mass.nrows());
        let inner = rows - edge;
        let part = |a: &DMatrix<f64>, row, column, height, width| a.view((row, column), (height, width)).into_owned();
        let held = part(&self.stiffness, edge, edge, inner, inner);
        let follow = -held.clone().lu().solve(&part(&self.stiffness, edge, 0, inner, edge)).expect("a stiffness");
        let own = super::modes_of(&part(&self.mass, edge, edge, inner, inner), &held);
        let mut shapes = DMatrix::zeros(rows, edge + modes);
        shapes.view_mut((0, 0), (edge, edge)).fill_with_identity();
        shapes.view_mut((edge, 0), (inner, edge)).copy_from(&follow);
        for (k, (_, shape)) in own.iter().take(modes).enumerate() {
            let column: &DVector<f64> = shape;
            shapes.view_mut((edge, edge + k), (inner, 1)).copy_from(column);
        }
        [&self.mass, &self.stiffness].map(|a| shapes.transpose() * a * &shapes)
    }
}

/// A matrix as it follows a declaration that names its file.
pub(super) fn file(name: &str, matrix: &DMatrix<f64>) -> String {
    let n = matrix.nrows();
    let mut text = format!("%%MatrixMarket matrix array real general\n{n} {n}\n");
    // Columns one after the other.
    matrix.iter().for_each(|entry| writeln!(text, "{entry:e}").expect("text"));
    format!("file {name:?} {text:?};\n")
}
