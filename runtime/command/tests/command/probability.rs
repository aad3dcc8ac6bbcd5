//! Probabilities of failure, against the pendulum by hand: its square of the frequency is `O^2 - (1.5 g / (O l))^2`, and
//! the length has a standard deviation of 10 mm.

use crate::program::{PENDULUM, answer, examples, file, folder, pendulum, run};
use crate::strangers::normal;

const SPEED: f64 = 5.0;

/// Probability that the length is between these.
fn length_between(low: f64, high: f64) -> f64 {
    let [low, high] = [low, high].map(|l| normal(((l - 1.0) / 0.01).clamp(-12.0, 12.0)));
    high - low
}

/// The length at which the pendulum has this frequency.
fn length_at(frequency: f64) -> f64 {
    1.5 * 9.81 / (SPEED * (SPEED * SPEED - frequency * frequency).sqrt())
}

/// The cells of a line of a CSV table, of which those with commas are in quotation marks.
fn cells(line: &str) -> Vec<String> {
    let mut all = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => all.push(String::new()),
            c => all.last_mut().unwrap().push(c),
        }
    }
    all
}

/// The column of this name.
fn column(table: &str, name: &str) -> Vec<String> {
    let mut lines = table.lines().map(cells);
    let head = lines.next().unwrap();
    let place = head.iter().position(|x| x == name).unwrap();
    lines.map(|line| line[place].clone()).collect()
}

fn numbers(table: &str, name: &str) -> Vec<f64> {
    let all = column(table, name);
    all.iter().map(|text| text.parse().unwrap()).collect()
}

fn required<'a>(wanted: &'a str, more: &'a [&'a str]) -> Vec<&'a str> {
    pendulum("probability", &[&["--require", wanted], more].concat())
}

#[test]
fn requirements_in_words() {
    let longest = |angle: f64| 1.5 * 9.81 / (SPEED * SPEED * angle.cos());
    for (wanted, exact) in [
        ("frequency 1 >= 4 rad/s", length_between(0.0, length_at(4.0))),
        ("natural_frequency 1>=4rad/s", length_between(0.0, length_at(4.0))),
        ("frequency 1 <= 4.15 rad/s", length_between(length_at(4.15), 9.0)),
        ("frequency 1 outside 4.08..4.1 rad/s", length_between(length_at(4.08), length_at(4.1))),
        (
            "frequency 1 away from 0.82 omega by 0.5%",
            length_between(length_at(0.8159 * SPEED), length_at(0.8241 * SPEED)),
        ),
        ("frequency 1 within 3.95 rad/s..4.1 rad/s", 1.0 - length_between(length_at(3.95), length_at(4.1))),
        ("angle <= 55 deg", length_between(longest(55_f64.to_radians()), 9.0)),
        // (1.5 g / l)^(1/2) falls below 3.8 rad/s.
        ("critical omega=0..8rad/s >= 3.8 rad/s", length_between(1.5 * 9.81 / (3.8 * 3.8), 9.0)),
        ("stable", 0.0),
    ] {
        let table = answer(&required(wanted, &["--csv"]));
        let found = numbers(&table, "probability of failure");
        // The requirement, and any.
        assert_eq!(found.len(), 2, "{table}");
        for (found, upper) in found.iter().zip(numbers(&table, "95 % to")) {
            assert!((found - exact).abs() <= 1e-6 * exact + 1e-14, "{wanted}: {found} {exact}");
            assert!(exact <= upper * (1.0 + 1e-6) + 1e-14, "{wanted}: {upper} {exact}");
        }
    }
}

