//! The examples as programs: options, exit codes, files, and their numbers compared with closed forms.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use eigentol::tolerance::Sampling;
use eigentol_examples::{Failure, Question, Sweep, record, summary};

#[path = "programs/jeffcott.rs"]
mod jeffcott;
#[path = "../jeffcott_rotor.rs"]
#[allow(dead_code, unreachable_pub)]
mod jeffcott_rotor;
#[path = "../rotating_double_pendulum.rs"]
#[allow(dead_code, unreachable_pub)]
mod rotating_double_pendulum;
#[path = "../rotating_pendulum.rs"]
#[allow(dead_code, unreachable_pub)]
mod rotating_pendulum;
#[path = "programs/whipple.rs"]
mod whipple;
#[path = "../whipple_bicycle.rs"]
#[allow(dead_code, unreachable_pub)]
mod whipple_bicycle;

type Run = fn(Vec<OsString>, &mut dyn Write) -> Result<(), Failure>;

const SINGLE: Run = rotating_pendulum::run;
const DOUBLE: Run = rotating_double_pendulum::run;
const ROTOR: Run = jeffcott_rotor::run;

/// The square of the critical speed of a 1 m bar: 3 g / 2.
const W: f64 = 1.5 * 9.81;

fn directory(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    path
}

/// Runs an example with `options` in a fresh directory; returns its printed output and the directory of its files.
fn run(example: Run, name: &str, options: &[&str]) -> (String, PathBuf) {
    let path = directory(name);
    let mut arguments: Vec<OsString> = vec![name.into()];
    arguments.extend(options.iter().map(OsString::from));
    arguments.extend(["--out".into(), path.clone().into()]);
    let mut printed = Vec::new();
    example(arguments, &mut printed).unwrap();
    (String::from_utf8(printed).unwrap(), path)
}

fn refused(example: Run, arguments: &[&str]) -> Failure {
    let arguments = std::iter::once("example").chain(arguments.iter().copied());
    example(arguments.map(OsString::from).collect(), &mut io::sink()).unwrap_err()
}

/// Reads a CSV file by columns; every non-empty field must be a finite number.
fn columns(path: &Path) -> BTreeMap<String, Vec<Option<f64>>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let head = reader.headers().unwrap().clone();
    let mut columns: BTreeMap<String, Vec<Option<f64>>> = BTreeMap::new();
    for record in reader.records() {
        for (name, field) in head.iter().zip(&record.unwrap()) {
            let value = (!field.is_empty()).then(|| field.parse::<f64>().unwrap());
            assert!(value.is_none_or(f64::is_finite), "{name}: {field}");
            columns.entry(name.to_owned()).or_default().push(value);
        }
    }
    columns
}

#[test]
fn every_promised_column_and_figure_is_there() {
    let cases: [(Run, &str, usize, [&str; 5]); 2] = [
        (
            SINGLE,
            "files_single",
            1,
            ["fig03", "fig04", "fig05", "fig06", "fig07"],
        ),
        (
            DOUBLE,
            "files_double",
            2,
            ["fig09", "fig10", "fig11", "fig12", "fig13"],
        ),
    ];
    for (example, name, modes, figures) in cases {
        let (_, path) = run(example, name, &["--speeds", "11", "--samples", "20"]);
        let columns = columns(&path.join("sweep.csv"));
        let mut names = vec!["omega".to_owned()];
        for mode in 1..=modes {
            names.extend([format!("theta{mode}"), format!("frequency_{mode}")]);
            for kind in ["sigma", "mean", "mc_sigma", "mc_mean", "fd_sigma"] {
                names.extend([3, 6, 12].map(|level| format!("{kind}_{mode}_{level}pct")));
            }
        }
        names.extend([3, 6, 12].map(|level| format!("mc_unstable_{level}pct")));
        for name in names {
            assert_eq!(columns[&name].len(), 11, "{name}");
            assert!(columns[&name].iter().all(Option::is_some), "{name}");
        }
        for figure in figures {
            let text = fs::read_to_string(path.join(format!("{figure}.svg"))).unwrap();
            assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"));
            assert!(!text.contains("NaN") && !text.contains("inf"), "{figure}");
        }
    }
}

