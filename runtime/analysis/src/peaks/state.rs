//! One value of the input: the vibrations there, their derivatives, and the poles around them.

use crate::algebra::Vector;
use crate::equilibrium::{Needed, OperatingPoint, solve_into};
use crate::forced::{Curving, CurvingLine, Extent, Line, Lines, Vibration, Wanted, resonance};
use crate::kernels::CurvatureKernels;
use crate::modes::{Family, Modes};
use crate::sweep::{Following, Range};
use crate::{Complex, Equilibrium, Error, Input, Watch};

/// Where vibrations are looked for.
pub(super) struct Along<'a> {
    mechanism: &'a dyn CurvatureKernels,
    inputs: &'a [f64],
    design: &'a [f64],
    following: Following,
    input: Input,
    wanted: Vec<Wanted>,
    pub(super) watch: Watch<'a>,
}

/// The vibrations at one value of the input.
pub(super) struct ResponsePoint {
    pub(super) value: f64,
    pub(super) equilibrium: Equilibrium,
    /// The eigenvalues of the modes, 1/s; empty if only the vibrations were wanted.
    poles: Vec<Complex>,
    pub(super) lines: Vec<Line>,
}

/// One vibration at one value of the input.
#[derive(Clone, Copy)]
pub(super) struct Heard<'a> {
    pub(super) point: &'a ResponsePoint,
    pub(super) line: &'a Line,
}

/// A single vibration at one value of the input, and how it changes with the design.
pub(super) struct Curve {
    pub(super) point: ResponsePoint,
    curving: CurvingLine,
    input: usize,
}