/// Beyond the critical length the pendulum hangs down; between, it has a frequency below any limit only within a thin
/// layer. A design point that takes the layer for half of the space is not believed.
#[test]
fn the_method_is_chosen() {
    let near = |speed: &str, more: &[&str]| {
        let place =
            ["probability", PENDULUM, "--set", speed, "--tol", "l=10%", "--require", "frequency 1 >= 0.1 rad/s"];
        answer(&[&place, more].concat())
    };
    let by = |table: &str| column(table, "found by")[0].clone();
    assert_eq!(by(&answer(&required("frequency 1 >= 4 rad/s", &["--csv"]))), "design point");
    assert_eq!(by(&near("omega=3.7rad/s", &["--csv"])), "lines");
    // A length of one of three kinds.
    let classes = ["--tol", "l=one of [0.9, 1.0, 1.1] m weighted [1, 2, 1]", "--csv"];
    let table = answer(&required("frequency 1 >= 4 rad/s", &classes));
    assert_eq!(by(&table), "samples");
    let [low, high] = ["95 % from", "95 % to"].map(|name| numbers(&table, name)[0]);
    assert!(low < 0.25 && 0.25 < high && high - low < 0.04, "{table}");
    let text = near("omega=3.7rad/s", &[]);
    assert!(text.contains("lines") && !text.contains("importance"), "{text}");
}

#[test]
fn every_form_and_every_result() {
    let wanted = "frequency 1 >= 4 rad/s";
    let json = answer(&required(wanted, &["--json"]));
    for part in ["\"kind\": \"probabilities of failure\"", "\"95 % from\"", "design points"] {
        assert!(json.replace("\":\"", "\": \"").contains(part), "{part}: {json}");
    }
    let table = answer(&required(wanted, &["--csv", "--result", "reliability"]));
    assert_eq!(column(&table, "verified"), ["true"]);
    let text = answer(&required(wanted, &[]));
    assert!(text.contains("1: frequency 1 at least 4 rad/s"), "{text}");
}

/// Requirements of a study file, of which one fails more often than is allowed, until the command line asks something
/// else.
#[test]
fn a_study_file_says_how_much_is_allowed() {
    let exact = length_between(0.0, length_at(4.0));
    let study = |failure: f64| {
        let text = format!(
            "mechanism = {:?}\nrequire = [\"frequency 1 >= 4 rad/s\", \"stable\"]\nfailure = [{failure}, 1]\n[set]\n\
             omega = \"5 rad/s\"\n[start]\ntheta = \"60 deg\"\n",
            examples().join(PENDULUM).display().to_string(),
        );
        file(&folder("allowed"), "study.toml", &text)
    };
    let found = run(&["probability", "--study", &study(1.1 * exact)]);
    assert_eq!((found.code, found.err.as_str()), (0, ""));
    let few = study(0.9 * exact);
    let found = run(&["probability", "--study", &few, "--csv"]);
    assert_eq!(found.code, 1, "{}", found.err);
    assert!(found.err.contains("requirement 1 fails with a probability of"), "{}", found.err);
    let values = numbers(&found.out, "probability of failure");
    assert_eq!(values.len(), 3);
    assert!((values[0] / exact - 1.0).abs() < 1e-6 && values[1] < 1e-14);
    let other = ["--require", "frequency 1 >= 1 rad/s"];
    let found = run(&[&["probability", "--study", &few], &other[..]].concat());
    assert_eq!(found.code, 0, "{}", found.err);
}

/// The file of a declaration in a folder of its own.
fn declared(folder_name: &str, text: &str) -> String {
    file(&folder(folder_name), "declared.mechanism", text)
}

