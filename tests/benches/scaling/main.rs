//! What every question costs, against the number of coordinates: processor time on one thread, and its exponent.
//! `tests/benches/README.md` explains the rows.

mod machines;
mod questions;

use std::env;

use cpu_time::ProcessTime;

use questions::{QUESTIONS, Question};

const SIZES: [usize; 6] = [8, 16, 32, 64, 128, 256];
/// Repetitions end after this many seconds; the fastest counts.
const ENOUGH: f64 = 0.5;
/// A question that took longer is not asked at greater sizes.
const LONGEST: f64 = 20.0;
/// The exponent is that of the sizes from this one on.
const LARGE: usize = 32;

fn main() {
    let arguments = env::args().skip(1);
    let filters: Vec<String> = arguments.filter(|word| !word.starts_with('-')).collect();
    let wanted = |name: &str| filters.is_empty() || filters.iter().any(|part| name.contains(part));
    let sizes = SIZES.map(|n| format!("{n} |")).join(" ");
    println!("| milliseconds, n = | {sizes} exponent |");
    println!("| --- | {} ---: |", SIZES.map(|_| "---: |").join(" "));
    for question in QUESTIONS.iter().filter(|question| wanted(question.name)) {
        let times = times(question);
        let cells = times.iter().map(|time| match time {
            Some(seconds) => format!("{:.3} |", seconds * 1e3),
            None => "- |".to_owned(),
        });
        let cells: Vec<String> = cells.collect();
        let exponent = exponent(&times).map_or("-".to_owned(), |slope| format!("{slope:.1}"));
        println!("| {} | {} {exponent} |", question.name, cells.join(" "));
    }
}

/// Seconds at each size, `None` where that would take too long.
fn times(question: &Question) -> Vec<Option<f64>> {
    let mut last = 0.0;
    let time = |n: usize| {
        if last > LONGEST {
            return None;
        }
        let mut ask = (question.prepare)(n);
        let start = ProcessTime::now();
        let mut fastest = f64::INFINITY;
        while start.elapsed().as_secs_f64() < ENOUGH || fastest.is_infinite() {
            let process_time = ProcessTime::now();
            let count = ask();
            fastest = fastest.min(process_time.elapsed().as_secs_f64() / count as f64);
        }
        last = fastest;
        Some(fastest)
    };
    SIZES.into_iter().map(time).collect()
}

/// Slope of the logarithms, by least squares.
fn exponent(times: &[Option<f64>]) -> Option<f64> {
    let points = SIZES.iter().zip(times).filter(|(n, _)| **n >= LARGE);
    let points = points.filter_map(|(&n, time)| Some(((n as f64).ln(), (*time)?.ln())));
    let points: Vec<(f64, f64)> = points.collect();
    let count = points.len() as f64;
    let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let spread: f64 = points.iter().map(|point| (point.0 - x).powi(2)).sum();
    let along: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    (points.len() > 1).then(|| along / spread)
}
