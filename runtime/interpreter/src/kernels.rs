//! Interpreted implementations of the kernel tables.

use eigentol::kernels::{
    BatchKernels, BatchLinear, BatchPartials, BatchPoint, Curvature, CurvatureKernels, Directional, DirectionalKernels,
    Gradient, Interval, Kernel, Kernels, Linear, MotionKernel, MotionKernels, PartialMatrices, PictureKernels, Second,
    Sizes, gradient_results, lane_by_lane, linear_results,
};
use eigentol::scalar::{Batch, Instructions, WIDTH};
use eigentol::{Description, Dual, PictureInfo, PoseMargin, Shared, Violation};

use crate::mechanism::Interpreted;
use crate::registers::{along_each, batch, once, scalar};
use crate::tape::Tape;

/// Copies a result out of the registers.
#[inline]
fn copy<T: Copy>(registers: &[T], places: &[u32], to: &mut [T]) {
    for (to, register) in to.iter_mut().zip(places) {
        *to = registers[*register as usize];
    }
}

/// Copies the derivatives of a result out of the registers.
fn copy_slopes(registers: &[Dual<f64>], places: &[u32], to: &mut [f64]) {
    for (to, register) in to.iter_mut().zip(places) {
        *to = registers[*register as usize].slope;
    }
}

