//! The gradients of the amplitudes of outputs at fixed equilibrium, by one adjoint each.
//!
//! With `D^T p = c`, the amplitude `y = c . z + d` has the derivatives of `h = c . z + d + p . (F - D z)`, in which `z`
//! and `p` are held fixed. `h` is bilinear in complex numbers that hold still, so real kernels give its gradient: those
//! of `l . D z` for real vectors `l` and each of the real and the imaginary part of `z`, and one call for each of the real
//! and the imaginary part of the rest (two if excitations of one harmonic turn both ways). The vectors `l` are the parts
//! of all `p`, or unit vectors, of which all these are sums, if there are fewer. The frequency enters as `dh/dw` times
//! the derivative of `w`.

use core::ops::Range;

use super::response::{Solved, Vibration};
use super::side_by_side::SideBySide;
use crate::algebra::{Matrix, Vector, add_to, dot_complex, times_columns};
use crate::kernels::{Gradient, Kernel, Kernels, Sizes};
use crate::modes::pencil_slope_times;
use crate::scalar::Real as _;
use crate::sensitivity::{BilinearForm, ComplexGradient};
use crate::shafts::{Form, FormGradient};
use crate::{Complex, Equilibrium};

/// One output of a harmonic and its adjoint.
pub(super) struct OutputAdjoint<'a> {
    pub(super) solved: &'a Solved<'a>,
    pub(super) vibration: &'a Vibration,
    pub(super) output: usize,
    pub(super) factors: Factors,
    /// Derivatives of `p^T T(s) z` by the numbers of shafts.
    of_shafts: Option<FormGradient>,
}

/// `s^2 z`, `s z`, `z`, or the change of them.
pub(super) type Motion = [Vector<Complex>; 3];

/// What stands beside kernels and motion in `h`, or the change of it: each enters linearly.
pub(super) struct Factors {
    /// `p`.
    pub(super) left: Vector<Complex>,
    /// `dh/dw`.
    pub(super) slope: Complex,
}

impl Factors {
    pub(super) fn form(&self, motion: &Motion) -> BilinearForm {
        let [acceleration, velocity, position] = motion;
        BilinearForm::new([&self.left, acceleration, velocity, position])
    }
}

impl Vibration {
    pub(super) fn motion(&self) -> Motion {
        let (s, z) = (self.harmonic.s(), &self.harmonic.unknowns);
        [z.map(|value| s * s * value), z.map(|value| s * value), z.clone()]
    }
}

impl<'a> OutputAdjoint<'a> {
    /// Of several outputs; `None` for one that is not smooth, and for one that sees a direction in which `D` vanishes:
    /// its derivatives are infinite.
    pub(super) fn each(solved: &'a Solved<'a>, vibration: &'a Vibration, outputs: Range<usize>) -> Vec<Option<Self>> {
        let harmonic = &vibration.harmonic;
        let (s, z) = (harmonic.s(), &harmonic.unknowns);
        let (first, rows) = (outputs.start, &vibration.seen);
        let weights = Matrix::from_fn(z.len(), outputs.len(), |i, k| rows[first + k][i]);
        let lefts = vibration.stiffness.solve_transposed(&weights);
        let finite = |output: &usize| solved.smooth[*output] && !vibration.stiffness.seen_by(&rows[*output]);
        let finite: Vec<usize> = outputs.clone().filter(finite).collect();
        let lefts: Vec<Vector<Complex>> = finite.iter().map(|output| lefts.column(output - first)).collect();
        let forms: Vec<Form<'_>> = lefts.iter().map(|left| Form { left, s, right: z }).collect();
        let mut of_shafts = solved.shafts.iter().flat_map(|own| own.shafts.gradients(&forms));
        let of_matrices = solved.shafts.is_none().then(|| pencil_slope_times(&solved.at.linear, s, z));
        let mut all: Vec<Option<Self>> = outputs.map(|_| None).collect();
        for (&output, left) in finite.iter().zip(&lefts) {
            let of_shafts = of_shafts.next();
            let by_s = match (&of_shafts, &of_matrices) {
                (Some(form), _) => form.by_s,
                (None, slope) => slope.as_ref().map_or(Complex::ZERO, |slope| dot_complex(left, slope)),
            };
            let of_output = solved.seen.slope(output, s, z);
            let factors = Factors { slope: Complex::I * (of_output - by_s), left: left.clone() };
            all[output - first] = Some(Self { solved, vibration, output, factors, of_shafts });
        }
        all
    }

    /// The gradient of `-h` at fixed equilibrium.
    pub(super) fn gradient(&self) -> ComplexGradient {
        gradients(self.solved, self.vibration, &[self]).map(|mut rows| {
            let parts = results(self.solved.at, &mut rows[0]);
            let [coordinates, inputs, design] = parts.map(|part| Vector::from(&*part));
            Gradient { coordinates, inputs, design }
        })
    }
}

