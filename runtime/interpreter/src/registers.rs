//! Storage for the values of a running tape: numbers of any kind, or the numbers of several states in vectors.

use std::cell::RefCell;
use std::marker::PhantomData;

use eigentol::scalar::{Batch, Instructions, Lanes, Task, WIDTH};
use eigentol::{Dual, Real};

use crate::tape::{Registers, Tape};

struct Scalars<'a, T>(&'a mut [T]);

impl<T: Real> Registers for Scalars<'_, T> {
    type Number = T;

    #[inline(always)]
    fn get(&self, register: u32) -> T {
        self.0[register as usize]
    }

    #[inline(always)]
    fn set(&mut self, register: u32, value: T) {
        self.0[register as usize] = value;
    }
}

/// The states from index `at` on.
struct Vectors<'a, V> {
    batches: &'a mut [Batch],
    at: usize,
    kind: PhantomData<V>,
}

impl<V: Lanes> Registers for Vectors<'_, V> {
    type Number = V;

    #[inline(always)]
    fn get(&self, register: u32) -> V {
        V::load(&self.batches[register as usize], self.at)
    }

    #[inline(always)]
    fn set(&mut self, register: u32, value: V) {
        value.store(&mut self.batches[register as usize], self.at);
    }
}

/// The derivatives along the directions from index `at` on, of one state.
struct Directions<'a, V> {
    duals: &'a mut [Dual<Batch>],
    at: usize,
    kind: PhantomData<V>,
}

impl<V: Lanes> Registers for Directions<'_, V> {
    type Number = Dual<V>;

    #[inline(always)]
    fn get(&self, register: u32) -> Dual<V> {
        let Dual { value, slope } = &self.duals[register as usize];
        Dual { value: V::load(value, self.at), slope: V::load(slope, self.at) }
    }

    #[inline(always)]
    fn set(&mut self, register: u32, to: Dual<V>) {
        let Dual { value, slope } = &mut self.duals[register as usize];
        to.value.store(value, self.at);
        to.slope.store(slope, self.at);
    }
}

/// A type of number whose registers each thread keeps between calls.
pub(crate) trait Kept: Copy + Sized + 'static {
    fn constant(value: f64) -> Self;
    fn with_kept<R>(work: impl FnOnce(&mut Vec<Self>) -> R) -> R;
}

macro_rules! kept {
    ($kind:ty, $constant:expr) => {
        impl Kept for $kind {
            #[inline]
            fn constant(value: f64) -> Self {
                $constant(value)
            }

            #[inline]
            fn with_kept<R>(work: impl FnOnce(&mut Vec<Self>) -> R) -> R {
                thread_local! {
                    static KEPT: RefCell<Vec<$kind>> = const { RefCell::new(Vec::new()) };
                }
                KEPT.with_borrow_mut(work)
            }
        }
    };
}

kept!(f64, |value| value);
kept!(Dual<f64>, Dual::fixed);
kept!(Batch, Batch::all);
kept!(Dual<Batch>, |value| Dual { value: Batch::all(value), slope: Batch::all(0.0) });

/// Writes constants and arguments to their registers, runs the tape, and passes the registers to `read`.
#[inline]
fn evaluate<T: Kept, R>(
    tape: &Tape,
    arguments: &[&[T]],
    run: impl FnOnce(&mut [T]),
    read: impl FnOnce(&[T]) -> R,
) -> R {
    T::with_kept(|registers| {
        if registers.len() < tape.registers {
            registers.resize(tape.registers, T::constant(0.0));
        }
        let registers = &mut registers[..tape.registers];
        for (register, constant) in registers.iter_mut().zip(&tape.constants) {
            *register = T::constant(*constant);
        }
        let mut offset = tape.constants.len();
        for (argument, count) in arguments.iter().zip(&tape.arguments) {
            registers[offset..offset + count].copy_from_slice(argument);
            offset += count;
        }
        run(registers);
        read(registers)
    })
}

/// Evaluates one state.
#[inline]
pub(crate) fn scalar<T: Kept + Real, R>(tape: &Tape, arguments: &[&[T]], read: impl FnOnce(&[T]) -> R) -> R {
    let run = |registers: &mut [T]| T::run(|| tape.run(&mut Scalars(registers)));
    evaluate(tape, arguments, run, read)
}

/// Evaluates one state in a rarely used type of number, without keeping the registers.
pub(crate) fn once<T: Real>(tape: &Tape, arguments: &[&[T]]) -> Vec<T> {
    let mut registers: Vec<T> = tape.constants.iter().map(|&c| T::constant(c)).collect();
    for argument in arguments {
        registers.extend_from_slice(argument);
    }
    registers.resize(tape.registers, T::constant(0.0));
    tape.run(&mut Scalars(&mut registers));
    registers
}

/// Evaluates several states at once.
pub(crate) fn batch<R>(
    tape: &Tape,
    instructions: Instructions,
    arguments: &[&[Batch]],
    read: impl FnOnce(&[Batch]) -> R,
) -> R {
    let run = |batches: &mut [Batch]| instructions.run(SideBySide { tape, batches });
    evaluate(tape, arguments, run, read)
}

/// Evaluates one state with derivatives along several directions at once.
pub(crate) fn along_each<R>(tape: &Tape, arguments: &[&[Dual<Batch>]], read: impl FnOnce(&[Dual<Batch>]) -> R) -> R {
    let run = |duals: &mut [Dual<Batch>]| Instructions::best().run(AlongEach { tape, duals });
    evaluate(tape, arguments, run, read)
}

struct AlongEach<'a> {
    tape: &'a Tape,
    duals: &'a mut [Dual<Batch>],
}

impl Task for AlongEach<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        for at in (0..WIDTH).step_by(V::WIDTH) {
            self.tape.run(&mut Directions::<V> { duals: self.duals, at, kind: PhantomData });
        }
    }
}

struct SideBySide<'a> {
    tape: &'a Tape,
    batches: &'a mut [Batch],
}

impl Task for SideBySide<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        for at in (0..WIDTH).step_by(V::WIDTH) {
            self.tape.run(&mut Vectors::<V> { batches: self.batches, at, kind: PhantomData });
        }
    }
}
