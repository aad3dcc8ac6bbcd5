//! Checks the kernels of many random mechanisms against their equations of motion: `-- --trees 1000000`.

use std::process::ExitCode;

use clap::Parser;
use eigentol_consistency::trees::{Tree, summary, text, tree};

/// Every kernel of random mechanisms full of special cases against `motion_residual` in dual numbers.
#[derive(Parser)]
struct Options {
    /// Number of mechanisms.
    #[arg(long, default_value_t = 10_000)]
    trees: u64,
    /// Number of the first mechanism.
    #[arg(long, default_value_t = 0)]
    from: u64,
    /// Print one mechanism and all its differences.
    #[arg(long)]
    show: Option<u64>,
}

fn main() -> ExitCode {
    let options = Options::parse();
    if let Some(number) = options.show {
        println!("{}", text(number));
        match tree(number) {
            Tree::Compared(outcome, taken) => println!("{taken:#?}\n{outcome:#?}"),
            Tree::Refused(messages) => println!("{messages:#?}"),
        }
        return ExitCode::SUCCESS;
    }
    let found = summary(options.from, options.from + options.trees);
    println!(
        "{} compared, {} refused, {} wrong; {} values, {} blurred by rounding",
        found.compared,
        found.refused,
        found.wrong.len(),
        found.values,
        found.blurred
    );
    for (case, count) in &found.taken {
        println!("{count:>9}  {case}");
    }
    if found.wrong.is_empty() {
        return ExitCode::SUCCESS;
    }
    let some = &found.wrong[..found.wrong.len().min(20)];
    println!("wrong: {some:?} (see them with --show)");
    ExitCode::FAILURE
}