/// The gradients of `-h` at fixed equilibrium, real and imaginary parts: a row for each output, by unknowns, inputs and
/// design variables.
pub(super) fn gradients(solved: &Solved<'_>, vibration: &Vibration, outputs: &[&OutputAdjoint<'_>]) -> [Matrix; 2] {
    let (mechanism, motion) = (solved.mechanism, &vibration.motion());
    let count = outputs.len();
    let lefts = Matrix::from_fn(2 * count, solved.at.coordinates.len(), |k, i| {
        PARTS[k / count].of(outputs[k % count].factors.left[i])
    });
    let [of_real, of_imaginary] = forms(solved, &lefts, motion);
    let joined = |re: &Matrix, im: &Matrix, sign: f64| {
        let mut sum = Matrix::zeros(count, re.column_count());
        let im = im.as_flattened().iter().skip(sum.as_flattened().len());
        let pairs = re.as_flattened().iter().zip(im);
        for (sum, (re, im)) in sum.as_flattened_mut().iter_mut().zip(pairs) {
            *sum = re + sign * im;
        }
        sum
    };
    let mut total = [joined(&of_real, &of_imaginary, -1.0), joined(&of_imaginary, &of_real, 1.0)];
    let calls = PARTS.map(|part| vibration.calls(part).collect::<Vec<Call>>());
    let sets = count * calls.iter().map(Vec::len).sum::<usize>();
    let mut each = SideBySide::new(mechanism, solved.at, Kernel::ForcedGradient, sets);
    for call in calls.iter().flatten() {
        let mut weights = Weights::of(mechanism.sizes(), vibration, motion, (*call, 1.0));
        each.set(&weights.after([&[]; 3])[3..]);
        for output in outputs {
            weights.set_output(output, &output.factors, (*call, 1.0));
            each.push(&weights.of_output());
        }
    }
    let each = each.gradients();
    let mut rows = each.iter();
    for (total, calls) in total.iter_mut().zip(&calls) {
        for _ in calls {
            let pairs = total.iter_mut().zip(rows.by_ref());
            pairs.for_each(|(total, row)| add_to(total, -1.0, row));
        }
    }
    if let Some(shafts) = &solved.shafts {
        let (n, [re, im]) = (solved.at.coordinates.len(), &mut total);
        for (k, form) in outputs.iter().enumerate().filter_map(|(k, output)| Some((k, output.of_shafts.as_ref()?))) {
            for variable in 0..re.column_count() - n {
                let slope = shafts.along(&form.by_number, variable);
                re[k][n + variable] += slope.re;
                im[k][n + variable] += slope.im;
            }
        }
    }
    total
}

/// The gradients of `l . (M a + C v + K x)` for each row `l` of a matrix, with the real and with the imaginary part of a
/// motion.
fn forms(solved: &Solved<'_>, lefts: &Matrix, motion: &Motion) -> [Matrix; 2] {
    let (n, many) = (lefts.column_count(), lefts.row_count());
    if many > n {
        let unit = Matrix::from_fn(n, n, |i, j| f64::from(u8::from(i == j)));
        return forms(solved, &unit, motion).map(|each| {
            f64::run(
                #[inline(always)]
                || times_columns(lefts, &each),
            )
        });
    }
    PARTS.map(|part| {
        let mut each = SideBySide::new(solved.mechanism, solved.at, Kernel::PencilGradient, many);
        let parts = motion.each_ref().map(|motion| motion.map(|value| part.of(value)));
        let [acceleration, velocity, position] = &parts;
        each.set(&[&Vector::zeros(n), acceleration, velocity, position]);
        lefts.iter().for_each(|left| each.push(&[(0, left)]));
        each.gradients()
    })
}

/// The parts of a gradient by unknowns, inputs and design variables.
pub(super) fn results<'a>(at: &Equilibrium, gradient: &'a mut [f64]) -> [&'a mut [f64]; 3] {
    let (coordinates, rest) = gradient.split_at_mut(at.coordinates.len());
    let (inputs, design) = rest.split_at_mut(at.inputs.len());
    [coordinates, inputs, design]
}

/// A part of complex numbers.
#[derive(Clone, Copy)]
pub(super) enum Part {
    Real,
    Imaginary,
}

impl Part {
    #[inline]
    fn of(self, value: Complex) -> f64 {
        match self {
            Self::Real => value.re,
            Self::Imaginary => value.im,
        }
    }
}

/// The real and the imaginary part.
pub(super) const PARTS: [Part; 2] = [Part::Real, Part::Imaginary];

