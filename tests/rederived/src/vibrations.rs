//! Forced vibrations: the dynamic stiffness solved in hyper-dual numbers.

use eigentol::Real;
use nalgebra::{Complex, DMatrix, DVector};

use super::complex::HyperComplex;
use super::machine::{Excited, REPETITIONS, Solution, State};
use super::{ComplexDerived, Derived};
use crate::hyper::Hyper;

/// The vibration of the outputs with one frequency, `Re(y e^{i w t})`.
#[derive(Clone, Debug, PartialEq)]
pub struct Vibration {
    /// `w`, rad/s; positive.
    pub frequency: Derived,
    /// `y`.
    pub outputs: Vec<ComplexDerived>,
    /// `|y|`.
    pub moduli: Vec<Derived>,
}

impl State {
    /// The vibration under some excitations of one frequency together, differentiated `rate` times by time.
    ///
    /// # Panics
    /// For a machine without excitations, and when `D(w)` is singular.
    pub fn vibration(&self, excitations: &[usize], rate: usize) -> Vibration {
        let solve = |solution: &Solution| solution.vibration(excitations, rate);
        let all: Vec<(Hyper, Vec<HyperComplex>)> = self.solutions.iter().map(solve).collect();
        let each = |number: &dyn Fn(HyperComplex) -> Hyper| -> Vec<Derived> {
            (0..all[0].1.len()).map(|o| self.derived(|k, _| number(all[k].1[o]))).collect()
        };
        let parts = each(&|y| y.re).into_iter().zip(each(&|y| y.im));
        Vibration {
            frequency: self.derived(|k, _| all[k].0),
            outputs: parts.map(|(re, im)| ComplexDerived { re, im }).collect(),
            moduli: each(&HyperComplex::modulus),
        }
    }
}

fn zero() -> HyperComplex {
    HyperComplex::constant(Complex::from(0.0))
}

fn imaginary(im: Hyper) -> HyperComplex {
    let re = Hyper::constant(0.0);
    HyperComplex { re, im }
}

/// `s^2 a + s v + x`.
fn polynomial(s: HyperComplex, [a, v, x]: [Hyper; 3]) -> HyperComplex {
    let re = x;
    let im = Hyper::constant(0.0);
    (s * s).scaled(a) + s.scaled(v) + HyperComplex { re, im }
}

impl Solution {
    fn excited(&self) -> &Excited {
        self.excited.as_ref().expect("excitations")
    }

    fn vibration(&self, excitations: &[usize], rate: usize) -> (Hyper, Vec<HyperComplex>) {
        let frequency = |k: usize| self.excited().forcing[1][k];
        let modulus = |w: Hyper| if w.value() < 0.0 { -w } else { w };
        let mut sum = vec![zero(); self.excited().outputs];
        for &k in excitations {
            let outputs = self.outputs_under(k, frequency(k));
            for (sum, y) in sum.iter_mut().zip(outputs) {
                // Re(y e^{-i w t}) = Re(conj(y) e^{i w t})
                let turned = match frequency(k).value() < 0.0 {
                    true => HyperComplex { im: -y.im, ..y },
                    false => y,
                };
                *sum = *sum + turned;
            }
        }
        let w = modulus(frequency(excitations[0]));
        for y in &mut sum {
            for _ in 0..rate {
                *y = *y * imaginary(w);
            }
        }
        (w, sum)
    }

    /// `y = c . z + direct` with `D z = F`, all at the declared frequency, which may be negative.
    fn outputs_under(&self, excitation: usize, w: Hyper) -> Vec<HyperComplex> {
        let (s, n) = (imaginary(w), self.coordinates.len());
        let Excited { forcing, motion, outputs } = self.excited();
        let amplitude = |cosine: usize, sine: usize, entry: usize| HyperComplex {
            re: forcing[cosine][entry],
            im: -forcing[sine][entry],
        };
        let force: Vec<HyperComplex> = (0..n).map(|i| amplitude(0, 3, excitation * n + i)).collect();
        let z = self.solved(s, &force);
        let output = |o: usize| {
            let row = (0..n).map(|i| {
                let place = o * n + i;
                polynomial(s, [0, 1, 2].map(|k| motion[k][place])) * z[i]
            });
            row.fold(amplitude(2, 4, excitation * outputs + o), |sum, x| sum + x)
        };
        (0..*outputs).map(output).collect()
    }

    /// `D(s)^-1 force`.
    fn solved(&self, s: HyperComplex, force: &[HyperComplex]) -> Vec<HyperComplex> {
        let n = force.len();
        let entry = |k: usize| polynomial(s, [self.mass[k], self.damping[k], self.stiffness[k]]);
        let stiffness: Vec<HyperComplex> = (0..n * n).map(entry).collect();
        let values = stiffness.iter().map(|entry| entry.parts()[0]);
        let factors = DMatrix::from_row_iterator(n, n, values).lu();
        let mut z = vec![zero(); n];
        for _ in 0..REPETITIONS {
            let rest = |i: usize| {
                let row = stiffness[i * n..(i + 1) * n].iter().zip(&z);
                row.fold(force[i], |rest, (entry, z)| rest - *entry * *z)
            };
            let rest: Vec<HyperComplex> = (0..n).map(rest).collect();
            let steps: [DVector<Complex<f64>>; Hyper::PARTS] = std::array::from_fn(|part| {
                let column = DVector::from_fn(n, |i, _| rest[i].parts()[part]);
                factors.solve(&column).expect("no resonance")
            });
            for (i, z) in z.iter_mut().enumerate() {
                *z = *z + HyperComplex::from_parts(std::array::from_fn(|part| steps[part][i]));
            }
        }
        z
    }
}