impl<'a> Along<'a> {
    pub(super) fn new(
        mechanism: &'a dyn CurvatureKernels,
        (inputs, design): (&'a [f64], &'a [f64]),
        following: Following,
        (range, vibrations): (&Range, &'a [Vibration]),
        watch: Watch<'a>,
    ) -> Result<Self, Error> {
        let description = mechanism.description();
        range.check(&description)?;
        let wanted = vibrations.iter().map(|vibration| Wanted::new(*vibration, &description));
        Ok(Self {
            wanted: wanted.collect::<Result<_, Error>>()?,
            input: range.input,
            mechanism,
            inputs,
            design,
            following,
            watch,
        })
    }

    /// The state at a value of the input, on the branch of the equilibrium `from`, with its poles.
    pub(super) fn state(&self, value: f64, from: &[f64]) -> Result<ResponsePoint, Error> {
        let (equilibrium, modes) = self.equilibrium(value, from, Needed::Modes)?;
        let lines = Lines::new(self.mechanism, &equilibrium, self.input.index())?;
        let lines = self.wanted.iter().map(|wanted| lines.line(wanted, &modes.modes));
        Ok(ResponsePoint {
            value,
            lines: lines.collect::<Result<_, Error>>()?,
            poles: modes.modes.iter().map(|mode| mode.s).collect(),
            equilibrium,
        })
    }

    /// The state with one vibration and without poles.
    pub(super) fn vibration(&self, value: f64, from: &[f64], which: usize) -> Result<ResponsePoint, Error> {
        let changing = |_: &Lines<'_>, _: &Wanted| Ok(());
        Ok(self.solved(value, from, which, changing)?.0)
    }

    /// The same, and how it changes.
    pub(super) fn curve(&self, value: f64, from: &[f64], which: usize) -> Result<Curve, Error> {
        let changing = |lines: &Lines<'_>, wanted: &Wanted| lines.curving(wanted);
        let (point, curving) = self.solved(value, from, which, changing)?;
        Ok(Curve { point, curving, input: self.input.index() })
    }

    fn solved<T>(
        &self,
        value: f64,
        from: &[f64],
        which: usize,
        changing: impl Fn(&Lines<'_>, &Wanted) -> Result<T, Error>,
    ) -> Result<(ResponsePoint, T), Error> {
        let (equilibrium, _) = self.equilibrium(value, from, Needed::State)?;
        let lines = Lines::new(self.mechanism, &equilibrium, self.input.index())?;
        let wanted = &self.wanted[which];
        let line = lines.line(wanted, &[])?;
        let changes = changing(&lines, wanted)?;
        let point = ResponsePoint { value, lines: vec![line], poles: Vec::new(), equilibrium };
        Ok((point, changes))
    }

    /// The equilibrium of a state with its stability.
    pub(super) fn judged(&self, state: &ResponsePoint) -> Result<Equilibrium, Error> {
        Ok(self.equilibrium(state.value, &state.equilibrium.coordinates, Needed::Verdict)?.0)
    }

    /// The error for a vibration whose amplitude is infinite next to a state.
    pub(super) fn resonance(&self, which: usize, state: &ResponsePoint) -> Error {
        let (line, vibration) = (&state.lines[which], &self.wanted[which].vibration);
        let tone = line.loudest();
        let several = line.tones.len() > 1;
        let own = several.then(|| Vibration::firsts(&state.equilibrium.description).nth(tone));
        let with = own.flatten().unwrap_or(vibration.excitation.index());
        resonance(&state.equilibrium, with, line.tones[tone].frequency[0])
    }

    fn equilibrium(&self, value: f64, from: &[f64], needed: Needed) -> Result<(Equilibrium, Modes), Error> {
        if self.watch.stopped() {
            return Err(Error::Stopped);
        }
        let mut inputs = Vector::from(self.inputs);
        inputs[self.input.index()] = value;
        let point = OperatingPoint::new(self.mechanism, &inputs, self.design)?;
        let point = point.held_by(&self.following.held).only(needed);
        point.check_start(from)?;
        let mut at = Equilibrium::blank(&point.description, &inputs, self.design);
        let judged = solve_into(&point, from, self.following.policy, &mut at)
            .map_err(|failure| failure.explain(&point.description))?;
        at.regular()?;
        let mut modes = Modes::empty(Family::of(&at.description), &at.description);
        if needed == Needed::Modes {
            modes.solve_at(&at, judged)?;
        }
        self.watch.advance(1);
        Ok((at, modes))
    }
}

/// The square of the vibration, `A`, and `dA/du` with the input `u`.
pub(super) struct Square {
    pub(super) value: f64,
    pub(super) slope: f64,
}

impl ResponsePoint {
    /// One of its vibrations.
    pub(super) fn heard(&self, which: usize) -> Heard<'_> {
        Heard { point: self, line: &self.lines[which] }
    }
}

impl Curve {
    pub(super) fn heard(&self) -> Heard<'_> {
        self.point.heard(0)
    }

    /// `d2A/du2`.
    pub(super) fn bend(&self) -> f64 {
        let Line { extent, amplitudes: [y, dy], .. } = self.heard().line;
        extent.square_curvature(y, [dy, dy], &self.parts(|own| own.along.by_input[self.input]))
    }

    /// One derivative of each part.
    fn parts(&self, of: impl Fn(&Curving<Complex>) -> Complex) -> Vec<Complex> {
        self.curving.amplitudes.iter().map(of).collect()
    }

    /// By each design variable, a function of one derivative of each part, and of that along the input.
    fn by_design(&self, of: impl Fn(&[Complex], &[Complex]) -> f64) -> Vector {
        let one = |k: usize| of(&self.parts(|x| x.slopes.by_design[k]), &self.parts(|x| x.along.by_design[k]));
        (0..self.point.equilibrium.design.len()).map(one).collect()
    }

    /// `dA/db` for each design variable.
    pub(super) fn square_by_design(&self) -> Vector {
        let Line { extent, amplitudes: [y, _], .. } = self.heard().line;
        self.by_design(|slope, _| extent.square_slope(y, slope))
    }

    /// `d2A/(du db)` for each design variable.
    pub(super) fn bend_by_design(&self) -> Vector {
        let Line { extent, amplitudes: [y, dy], .. } = self.heard().line;
        self.by_design(|slope, along| extent.square_curvature(y, [dy, slope], along))
    }

    /// The derivatives of the height by the design, of those of its square.
    pub(super) fn height_by_design(&self, square: &Vector) -> Vector {
        let height = self.heard().height();
        square.map(|value| value / (2.0 * height))
    }

