//! Timing with criterion.

use std::cell::Cell;
use std::time::{Duration, Instant};

use criterion::Criterion;

use crate::work::Work;

/// Criterion with windows short enough that both sides of a comparison run under the same load.
pub(crate) fn criterion() -> Criterion {
    Criterion::default()
        .without_plots()
        .sample_size(30)
        .nresamples(2000)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .configure_from_args()
}

/// Nanoseconds per unit of `work`: the minimum of criterion's samples, which other load disturbs least; `None` if
/// criterion's filter excluded it.
pub(crate) fn time(criterion: &mut Criterion, name: &str, units: usize, work: &mut dyn Work) -> Option<f64> {
    let least = Cell::new(f64::INFINITY);
    criterion.bench_function(name, |bencher| {
        bencher.iter_custom(|iterations| {
            let start = Instant::now();
            work.run(iterations);
            let taken = start.elapsed();
            let each = taken.as_secs_f64() * 1e9 / iterations as f64;
            least.set(least.get().min(each));
            taken
        });
    });
    let least = least.get();
    least.is_finite().then(|| least / units as f64)
}