/// A call of `forced_gradient`: of the real or the imaginary part of `h`, for the excitations that turn one way.
#[derive(Clone, Copy)]
pub(super) struct Call {
    part: Part,
    turn: f64,
    /// What belongs to no excitation is in the first call.
    first: bool,
}

impl Vibration {
    /// The calls that make up a part of `h`.
    pub(super) fn calls(&self, part: Part) -> impl Iterator<Item = Call> {
        let shares = &self.harmonic.shares;
        let turns = [1.0, -1.0].into_iter();
        let turns = turns.filter(|turn| shares.iter().any(|share| share.turn() == *turn));
        turns.enumerate().map(move |(k, turn)| Call { part, turn, first: k == 0 })
    }
}

/// Arguments of `forced_gradient` after the state.
pub(super) struct Weights {
    output: Vector,
    motion: [Vector; 3],
    share: Vector,
    cosine: Vector,
    sine: Vector,
    direct_cosine: Vector,
    direct_sine: Vector,
    frequency: Vector,
}

impl Weights {
    pub(super) fn zeros(sizes: Sizes) -> Self {
        let (n, o, e) = (sizes.coordinates, sizes.outputs, sizes.excitations);
        Self {
            output: Vector::zeros(o),
            motion: [(); 3].map(|()| Vector::zeros(n)),
            share: Vector::zeros(e),
            cosine: Vector::zeros(n),
            sine: Vector::zeros(n),
            direct_cosine: Vector::zeros(o),
            direct_sine: Vector::zeros(o),
            frequency: Vector::zeros(e),
        }
    }

    /// Of a call, without output; what does not depend on `motion` is multiplied by `fixed`.
    pub(super) fn of(sizes: Sizes, vibration: &Vibration, motion: &Motion, (call, fixed): (Call, f64)) -> Self {
        let mut weights = Self::zeros(sizes);
        let members = vibration.harmonic.shares.iter().filter(|share| share.turn() == call.turn);
        members.for_each(|share| weights.share[share.excitation] = fixed);
        if call.first {
            weights.motion = motion.each_ref().map(|x| x.map(|value| call.part.of(value)));
        }
        weights
    }

    /// For an output; what does not depend on `factors` is multiplied by `fixed`.
    pub(super) fn set_output(
        &mut self,
        output_adjoint: &OutputAdjoint<'_>,
        factors: &Factors,
        (call, fixed): (Call, f64),
    ) {
        let Call { part, turn, first } = call;
        self.cosine.set(&factors.left, |p| part.of(*p));
        let quadrature = |p: &Complex| turn * part.of(Complex::new(p.im, -p.re));
        self.sine.set(&factors.left, quadrature);
        let lists = [&mut self.output, &mut self.direct_cosine, &mut self.direct_sine];
        lists.into_iter().for_each(|list| list.fill(0.0));
        self.direct_cosine[output_adjoint.output] = fixed * part.of(Complex::ONE);
        self.direct_sine[output_adjoint.output] = fixed * turn * part.of(-Complex::I);
        if first {
            self.output[output_adjoint.output] = fixed;
            let first = &output_adjoint.vibration.harmonic.shares[0];
            self.frequency[first.excitation] = first.turn() * part.of(factors.slope);
        }
    }

    /// Of the frequency of a harmonic alone.
    pub(super) fn of_frequency(sizes: Sizes, vibration: &Vibration) -> Self {
        let mut weights = Self::zeros(sizes);
        let first = &vibration.harmonic.shares[0];
        weights.frequency[first.excitation] = first.turn();
        weights
    }

    /// All arguments, after these of the state or of its direction.
    pub(super) fn after<'a>(&'a self, [q, u, b]: [&'a [f64]; 3]) -> [&'a [f64]; 13] {
        let [acceleration, velocity, position] = &self.motion;
        [
            q,
            u,
            b,
            &self.output,
            acceleration,
            velocity,
            position,
            &self.share,
            &self.cosine,
            &self.sine,
            &self.direct_cosine,
            &self.direct_sine,
            &self.frequency,
        ]
    }

    /// Those that change from output to output, and their places in the list of factors.
    fn of_output(&self) -> [(usize, &[f64]); 6] {
        [
            (0, &self.output),
            (5, &self.cosine),
            (6, &self.sine),
            (7, &self.direct_cosine),
            (8, &self.direct_sine),
            (9, &self.frequency),
        ]
    }

    pub(super) fn gradient_into(&self, mechanism: &dyn Kernels, at: &Equilibrium, mut results: [&mut [f64]; 3]) {
        let state: [&[f64]; 3] = [&at.coordinates, &at.inputs, &at.design];
        mechanism.evaluate(Kernel::ForcedGradient, &self.after(state), &mut results);
    }
}
