//! Vectors of x86-64: two lanes of SSE2, four of AVX2, eight of AVX-512.
//!
//! The only unsafe code of the project. It rests on one fact: values of the wider types exist only inside tasks that
//! [`Avx2`] and [`Avx512`] run, and these two exist only if the processor was found to have the instructions; every
//! x86-64 processor has SSE2.
//!
//! # Lanes are a scalar type
//!
//! A kernel runs in vectors because a processor vector is a `Real` (`scalar/x86`): every statement becomes one
//! instruction for four or eight states, whatever LLVM's loop vectoriser makes of thousands of statements (it gives up
//! where results need more than some 250 stores). Instructions chosen at run time reach only code inlined into the
//! function that chose them, so these kernels have an inlined twin in the trait (`linear` calls `linear_inlined`), and
//! everything there is `#[inline(always)]` and uses loops, not iterator adaptors. No operation is fused, and sine,
//! cosine and powers are our own, so every instruction set gives the same bits.
#![allow(unsafe_code)]

mod eight;
mod four;
mod real;
mod two;

use core::mem::ManuallyDrop;

use eight::Eight;
use four::Four;
pub(super) use two::sines_and_cosines;

use super::lanes::Task;

/// Proof that the processor has a set of instructions, which gives access to them.
macro_rules! set {
    ($(#[$doc:meta])* $name:ident $feature:tt $vector:ident $run:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) struct $name(());

        impl $name {
            /// Detects the instructions in the processor or, without the standard library, in the compilation target.
            #[inline]
            pub(super) fn detect() -> Option<Self> {
                #[cfg(feature = "std")]
                let found = std::is_x86_feature_detected!($feature);
                #[cfg(not(feature = "std"))]
                let found = cfg!(target_feature = $feature);
                found.then_some(Self(()))
            }

            /// Runs a task with these instructions.
            #[inline]
            pub(super) fn run<T: Task>(self, task: T) -> T::Output {
                // SAFETY: `self` exists, so the processor has the feature.
                unsafe { $run(task) }
            }
        }

        #[target_feature(enable = $feature)]
        fn $run<T: Task>(task: T) -> T::Output {
            task.run::<$vector>()
        }
    };
}

set! {
    /// Vectors of four lanes.
    Avx2 "avx2" Four avx2
}
set! {
    /// Vectors of eight lanes.
    Avx512 "avx512f" Eight avx512
}

/// Runs a scalar task with AVX instructions if the processor has them.
///
/// AVX instructions name a separate result register, which saves a copy if both operands are needed again. The code
/// shrinks by a quarter, so that thousands of operations fit into the instruction cache. Without optimisation there is
/// no gain, and half of the code would be compiled in vain.
#[inline]
pub(super) fn compact<R>(task: impl FnOnce() -> R) -> R {
    // A task that could be dropped here would be cleaned up after a panic: LLVM then splits a block for every call in a
    // kernel that it inlines, which takes minutes for a large kernel.
    let task = ManuallyDrop::new(task);
    if !cfg!(debug_assertions) {
        #[cfg(feature = "std")]
        let has_avx = std::is_x86_feature_detected!("avx");
        #[cfg(not(feature = "std"))]
        let has_avx = cfg!(target_feature = "avx");
        if has_avx {
            // SAFETY: the processor has the feature.
            return unsafe { avx(ManuallyDrop::into_inner(task)) };
        }
    }
    ManuallyDrop::into_inner(task)()
}

#[target_feature(enable = "avx")]
fn avx<R>(task: impl FnOnce() -> R) -> R {
    task()
}
