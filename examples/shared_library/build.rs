//! Compiles the declaration.

fn main() {
    eigentol_build::compile("rotor.mechanism");
}