/// Copies lists of three matrices, one after the other in the results, each for a number of variables.
fn copy_partials<'a, T: Copy + 'a>(
    registers: &[T],
    tape: &Tape,
    counts: [usize; 3],
    mut changes: impl Iterator<Item = [&'a mut [T]; 3]>,
) {
    for (count, results) in counts.into_iter().zip(tape.results.chunks(3)) {
        for (k, buffers) in changes.by_ref().take(count).enumerate() {
            for (to, places) in buffers.into_iter().zip(results) {
                let size = to.len();
                copy(registers, &places[k * size..(k + 1) * size], to);
            }
        }
    }
}

/// Runs a tape at one state and copies its results. Without a tape the results are zero.
fn run(tape: &Option<Tape>, arguments: &[&[f64]], to: &mut [&mut [f64]]) {
    let Some(tape) = tape else {
        to.iter_mut().for_each(|to| to.fill(0.0));
        return;
    };
    scalar(tape, arguments, |registers| {
        for (to, places) in to.iter_mut().zip(&tape.results) {
            copy(registers, places, to);
        }
    });
}

/// Runs a tape at one state and copies the derivatives of its results along a direction.
fn run_along(tape: &Option<Tape>, arguments: &[&[f64]], direction: &[&[f64]], to: &mut [&mut [f64]]) {
    let Some(tape) = tape else {
        to.iter_mut().for_each(|to| to.fill(0.0));
        return;
    };
    let moved: Vec<Vec<Dual<f64>>> = arguments
        .iter()
        .zip(direction)
        .map(|(values, slopes)| values.iter().zip(*slopes).map(|(&value, &slope)| Dual { value, slope }).collect())
        .collect();
    let moved: Vec<&[Dual<f64>]> = moved.iter().map(Vec::as_slice).collect();
    scalar(tape, &moved, |registers| {
        for (to, places) in to.iter_mut().zip(&tape.results) {
            copy_slopes(registers, places, to);
        }
    });
}

/// Runs a tape at each of several points and copies the derivatives of its results, each along a direction of its own, side
/// by side in the vectors of the processor.
fn run_along_each(tape: &Option<Tape>, points: &[[&[&[f64]]; 2]], gradients: &mut [Gradient]) {
    for (points, gradients) in points.chunks(WIDTH).zip(gradients.chunks_mut(WIDTH)) {
        let (Some(tape), [first, _, ..]) = (tape, points) else {
            for ([arguments, direction], gradient) in points.iter().zip(gradients) {
                run_along(tape, arguments, direction, &mut gradient_results(gradient));
            }
            continue;
        };
        let lanes = |part: usize, list: usize, k: usize| {
            Batch::from_fn(|lane| points.get(lane).unwrap_or(first)[part][list][k])
        };
        let moved = first[0].iter().enumerate().map(|(list, values)| {
            let number = |k| Dual { value: lanes(0, list, k), slope: lanes(1, list, k) };
            (0..values.len()).map(number).collect()
        });
        let moved: Vec<Vec<Dual<Batch>>> = moved.collect();
        let moved: Vec<&[Dual<Batch>]> = moved.iter().map(Vec::as_slice).collect();
        along_each(tape, &moved, |registers| {
            for (lane, gradient) in gradients.iter_mut().enumerate() {
                for (to, places) in gradient_results(gradient).into_iter().zip(&tape.results) {
                    for (to, register) in to.iter_mut().zip(places) {
                        *to = registers[*register as usize].slope.0[lane];
                    }
                }
            }
        });
    }
}

/// Runs a tape at one state with each of several sets of further arguments, side by side in the vectors of the processor,
/// and copies its results.
fn run_each<const N: usize>(tape: &Option<Tape>, state: &[&[f64]; 3], sets: &[[&[f64]; N]], to: &mut [&mut Gradient]) {
    let (Some(tape), [first, _, ..]) = (tape, sets) else {
        for (set, gradient) in sets.iter().zip(to) {
            run(tape, &[&state[..], set].concat(), &mut gradient_results(gradient));
        }
        return;
    };
    let everywhere = state.iter().map(|list| list.iter().map(|&value| Batch::all(value)).collect());
    let apart = (0..N).map(|list| {
        let lanes = |k: usize| Batch::from_fn(|lane| sets.get(lane).map_or(0.0, |set| set[list][k]));
        (0..first[list].len()).map(lanes).collect()
    });
    let arguments: Vec<Vec<Batch>> = everywhere.chain(apart).collect();
    let arguments: Vec<&[Batch]> = arguments.iter().map(Vec::as_slice).collect();
    batch(tape, Instructions::best(), &arguments, |registers| {
        for (lane, gradient) in to.iter_mut().enumerate() {
            for (to, places) in gradient_results(gradient).into_iter().zip(&tape.results) {
                for (to, register) in to.iter_mut().zip(places) {
                    *to = registers[*register as usize].0[lane];
                }
            }
        }
    });
}

fn run_batch(tape: &Option<Tape>, instructions: Instructions, arguments: &[&[Batch]], to: &mut [&mut [Batch]]) {
    if let Some(tape) = tape {
        batch(tape, instructions, arguments, |registers| {
            for (to, places) in to.iter_mut().zip(&tape.results) {
                copy(registers, places, to);
            }
        });
    }
}

impl Kernels for Interpreted {
    fn description(&self) -> Shared<Description> {
        self.description.clone()
    }

    fn sizes(&self) -> Sizes {
        let description = &self.description;
        Sizes {
            coordinates: description.coordinates.len(),
            inputs: description.inputs.len(),
            design: description.design.len(),
            outputs: description.outputs.len(),
            excitations: description.excitations.len(),
        }
    }

    fn evaluate_batch(&self, kernel: Kernel, arguments: &[&[Batch]], results: &mut [&mut [Batch]]) {
        run_batch(self.tape(kernel), Instructions::best(), arguments, results);
    }

    fn evaluate(&self, kernel: Kernel, arguments: &[&[f64]], results: &mut [&mut [f64]]) {
        run(self.tape(kernel), arguments, results);
    }

    fn pencil_gradients_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        vectors: &[[&[f64]; 4]],
        gradients: &mut [&mut Gradient],
    ) {
        let tape = self.tape(Kernel::PencilGradient);
        for (vectors, gradients) in vectors.chunks(WIDTH).zip(gradients.chunks_mut(WIDTH)) {
            run_each(tape, &[q, u, b], vectors, gradients);
        }
    }

    fn linear_partials_into(&self, q: &[f64], u: &[f64], b: &[f64], partials: &mut PartialMatrices) {
        let counts = [q.len(), u.len(), b.len()];
        let mut changes = partials.iter_mut().map(|change| [change.mass, change.damping, change.stiffness]);
        if let Some(tape) = &self.shared.tapes.linear_partials {
            scalar(tape, &[q, u, b], |registers| {
                copy_partials(registers, tape, counts, changes);
            });
            return;
        }
        // One direction at a time, as in compiled code for large mechanisms.
        let mut direction = counts.map(|count| vec![0.0; count]);
        let mut linear = Linear::zeros(q.len());
        for (list, count) in counts.into_iter().enumerate() {
            for (k, buffers) in changes.by_ref().take(count).enumerate() {
                direction[list][k] = 1.0;
                let [dq, du, db] = &direction;
                self.linear_along_into(q, u, b, [dq, du, db], &mut linear);
                direction[list][k] = 0.0;
                for (to, from) in buffers.into_iter().zip(linear_results(&mut linear)) {
                    to.copy_from_slice(from);
                }
            }
        }
    }

    fn violation(&self, u: &[f64], b: &[f64]) -> Option<Violation<f64>> {
        let tape = self.shared.tapes.violation.as_ref()?;
        let values = |registers: &[f64]| {
            let of = tape.results.first()?.iter().map(|register| registers[*register as usize]);
            let mut failing = of.zip(&self.shared.requirements);
            // NaN violates every requirement.
            failing.find(|(value, _)| value.is_nan() || *value <= 0.0)
        };
        let (value, (quantity, requirement)) = scalar(tape, &[u, b], values)?;
        Some(Violation { quantity: quantity.clone(), requirement: requirement.clone(), value })
    }

    fn possible_within(&self, u: &[f64], b: &[f64], reach: &[f64]) -> bool {
        let Some(tape) = &self.shared.tapes.violation else {
            return true;
        };
        let fixed: Vec<_> = u.iter().map(|&value| Interval::about(value, 0.0)).collect();
        let around = b.iter().zip(reach);
        let around: Vec<_> = around.map(|(&value, &reach)| Interval::about(value, reach)).collect();
        let registers = once(tape, &[&fixed, &around]);
        let zero = Interval::about(0.0, 0.0);
        let mut places = tape.results.iter().flatten();
        places.all(|register| registers[*register as usize] > zero)
    }

    fn pose_margin(&self, q: &[f64], u: &[f64], b: &[f64]) -> Option<PoseMargin<f64>> {
        let tape = self.shared.tapes.pose_margin.as_ref()?;
        let least = |registers: &[f64]| {
            let margins = tape.results.first()?.iter().map(|register| registers[*register as usize].abs());
            let poses = margins.zip(&self.shared.poses);
            let poses =
                poses.map(|(margin, (joint, least))| PoseMargin { joint: joint.clone(), margin, least: *least });
            let beyond = |pose_margin: &PoseMargin<f64>| pose_margin.margin - pose_margin.least;
            poses.reduce(|least, other| if beyond(&other) < beyond(&least) { other } else { least })
        };
        scalar(tape, &[q, u, b], least)
    }

    fn held_values_into(&self, u: &[Second], b: &[Second], values: &mut [Second]) {
        if let Some(tape) = &self.shared.tapes.held_values {
            copy(&once(tape, &[u, b]), &tape.results[0], values);
        }
    }

    fn spans_into(&self, u: &[Second], b: &[Second], numbers: &mut [Second]) {
        if let Some(tape) = &self.shared.tapes.spans {
            copy(&once(tape, &[u, b]), &tape.results[0], numbers);
        }
    }
}

