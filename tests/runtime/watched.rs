//! Long computations with progress reports, cancellation and intermediate results.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use eigentol::allocation::{Choices, Cost, HalfWidth};
use eigentol::branches::BranchEnd;
use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{Error, Quantity, Study, mechanism};

mechanism! {
    mechanism Pendulum {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m +/- 10%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        output angle = theta;
    }
}

const FREQUENCY: Response = Response::Mode { mode: 0, quantity: Quantity::Frequency };

const ANGLE: Response = Response::Output(Pendulum::angle.any());

fn pendulum() -> Study<Pendulum> {
    Study::new(Pendulum).input(Pendulum::omega, 5.0).start(Pendulum::theta, 1.0)
}

/// Speeds through the pitchfork at 3.8360 rad/s.
fn speeds() -> Vec<f64> {
    (0..60).map(|k| 3.0 + 0.05 * f64::from(k)).collect()
}

/// A study that is stopped after the given number of steps, and its step count.
fn stopped_after(study: Study<Pendulum>, steps: usize) -> (Study<Pendulum>, Arc<AtomicUsize>) {
    let (flag, done) = (Arc::new(AtomicBool::new(steps == 0)), Arc::new(AtomicUsize::new(0)));
    let (own, count) = (Arc::clone(&flag), Arc::clone(&done));
    let progress = move |more| {
        if count.fetch_add(more, Ordering::Relaxed) + more >= steps {
            own.store(true, Ordering::Relaxed);
        }
    };
    (study.stop(flag).progress(progress), done)
}

/// Where a partial result is useless, stopping is an error; otherwise the result so far is returned.
#[test]
fn questions_about_responses_stop() {
    type Question = fn(&Study<Pendulum>) -> Result<(), Error>;
    let questions: [(&str, Question); 4] = [
        ("propagate", |s| s.propagate(&[ANGLE]).map(drop)),
        ("worst_case", |s| s.worst_case(&[ANGLE]).map(drop)),
        ("influence", |s| s.influence(&[ANGLE]).map(drop)),
        ("reliability", |s| s.reliability(&[Requirement::at_least(ANGLE, 0.9)]).map(drop)),
    ];
    for (name, question) in questions {
        let (study, done) = stopped_after(pendulum().samples(300), usize::MAX);
        question(&study).unwrap_or_else(|error| panic!("{name}: {error}"));
        let all = done.load(Ordering::Relaxed);
        assert!(all > 1, "{name}: {all}");
        let (study, done) = stopped_after(pendulum().samples(300).threads(1), all / 2);
        assert!(matches!(question(&study), Err(Error::Stopped)), "{name}");
        assert_eq!(done.load(Ordering::Relaxed), all / 2, "{name}");
    }
    // Frequencies are solved in vectors.
    let (study, _) = stopped_after(pendulum(), 0);
    assert!(matches!(study.propagate(&[FREQUENCY]), Err(Error::Stopped)));
    let (study, done) = stopped_after(pendulum(), 500);
    let sampling = study.sampling().samples(3000).threads(1);
    let part = study.sample_responses(&[ANGLE], &sampling).unwrap();
    let ranges = part.ranges();
    let count = ranges.iter().map(|range| range.end - range.start).sum::<u64>();
    assert!((500..3000).contains(&count) && count as usize == done.load(Ordering::Relaxed));
    let (study, _) = stopped_after(pendulum(), 10);
    let mut seen = 0;
    let counted = study.sensitivity_sweep(Pendulum::omega, &speeds(), |_, _| seen += 1);
    assert!(counted.is_ok() && seen == 10, "{seen}");
}

