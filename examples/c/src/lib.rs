//! The rotating double pendulum for C: `include/double_pendulum.h` declares its functions, `main.c` calls them.
#![no_std]

use core::panic::PanicInfo;

include!(concat!(env!("OUT_DIR"), "/double_pendulum.rs"));

/// Kernels do not panic, but the language requires a handler.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}
