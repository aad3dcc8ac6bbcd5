//! The house itself: which crates and files may know each other, and the wrong lines that tests must notice.

mod architecture;
mod wrong_lines;