#[test]
fn diagrams_come_point_by_point() {
    let study = pendulum();
    let whole = study.campbell(Pendulum::omega, &speeds(), &[1.0]).unwrap();
    let mut points = Vec::new();
    let mut shown = study
        .campbell_each(Pendulum::omega, &speeds(), &[1.0], |point| {
            points.push(point);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(shown.points.is_empty() && points.len() == 60);
    assert_eq!(shown.critical.len(), 1);
    shown.points = points;
    assert_eq!(shown, whole);
}

#[test]
fn sweeps_come_point_by_point() {
    let study = pendulum();
    for values in [speeds(), speeds().into_iter().rev().collect()] {
        let whole = study.sweep(Pendulum::omega, &values).unwrap();
        let mut points = Vec::new();
        let mut shown = study
            .sweep_each(Pendulum::omega, &values, |point| {
                points.push(point.clone());
                ControlFlow::Continue(())
            })
            .unwrap();
        assert_eq!((shown.critical.len(), points.len()), (1, 60));
        shown.points = points;
        assert_eq!(shown, whole);
    }
}

#[test]
fn whoever_looks_on_may_break_off() {
    let mut seen = 0;
    let mut enough = || {
        seen += 1;
        match seen % 7 {
            0 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    };
    let study = pendulum();
    let swept = study.sweep_each(Pendulum::omega, &speeds(), |_| enough()).unwrap();
    let drawn = study.campbell_each(Pendulum::omega, &speeds(), &[1.0], |_| enough()).unwrap();
    assert_eq!(seen, 14);
    let missing = speeds().len() - 7;
    assert_eq!((swept.unreached, drawn.unreached), (missing, missing));
}

#[test]
fn sweeps_and_diagrams_stop_with_what_is_done() {
    let (study, done) = stopped_after(pendulum(), 10);
    let whole = pendulum().campbell(Pendulum::omega, &speeds(), &[1.0]).unwrap();
    let part = study.campbell(Pendulum::omega, &speeds(), &[1.0]).unwrap();
    assert_eq!(part.points, whole.points[..10]);
    assert_eq!(done.load(Ordering::Relaxed), 10);
    let missing = speeds().len() - 10;
    assert_eq!((whole.unreached, part.unreached), (0, missing));
    let line = format!("Not complete: {missing} of the values were not reached");
    assert!(part.to_string().contains(&line) && !whole.to_string().contains(&line));
    let (study, _) = stopped_after(pendulum(), 10);
    let whole = pendulum().sweep(Pendulum::omega, &speeds()).unwrap();
    let part = study.sweep(Pendulum::omega, &speeds()).unwrap();
    assert_eq!(part.points, whole.points[..10]);
    assert!(part.critical.is_empty() && !whole.critical.is_empty());
    assert_eq!((whole.unreached, part.unreached), (0, missing));
    assert!(part.to_string().contains(&line) && !whole.to_string().contains(&line));
}

#[test]
fn branches_stop_with_what_is_done() {
    let whole = pendulum().branches(Pendulum::omega, 0.0, 6.0).unwrap();
    let mut first = Vec::new();
    let settings = pendulum().continuation(Pendulum::omega, 0.0, 6.0).unwrap();
    let all = pendulum().branches_each(&settings, None, |branch| first.push(branch.clone()));
    assert_eq!(all.unwrap(), whole);
    assert_eq!(first, whole.branches);

    let (study, done) = stopped_after(pendulum(), 5);
    let part = study.branches(Pendulum::omega, 0.0, 6.0).unwrap();
    assert!(part.truncated && part.branches.len() == 1);
    let branch = &part.branches[0];
    assert!(branch.ends.contains(&BranchEnd::Stopped));
    let points = branch.points.len();
    assert!(points >= 5 && points < whole.branches[0].points.len(), "{points}");
    assert!(done.load(Ordering::Relaxed) < points);
    let text = part.to_string();
    assert!(text.contains("stopped: there may be more"), "{text}");
    assert!(!whole.to_string().contains("stopped"));
}

#[test]
fn samples_stop_with_what_is_done() {
    let (study, done) = stopped_after(pendulum().samples(100_000).threads(1), 1);
    let part = study.monte_carlo().unwrap();
    assert!((1..100_000).contains(&part.samples));
    assert_eq!((part.planned, done.load(Ordering::Relaxed)), (100_000, part.samples));
}

/// A partial verdict is no verdict.
#[test]
fn a_summary_that_is_stopped_is_no_summary() {
    for steps in [0, 1] {
        let (study, _) = stopped_after(pendulum(), steps);
        assert_eq!(study.summary(), Err(Error::Stopped));
    }
    let (study, done) = stopped_after(pendulum(), usize::MAX);
    assert_eq!(study.summary(), pendulum().summary());
    assert!(done.load(Ordering::Relaxed) > 0);
}

/// Watching changes neither the study nor its results.
#[test]
fn who_waits_changes_nothing() {
    let (study, _) = stopped_after(pendulum(), usize::MAX);
    assert_eq!(study, pendulum());
    assert_eq!(study.monte_carlo(), pendulum().monte_carlo());
}

fn wanted() -> [Requirement; 2] {
    [Requirement::at_least(FREQUENCY, 3.95), Requirement::Stable]
}

#[test]
fn chances_of_ranges_add_up() {
    let study = pendulum().samples(1000);
    let whole = study.chances(&wanted()).unwrap();
    assert!(whole.all.failed > 0 && whole.all.met > 0);
    for cut in [1, 63, 64, 500, 999] {
        let part = |range| {
            let sampling = study.sampling().range(Some(range));
            study.chances_by(&wanted(), &sampling).unwrap()
        };
        let parts = [part(0..cut), part(cut..1000)];
        assert_eq!(parts[0].all.samples() as u64, cut);
        assert_eq!(parts[0].planned, 1000);
        assert!(parts[0].to_string().contains("Not complete: 1000 samples"));
        let sum = |of: fn(&eigentol::requirement::Tally) -> usize, k: usize| {
            parts.iter().map(|part| of(&part.each[k])).sum::<usize>()
        };
        for (k, each) in whole.each.iter().enumerate() {
            assert_eq!(sum(|own| own.met, k), each.met);
            assert_eq!(sum(|own| own.failed, k), each.failed);
            assert_eq!(sum(|own| own.untold, k), each.untold);
        }
    }
    assert!(!whole.to_string().contains("Not complete"));
}

#[test]
fn ranges_that_are_none_of_the_samples_are_refused() {
    let study = pendulum().samples(1000);
    for (first, end) in [(0, 1001), (7, 7), (5, 4)] {
        let sampling = study.sampling().range(Some(first..end));
        let refused = study.chances_by(&wanted(), &sampling);
        assert!(matches!(refused, Err(Error::Setting { setting: "range", .. })), "{first}..{end}");
    }
}

#[test]
fn chances_stop_with_what_is_done() {
    let (study, done) = stopped_after(pendulum().samples(100_000).threads(1), 200);
    let part = study.chances(&wanted()).unwrap();
    assert_eq!(part.all.samples(), 256);
    assert_eq!((part.planned, done.load(Ordering::Relaxed)), (100_000, 256));
    // At least the first samples are done: there is no share of nothing.
    let (study, _) = stopped_after(pendulum().samples(100_000), 0);
    assert_eq!(study.chances(&wanted()).unwrap().all.samples(), 64);
}

fn choices() -> Choices<'static> {
    let widths =
        HalfWidth { variable: Pendulum::l.index(), limits: (1e-3, 0.3), cost: Cost::reciprocal(0.0, 1.0, 1.0) };
    Choices { half_widths: vec![widths], nominals: Vec::new(), failure: vec![0.01] }
}

/// The start is returned if it is already reliable enough; otherwise there is no result yet.
#[test]
fn allocations_stop_with_the_best_so_far() {
    let at_least = |limit| [Requirement::at_least(FREQUENCY, limit)];
    let whole = pendulum().allocation(&at_least(3.0), &choices()).unwrap();
    assert!(!whole.stopped);
    let (study, _) = stopped_after(pendulum(), 1);
    let part = study.allocation(&at_least(3.0), &choices()).unwrap();
    assert!(part.stopped && part.cost >= whole.cost && part.evaluations < whole.evaluations);
    assert_eq!(part.chances.all.samples(), 64);
    let text = part.to_string();
    for sentence in ["Stopped: there may be cheaper", "Not complete: 3000 samples"] {
        assert!(text.contains(sentence), "{text}");
    }
    let (study, _) = stopped_after(pendulum(), 0);
    let none = study.allocation(&at_least(3.99), &choices());
    assert_eq!(none.unwrap_err(), Error::Stopped);
}
