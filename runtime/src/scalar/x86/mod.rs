//! Vectors of x86-64: two lanes of SSE2, four of AVX2, eight of AVX-512.
//!
//! The only unsafe code of the project. It rests on one fact: values of the wider types exist only inside tasks that [`Avx2`] and
//! [`Avx512`] run, and these two exist only where the processor has been asked for the instructions; every processor of this
//! kind has SSE2.
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

/// That the processor has a set of instructions: proof, and door to it.
macro_rules! set {
    ($(#[$doc:meta])* $name:ident $feature:tt $vector:ident $run:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) struct $name(());

        impl $name {
            /// Asks the processor; without the standard library, the target that is compiled for.
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

/// Runs a task on numbers with the instructions of AVX where the processor has them: these name the register of their
/// result, which saves a copy where both operands are needed again. Code shrinks by a quarter, and thousands of operations
/// fit into the cache of instructions. Without optimisation nothing is gained, and half of the code would be compiled in vain.
#[inline]
pub(super) fn compact<R>(task: impl FnOnce() -> R) -> R {
    // A task that could be dropped here would be cleaned up after a panic: LLVM then splits a block for every call in a kernel
    // that it inlines, which takes minutes for a large one.
    let task = ManuallyDrop::new(task);
    if !cfg!(debug_assertions) {
        #[cfg(feature = "std")]
        let found = std::is_x86_feature_detected!("avx");
        #[cfg(not(feature = "std"))]
        let found = cfg!(target_feature = "avx");
        if found {
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
