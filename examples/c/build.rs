//! Compiles the declaration and writes the header.

fn main() {
    eigentol_build::compile_for_c("double_pendulum.mechanism", "include/double_pendulum.h");
}