impl DirectionalKernels for Interpreted {
    fn evaluate_along(
        &self,
        kernel: Directional,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    ) {
        run_along(self.tape(kernel.into()), arguments, direction, results);
    }

    fn evaluate_along_each(&self, kernel: Directional, points: &[[&[&[f64]]; 2]], gradients: &mut [Gradient]) {
        run_along_each(self.tape(kernel.into()), points, gradients);
    }
}

impl CurvatureKernels for Interpreted {
    fn evaluate_curvature(
        &self,
        kernel: Curvature,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    ) {
        run_along(self.tape(kernel.into()), arguments, direction, results);
    }

    fn evaluate_curvature_each(&self, kernel: Curvature, points: &[[&[&[f64]]; 2]], gradients: &mut [Gradient]) {
        run_along_each(self.tape(kernel.into()), points, gradients);
    }
}

impl MotionKernels for Interpreted {
    fn evaluate_motion(&self, kernel: MotionKernel, arguments: &[&[f64]], results: &mut [&mut [f64]]) {
        let tapes = &self.shared.tapes.in_motion;
        match (kernel, &tapes[kernel as usize]) {
            (MotionKernel::Linear, None) => self.linear_by_columns(arguments, results),
            (_, tape) => run(tape, arguments, results),
        }
    }