/// What is failed by some designs is met by the others: the two sum to one, whatever finds them.
#[test]
fn a_requirement_and_its_opposite_sum_to_one() {
    let small = declared(
        "small",
        "mechanism T {
            design m = 7.75 kg +/- 1.5 kg lognormal; design k = 46500 N/m +/- 7800 N/m uniform;
            design c = 17.8 N*s/m +2.1 -1.0 N*s/m truncated normal;
            body b: point(mass: m); joint q: prismatic(x) from ground to b;
            force s: spring(on: q, stiffness: k); force d: damper(on: q, damping: c); }",
    );
    let middle = declared(
        "middle",
        "mechanism T {
            design m = 3.2687 kg +/- 0.45452 kg triangular; design k = 77715.5 N/m +10067.9 -9176.8 N/m uniform;
            body b: point(mass: m); joint q: prismatic(x) from ground to b; force ks: spring(on: q, stiffness: k); }",
    );
    // The exact values are those of twenty million draws.
    for (machine, of, limit, exact) in
        [(&small, "damping_ratio 1", "0.018", 0.9959), (&middle, "frequency 1", "154 rad/s", 0.5330)]
    {
        for seed in ["0", "5"] {
            let failed = |sign: &str| {
                let require = format!("{of} {sign} {limit}");
                let table = answer(&["probability", machine, "--require", &require, "--seed", seed, "--csv"]);
                let of = |name: &str| numbers(&table, name)[0];
                (of("probability of failure"), of("95 % from"), of("95 % to"))
            };
            let (low, from, to) = failed(">=");
            let exact = if machine == &small { exact } else { 1.0 - exact };
            assert!(from - 1e-3 <= exact && exact <= to + 1e-3 && to <= 1.0, "{low} {from} {to}");
            let (high, other, end) = failed("<=");
            let error = (to - from).hypot(end - other);
            assert!((low + high - 1.0).abs() <= error, "{low} {high}");
        }
    }
}

/// The flutter of a mode that has none is not searched in thousands of designs: the one that flutters is named.
#[test]
fn the_mode_that_flutters_is_named() {
    let band = declared(
        "flutters",
        "mechanism Band {
            input p: 1; design b = 0.5 +/- 0.05; design c = 0.01 N*s/m +/- 0.002 N*s/m;
            body u: point(mass: 1 kg); body w: point(mass: 1 kg);
            joint x: prismatic(x) from ground to u; joint y: prismatic(y) from ground to w;
            force fx: generalized(on: x, value: -(8 + p) * (1 N/m) * x - b * (1 N/m) * y - c * rate(x));
            force fy: generalized(on: y, value: -(12 - p) * (1 N/m) * y + b * (1 N/m) * x - c * rate(y)); }",
    );
    let flutters = |mode: u32| {
        let require = format!("flutter {mode} p=0..4 >= 1.45");
        run(&["probability", &band, "--set", "p=1", "--require", &require])
    };
    let errors = [1, 2].map(|mode| flutters(mode).err);
    let named = errors.iter().filter(|err| err.contains("flutters from 1.50 on"));
    assert_eq!(named.count(), 1, "{errors:?}");
}

/// Outputs at a member of a family of steady motions have derivatives, with what holds the member held: the height of a
/// coin's centre is `r cos(lean)`.
#[test]
fn outputs_of_a_held_family_have_a_spread() {
    let coin = declared(
        "held_coin",
        "mechanism Coin {
            design r = 50 cm +/- 1%; gravity 9.81 m/s^2 along -z;
            body base: massless; body mast: massless; body fork: massless;
            body wheel: disk(mass: 1 kg, radius: r, axis: y);
            joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
            joint height: prismatic(z) from base to mast; joint lean: revolute(x) from mast to fork;
            joint spin: revolute(y) from fork to wheel, coasting;
            point hub: wheel; point road: ground;
            constraint contact: rolling(wheel: hub, axis: y, radius: r, on: road);
            output high = height; }",
    );
    let held = ["--guess", "height=50cm", "--hold", "lean=20deg", "--hold", "yaw=-1.2rad/s"];
    let text = answer(&[&["tolerance", &coin][..], &held].concat());
    let row = text.lines().find(|line| line.trim_start().starts_with("high ")).unwrap();
    let sigma: f64 = row.split_whitespace().nth(3).unwrap().parse().unwrap();
    let exact = 0.5 * 0.01 / 3.0 * 20_f64.to_radians().cos();
    assert!((sigma / exact - 1.0).abs() < 1e-3, "{text}");
}