#[test]
fn the_bar_follows_its_closed_form() {
    let options = ["--speeds", "21", "--samples", "400", "--seed", "5"];
    let (printed, path) = run(SINGLE, "closed_form", &options);
    let columns = columns(&path.join("sweep.csv"));
    let value = |name: &str, row: usize| columns[name][row].unwrap();
    for row in 0..21 {
        let speed = value("omega", row);
        let square = speed * speed;
        let (theta, lambda, slope) = if square < W {
            (0.0, W - square, -W)
        } else {
            let cosine = W / square;
            (cosine.acos(), square - W * cosine, 2.0 * W * cosine)
        };
        let frequency = lambda.sqrt();
        // sigma_l is a third of the tolerance.
        let sigma = 0.01 * slope.abs() / (2.0 * frequency);
        let near = |name: &str, expected: f64| {
            let error = (value(name, row) - expected).abs();
            assert!(error <= 1e-9 * expected.abs().max(1.0), "{name} at {speed}");
        };
        near("theta1", theta);
        near("frequency_1", frequency);
        near("sigma_1_3pct", sigma);
        near("sigma_1_12pct", 4.0 * sigma);
        near("mean_1_6pct", frequency);
        assert_eq!(value("mc_unstable_12pct", row), 0.0);
        if value("sigmas_to_critical_3pct", row) > 20.0 {
            let (mean, spread) = (value("mc_mean_1_3pct", row), value("mc_sigma_1_3pct", row));
            assert!((mean - frequency).abs() < 5.0 * sigma / 400f64.sqrt());
            assert!((spread / sigma - 1.0).abs() < 5.0 / 800f64.sqrt());
        }
    }
    for text in [
        "2.712471",
        "3.836014",
        "2.712",
        "3.835",
        "not to be trusted",
        "1179",
    ] {
        assert!(printed.contains(text), "{text}\n{printed}");
    }
}

#[test]
fn the_double_pendulum_prints_its_events_and_shares_sum_to_one() {
    let (printed, path) = run(DOUBLE, "shares", &["--speeds", "9", "--samples", "30"]);
    for text in ["1.895127", "2.680114", "1.895", "2.679", "1414", "by m2"] {
        assert!(printed.contains(text), "{text}\n{printed}");
    }
    let columns = columns(&path.join("independent.csv"));
    for mode in 1..=2 {
        let shares = ["l1", "l2", "m1", "m2"].map(|name| format!("share_{mode}_{name}_3pct"));
        let sums = columns["omega"].iter().enumerate().map(|(row, _)| {
            let own = shares.iter().map(|name| columns[name][row].unwrap());
            own.sum::<f64>()
        });
        assert!(sums.clone().count() == 9 && sums.clone().all(|sum| (sum - 1.0).abs() < 1e-12));
        assert!(path.join(format!("independent_{mode}.svg")).exists());
    }
}

#[test]
fn a_seed_fixes_every_digit_whatever_the_threads() {
    let csv = |name: &str, threads: &str, seed: &str| {
        let options = [
            "--speeds",
            "7",
            "--samples",
            "600",
            "--threads",
            threads,
            "--seed",
            seed,
        ];
        let (_, path) = run(DOUBLE, name, &options);
        ["sweep.csv", "independent.csv"].map(|file| fs::read_to_string(path.join(file)).unwrap())
    };
    let one = csv("threads_1", "1", "9");
    assert_eq!(one, csv("threads_3", "3", "9"));
    assert_ne!(one, csv("other_seed", "1", "10"));
}