    fn evaluate_motion_batch(&self, kernel: MotionKernel, arguments: &[&[Batch]], results: &mut [&mut [Batch]]) {
        match &self.shared.tapes.in_motion[kernel as usize] {
            None => lane_by_lane(arguments, results, |arguments, results| {
                self.evaluate_motion(kernel, arguments, results);
            }),
            tape => run_batch(tape, Instructions::best(), arguments, results),
        }
    }
}

impl Interpreted {
    /// [`MotionKernel::Linear`] column by column, as in compiled code for large mechanisms.
    fn linear_by_columns(&self, arguments: &[&[f64]], results: &mut [&mut [f64]]) {
        let (mass, rest) = results.split_at_mut(1);
        let (damping, stiffness) = rest.split_at_mut(1);
        let n = arguments[0].len();
        let mut column = vec![0.0; n];
        self.evaluate_motion(MotionKernel::Motion, &arguments[1..], &mut [&mut *mass[0], &mut column]);
        let tape = &self.shared.tapes.in_motion[MotionKernel::Residual as usize];
        let mut direction: Vec<_> = arguments.iter().map(|list| vec![0.0; list.len()]).collect();
        for (list, matrix) in [(1, &mut damping[0]), (2, &mut stiffness[0])] {
            for k in 0..n {
                direction[list][k] = 1.0;
                let along: Vec<&[f64]> = direction.iter().map(Vec::as_slice).collect();
                run_along(tape, arguments, &along, &mut [&mut column]);
                for (i, slope) in column.iter().enumerate() {
                    matrix[i * n + k] = *slope;
                }
                direction[list][k] = 0.0;
            }
        }
    }
}

impl PictureKernels for Interpreted {
    fn picture_info(&self) -> Shared<PictureInfo> {
        self.shared.picture.clone()
    }

    fn picture_into(&self, q: &[f64], u: &[f64], b: &[f64], computed: &mut [f64]) {
        run(&self.shared.tapes.picture, &[q, u, b], &mut [computed]);
    }
}

impl BatchKernels for Interpreted {
    fn evaluate_states(
        &self,
        instructions: Instructions,
        kernel: Kernel,
        arguments: &[&[Batch]],
        results: &mut [&mut [Batch]],
    ) {
        run_batch(self.tape(kernel), instructions, arguments, results);
    }

    fn partials_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        matrices: &mut BatchPartials<'_>,
        mut residual: [&mut [Batch]; 2],
    ) {
        let arguments = [at.q, at.u, at.b];
        if let Some(tape) = &self.shared.tapes.linear_partials {
            batch(tape, instructions, &arguments, |registers| {
                let BatchPartials { by_coordinate, by_input, by_design } = matrices;
                let counts = [at.q.len(), at.u.len(), at.b.len()];
                let entries = at.q.len() * at.q.len();
                let changes = changes(by_coordinate, entries)
                    .chain(changes(by_input, entries))
                    .chain(changes(by_design, entries));
                copy_partials(registers, tape, counts, changes);
            });
        }
        let tape = self.tape(Kernel::ResidualPartials);
        run_batch(tape, instructions, &arguments, &mut residual);
    }
}

/// The derivatives of the three matrices with respect to each variable in turn; the damping is skipped if it has no
/// buffer.
fn changes<'a>(matrices: &'a mut BatchLinear<'_>, entries: usize) -> impl Iterator<Item = [&'a mut [Batch]; 3]> {
    let size = entries.max(1);
    let mut damping = matrices.damping.chunks_exact_mut(size);
    let stiffness = matrices.stiffness.chunks_exact_mut(size);
    matrices
        .mass
        .chunks_exact_mut(size)
        .zip(stiffness)
        .map(move |(mass, stiffness)| [mass, damping.next().unwrap_or_default(), stiffness])
}