    /// The derivatives by the design of the square at the peak next to here: as if its place were exact, where a sharp
    /// peak leaves nothing of the digits of its place.
    pub(super) fn top_by_design(&self) -> Vector {
        let off = self.heard().square().slope / self.bend();
        self.square_by_design().into_iter().zip(self.bend_by_design()).map(|(here, bend)| here - off * bend).collect()
    }

    /// The part of the height of a peak here that rounding decides when each design variable changes by itself: its place
    /// moves by many widths, and height and width are what is left of differences.
    pub(super) fn doubt(&self, design: &[f64]) -> f64 {
        let design = design.iter();
        let squares = |slopes: &[Complex]| slopes.iter().map(|dy| dy.norm_sqr()).sum::<f64>();
        let moved = self.by_design(|slopes, _| squares(slopes));
        let moved = moved.iter().zip(design).map(|(square, value)| square * value * value).sum::<f64>();
        self.heard().line.rounding * moved.sqrt() / self.heard().height()
    }

    /// How far a peak here moves with the design.
    pub(super) fn place_by_design(&self) -> Vector {
        let bend = self.bend();
        self.bend_by_design().map(|value| -value / bend)
    }

    /// The frequency of a tone, and how it moves with the design at a place that moves so.
    pub(super) fn frequency(&self, tone: usize, place: &Vector) -> (f64, Vector) {
        let [w, slope] = self.heard().line.tones[tone].frequency;
        let here = self.curving.frequencies[tone].slopes.by_design.iter().zip(place);
        (w, here.map(|(dw, du)| dw + slope * du).collect())
    }
}

impl<'a> Heard<'a> {
    pub(super) fn square(&self) -> Square {
        let Line { extent, amplitudes: [y, dy], .. } = self.line;
        let slope = extent.square_slope(y, dy);
        let value = match extent {
            Extent::Amplitude => y[0].norm_sqr(),
            _ => extent.value(y).powi(2),
        };
        Square { value, slope: if slope.is_nan() { 0.0 } else { slope } }
    }

    pub(super) fn height(&self) -> f64 {
        self.line.extent.value(&self.line.amplitudes[0])
    }

    /// How the poles that are heard here pass `i w` on the way to another state.
    pub(super) fn passages(self, to: Self) -> impl Iterator<Item = Passage> + 'a {
        let tones = self.line.tones.iter().zip(&to.line.tones);
        tones.flat_map(move |(tone, there)| {
            let [w, w_there] = [tone, there].map(|tone| tone.frequency[0]);
            let poles = self.point.poles.iter().zip(&tone.residues);
            let heard = poles.filter(|(s, residue)| **residue > QUIET * s.re.abs());
            heard.map(move |(&s, _)| {
                let there = nearest(s, &to.point.poles);
                let moved = (w - w_there).abs() + (s - there).norm();
                Passage {
                    holds: moved <= PART * (Complex::new(0.0, w) - s).norm(),
                    known: nearest(there, &self.point.poles) == s,
                    off: [w - s.im, w_there - there.im],
                    width: s.re.abs().max(there.re.abs()),
                }
            })
        })
    }
}

/// How a pole passes `i w` along a stretch.
pub(super) struct Passage {
    /// The two move relative to each other by a part of their distance only.
    pub(super) holds: bool,
    /// It is the same pole at both ends.
    pub(super) known: bool,
    /// `w - Im s` at both ends.
    pub(super) off: [f64; 2],
    /// The larger `|Re s|`.
    pub(super) width: f64,
}

/// Part of its distance by which a pole may move along a stretch on which it holds.
const PART: f64 = 0.5;
/// Height of a peak, relative to the amplitude beside it, that is none.
const QUIET: f64 = 1e-6;

fn nearest(s: Complex, poles: &[Complex]) -> Complex {
    let mut poles = poles.iter().copied();
    let first = poles.next().unwrap_or(s);
    poles.fold(first, |best, pole| if (pole - s).norm() < (best - s).norm() { pole } else { best })
}