#[test]
fn a_wrong_value_is_refused_with_exit_code_2() {
    let cases = [
        ["--speeds", "0"],
        ["--speeds", "-3"],
        ["--speeds", "many"],
        ["--speeds", "2.5"],
        ["--samples", "0"],
        ["--samples", "1"],
        ["--samples", "-1"],
        ["--samples", "99999999999999999999999"],
        ["--seed", "-1"],
        ["--seed", "x"],
        ["--threads", "-2"],
        ["--threads", "100000"],
    ];
    for [option, value] in cases {
        let failure = refused(SINGLE, &[option, value]);
        assert_eq!(failure.exit_code(), 2, "{option} {value}");
        let message = failure.to_string();
        assert!(
            message.contains(option) && message.contains(value),
            "{message}"
        );
    }
    assert_eq!(refused(DOUBLE, &["--sample", "5"]).exit_code(), 2);
    assert_eq!(refused(DOUBLE, &["extra"]).exit_code(), 2);
    assert_eq!(refused(DOUBLE, &["--out"]).exit_code(), 2);
    assert_eq!(refused(SINGLE, &["--help"]).exit_code(), 0);
}

#[test]
fn a_place_that_cannot_be_written_is_refused_before_the_work() {
    let path = directory("in_the_way");
    fs::create_dir_all(&path).unwrap();
    let file = path.join("file");
    fs::write(&file, "mine").unwrap();
    for out in [file.clone(), file.join("below")] {
        let failure = refused(SINGLE, &["--out", out.to_str().unwrap()]);
        assert_eq!(failure.exit_code(), 2);
        assert!(failure.to_string().contains("--out"), "{failure}");
    }
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    fs::create_dir(path.join("sweep.csv")).unwrap();
    assert_eq!(
        refused(SINGLE, &["--out", path.to_str().unwrap()]).exit_code(),
        2
    );
}

#[test]
fn a_reader_that_had_enough_is_no_error() {
    struct Closed;
    impl Write for Closed {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::BrokenPipe.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let path = directory("closed");
    let out = path.to_str().unwrap();
    let options = ["example", "--speeds", "3", "--samples", "2", "--out", out];
    let failure = SINGLE(options.map(OsString::from).to_vec(), &mut Closed).unwrap_err();
    assert_eq!(failure.exit_code(), 0);
    assert!(
        path.join("fig07.svg").exists(),
        "the files are written before the summary"
    );
}

#[test]
fn the_smallest_sweep_works() {
    for speeds in ["1", "2"] {
        let (_, path) = run(DOUBLE, "smallest", &["--speeds", speeds, "--samples", "2"]);
        let columns = columns(&path.join("sweep.csv"));
        assert_eq!(columns["omega"].len().to_string(), speeds);
    }
}

#[test]
fn a_speed_that_fails_is_reported_and_leaves_its_fields_empty() {
    use rotating_pendulum::RotatingPendulum;
    let question = Question {
        speed: RotatingPendulum::omega.any(),
        range: (0.0, 8.0),
        varied: vec![RotatingPendulum::l.any()],
        levels: vec![0.03],
    };
    let sampling = Sampling::default().samples(10);
    let study = eigentol::Study::new(RotatingPendulum);
    let speeds = [1.0, f64::NAN, 2.0];
    let sweep = Sweep::run(&study, &question, &speeds, Some(&sampling)).unwrap();
    let mut printed = Vec::new();
    summary::by_speed(&mut printed, &sweep).unwrap();
    summary::checks(&mut printed, &sweep).unwrap();
    let printed = String::from_utf8(printed).unwrap();
    assert!(printed.contains("1 of 3 speeds failed"), "{printed}");
    let path = directory("failing");
    fs::create_dir_all(&path).unwrap();
    record::write(&sweep, &path.join("sweep.csv")).unwrap();
    let columns = columns(&path.join("sweep.csv"));
    assert!(columns.values().all(|column| column[1].is_none()));
    assert!(
        columns
            .values()
            .all(|column| column[0].is_some() && column[2].is_some())
    );
}
