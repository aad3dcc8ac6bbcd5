//! The answers of each subcommand.

use crate::interrupt::chain;
use crate::program::{PENDULUM, answer, file, folder, pendulum, run, run_with_input};

#[test]
fn check_says_what_is_declared() {
    assert_eq!(
        answer(&["check", PENDULUM, "whipple_bicycle.mechanism"]),
        "rotating_pendulum.mechanism: mechanism `RotatingPendulum`, 1 coordinate, 1 input, 2 design variables, 1 output\n\
         whipple_bicycle.mechanism: mechanism `WhippleBicycle`, 8 coordinates, 1 input, 26 design variables, 2 outputs\n"
    );
}

#[test]
fn a_declaration_may_come_from_standard_input() {
    let text = "mechanism A { body bar: rod(mass: 1 kg, length: 1 m, along: -z);
        gravity 9.81 m/s^2 along -z; joint t: revolute(y) from ground to bar; }";
    let run = run_with_input(&["check", "-"], text);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.out.starts_with("standard input: mechanism `A`, 1 coordinate"));
}

#[test]
fn modes() {
    let text = answer(&pendulum("modes", &[]));
    // sqrt(25 - (14.715 / 5)^2)
    assert!(text.contains("4.04212") && text.contains("equilibrium, stable"), "{text}");
}

/// Both signs of the angle are equilibria: the start value selects one.
#[test]
fn a_start_value_chooses_the_equilibrium() {
    let angle = |start: &str| {
        let start = format!("theta={start}");
        let point = ["modes", PENDULUM, "--set", "omega=5rad/s", "--start", &start];
        answer(&point).contains("theta [rad]  -0.941470")
    };
    assert!(angle("-1rad") && angle("-pi / 3") && angle("-60 deg") && !angle("1 rad"));
}

#[test]
fn an_unstable_answer_is_no() {
    let file = file(
        &folder("unstable"),
        "upside_down.mechanism",
        "mechanism UpsideDown { design m = 1 kg; gravity 9.81 m/s^2 along -z;
         body bar: rod(mass: m, length: 1 m, along: z); input push: N;
         joint t: prismatic(x) from ground to bar;
         force tip: spring(on: t, stiffness: -100 N/m); }",
    );
    let run = run(&["modes", &file, "--set", "push=0"]);
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
}

const CANTILEVER: &str = "mechanism Cantilever { input push: N;
    body arm: beam(length: 1 m, along: x, up: z, bending_y: 5, stiffness_y: 10 N*m^2, mass_per_length: 1 kg/m);
    joint clamp: fixed from ground to arm;
    body weight: point(mass: 0.1 kg);
    joint end: fixed from arm at tip to weight;
    point there: weight at [0, 0, 0];
    force down: load(at: there, force: [0, 0, -push]);
    output height = position(there).z; }";

#[test]
fn beams_with_more_coordinates() {
    let file = file(&folder("converge"), "cantilever.mechanism", CANTILEVER);
    let text = answer(&["converge", &file, "--set", "push=2N"]);
    for part in [
        "Cantilever at push = 2 N: changes with more coordinates of each component of a beam",
        "frequency 5 [rad/s]",
        "height [m]",
        "Modes 1 and 2 change by less than 1e-",
        "`height` changes by less than 1e-",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let rows = answer(&["converge", &file, "--set", "push=2N", "--modes", "2", "--csv"]);
    let heads = "answer,unit,as declared,change with 1 more,change with 2 more,push [N]";
    assert_eq!((rows.lines().next(), rows.lines().count()), (Some(heads), 4));
}

#[test]
fn more_modes_than_beams_have_coordinates_for_are_noted() {
    let file = file(&folder("noted"), "cantilever.mechanism", CANTILEVER);
    let found = run(&["modes", &file, "--set", "push=2N"]);
    assert_eq!(found.code, 0, "{}", found.err);
    assert!(found.err.starts_with("note: ") && found.err.contains("enough for 2 modes"), "{}", found.err);
}

/// A column with two coordinates: its buckling load is 2.4859 `E I / l^2`, and `pi^2 / 4` with more.
#[test]
fn loads_along_an_input_are_compared_and_noted() {
    let text = "mechanism Column { input push: N;
        body column: beam(length: 1 m, along: z, up: x, bending_y: 2, stiffness_y: 1 N*m^2, mass_per_length: 1 kg/m);
        joint clamp: fixed from ground to column;
        point end: column at tip;
        force down: load(at: end, force: [0, 0, -push]); }";
    let file = file(&folder("buckling"), "column.mechanism", text);
    let sweep = ["--sweep", "push=0..4N"];
    let found = answer(&[["converge", &file].as_slice(), &sweep].concat());
    assert!(found.contains("critical push [N]"), "{found}");
    assert!(found.contains("`critical push` changes by 0.746 %"), "{found}");
    for command in ["campbell", "sweep"] {
        let noted = run(&[[command, &file].as_slice(), &sweep, &["--points", "3"]].concat());
        assert!(noted.err.contains("enough for 0 modes"), "{}", noted.err);
    }
    let refined = text.replace("bending_y: 2", "bending_y: 8");
    let file = crate::program::file(&folder("buckling"), "refined.mechanism", &refined);
    let table = ["--result", "campbell", "--table", "critical states", "--csv"];
    let noted = run(&[["campbell", &file].as_slice(), &sweep, &table].concat());
    let load = std::f64::consts::PI.powi(2) / 4.0;
    let row = noted.out.lines().nth(1).expect("a load");
    let found: f64 = row.split(',').next().expect("a number").parse().expect("a number");
    assert!((found / load - 1.0).abs() < 1e-6, "{row}");
}

#[test]
fn a_mechanism_without_beams_has_no_coordinates_to_add() {
    let found = run(&pendulum("converge", &[]));
    assert_eq!((found.code, &*found.out), (2, ""));
    assert!(found.err.contains("`RotatingPendulum` has no beam"), "{}", found.err);
}

#[test]
fn sensitivities_of_equilibrium_modes_and_outputs() {
    let text = answer(&pendulum("sensitivities", &[]));
    for part in ["shift of the equilibrium", "sensitivities of the frequencies", "outputs"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn tolerances_are_given_as_declarations_give_them() {
    let sigma = |tolerance: &str| {
        let text = answer(&pendulum("tolerance", &["--tol", tolerance, "--csv"]));
        let mut lines = text.lines();
        let place = lines.next().unwrap().split(',').position(|name| name == "sigma of frequency [rad/s]");
        let cell = lines.next().unwrap().split(',').nth(place.unwrap()).unwrap();
        cell.parse::<f64>().unwrap()
    };
    let of_declaration = sigma("l=3%");
    assert!((sigma("l=30mm") / of_declaration - 1.0).abs() < 1e-12);
    assert!((sigma("l=+/- 1.5%") / of_declaration - 0.5).abs() < 1e-12);
    assert!((sigma("l=3% uniform") / of_declaration - 3.0_f64.sqrt()).abs() < 1e-12);
    // Two values, each three of the declared standard deviations away.
    assert!((sigma("l=one of [0.97, 1.03] m") / of_declaration - 3.0).abs() < 1e-12);
    let weighted = sigma("l=one of [970, 1000, 1030] mm weighted [1, 2, 1]");
    assert!((weighted / of_declaration - 4.5_f64.sqrt()).abs() < 1e-12);
    assert!(sigma("omega=one of [4.9, 5.1] rad/s") > of_declaration);
    let wandering = sigma("omega=1%");
    assert!(wandering > of_declaration);
}

/// A mass of 1 kg on a spring of `100 +12 -3 N/m`: the middle of the limits, 104.5 N/m, is the mean, and
/// `d omega / dk = 1 / (2 omega)`.
#[test]
fn unequal_limits_move_means_away_from_nominal_values() {
    let text = "mechanism Block { design k = 100 N/m +12 -3 N/m; body block: point(mass: 1 kg);
        joint x: prismatic(x) from ground to block; force s: spring(on: x, stiffness: k); output stiff = k; }";
    let path = file(&folder("unequal"), "block.mechanism", text);
    let said = answer(&["tolerance", &path]);
    for part in
        ["Mode 1: the mean frequency is 10.2250 rad/s, 1.80 sigma above the nominal one", "stiff [N/m]  104.500  2.500"]
    {
        assert!(said.contains(part), "{said}");
    }
    let first = ["tolerance", &path, "--result", "first-order tolerances"];
    assert!(answer(&first).contains("\n  1          10.2250         0.1250"));
    let outputs = ["tolerance", &path, "--csv", "--result", "output tolerances"];
    assert!(answer(&outputs).contains("stiff,N/m,104.5,"));
    let report = answer(&["report", &path, "--samples", "100"]);
    assert!(report.contains("\u{b1} 0.375 about a mean of 10.225"));
}

/// A fan that runs up to its speed, and a slide that is pushed away: neither vibrates.
#[test]
fn what_does_not_oscillate_is_neither_sampled_nor_said_to_vibrate() {
    let folder = folder("still");
    let fan = "mechanism Fan { design drive = 20 N*m +/- 5%; design air = 0.002 N*m*s^2 +/- 10%;
        body wheel: disk(mass: 5 kg, radius: 0.2 m, axis: z); joint x: revolute(z) from ground to wheel, coasting;
        force moment: generalized(on: x, value: drive - 0.05 N*m*s * rate(x) - air * rate(x)^2); }";
    let slide = "mechanism Slide { design push = 10 N/m +/- 5%; body block: point(mass: 1 kg);
        joint x: prismatic(x) from ground to block; force away: generalized(on: x, value: push * x);
        force rub: damper(on: x, damping: 1 N*s/m); }";
    for (name, text, code) in [("fan", fan, 0), ("slide", slide, 1)] {
        let path = file(&folder, &format!("{name}.mechanism"), text);
        let run = run(&["tolerance", &path]);
        assert_eq!(run.code, code, "{}", run.err);
        assert!(run.out.contains("no oscillation"), "{}", run.out);
        for word in ["use Monte Carlo", "the vibration"] {
            assert!(!run.out.contains(word), "{word}: {}", run.out);
        }
    }
}

#[test]
fn counts_may_have_a_power_of_ten() {
    let samples = |count: &str| answer(&pendulum("sample", &["--samples", count]));
    assert_eq!(samples("1e2"), samples("100"));
}

#[test]
fn campbell() {
    let sweep = ["--sweep", "speed=0..6000rpm", "--points", "5", "--order", "1"];
    let text = answer(&[&["campbell", "jeffcott_rotor.mechanism"], &sweep[..]].concat());
    for part in ["  4500  ", "frequency 1 crosses 1x speed", "onset of flutter"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let weave = ["whipple_bicycle.mechanism", "--sweep", "v=2..8m/s"];
    let text = answer(&[&["campbell"], &weave[..]].concat());
    for part in ["end of flutter of mode 3 (mixed forward)", "mixed forward, then mixed backward  flutter, then damped"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// Straight ahead the bicycle's coordinates are zero to within 1e-186: such noise must not be printed.
#[test]
fn branches_of_a_bicycle_are_free_of_noise() {
    let sweep = ["--sweep", "v=4..8m/s"];
    let text = answer(&[&["branches", "whipple_bicycle.mechanism"], &sweep[..]].concat());
    assert!(text.contains("subcritical pitchfork"), "{text}");
    let noise = |word: &str| word.split_once("e-").is_some_and(|(_, power)| power.len() > 1);
    assert!(!text.split_whitespace().any(noise), "{text}");
    assert!(text.lines().all(|line| line.len() <= 150), "{text}");
}

#[test]
fn branches() {
    let text = answer(&["branches", PENDULUM, "--sweep", "omega=0..8 rad/s"]);
    assert!(text.contains("supercritical pitchfork        3.83601"), "{text}");
}

#[test]
fn samples_are_a_function_of_seed_and_stream() {
    let sample = |more: &[&str]| answer(&pendulum("sample", &[&["--samples", "200"], more].concat()));
    let first = sample(&["--seed", "7"]);
    assert!(first.contains("200 samples, seed 7: 200 stable"), "{first}");
    assert_eq!(first, sample(&["--seed", "7", "--threads", "1"]));
    // Also outside the line that names them.
    let numbers = |text: &str| text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
    assert!(!numbers(&first).is_empty());
    assert_ne!(numbers(&first), numbers(&sample(&["--seed", "8"])));
    let stream = sample(&["--seed", "7", "--stream", "1"]);
    assert!(stream.contains("200 samples, seed 7, stream 1: 200 stable"), "{stream}");
    assert_ne!(numbers(&first), numbers(&stream));
}

const STUDY: &str = "
mechanism = \"pendulum.mechanism\"
seed = 7
samples = 2000
require = [\"frequency 1 >= 4 rad/s\"]
failure = 0.001

[set]
omega = \"5 rad/s\"

[start]
theta = \"60 deg\"

[[choose]]
tolerance = \"l\"
least = \"1 mm\"
most = \"300 mm\"
cost = { factor = 1.0 }
";

/// A study file in a folder of its own.
fn study(name: &str) -> (String, String) {
    let folder = folder(name);
    let declaration = std::fs::read_to_string(crate::program::examples().join(PENDULUM)).unwrap();
    file(&folder, "pendulum.mechanism", &declaration);
    (file(&folder, "study.toml", STUDY), folder.display().to_string())
}

#[test]
fn a_study_file_says_what_is_asked_again() {
    let (study, _) = study("asked_again");
    assert_eq!(answer(&["modes", "--study", &study]), answer(&pendulum("modes", &[])));
    let faster = ["modes", "--study", &study, "--set", "omega=6rad/s"];
    let direct = ["modes", PENDULUM, "--set", "omega=6rad/s", "--start", "theta=60deg"];
    assert_eq!(answer(&faster), answer(&direct));
    let direct = ["--samples", "2000", "--seed", "7"];
    assert_eq!(answer(&["sample", "--study", &study]), answer(&pendulum("sample", &direct)));
}

/// Bars whose lengths are equal in every sample are equivalent to a double pendulum with one length.
#[test]
fn correlations_of_a_study_file() {
    let folder = folder("correlated");
    let declaration = crate::program::examples().join("independent_bars.mechanism");
    let study = format!(
        "mechanism = {:?}\nset = {{ omega = \"5 rad/s\" }}\nstart = {{ theta1 = \"60 deg\" }}\n\
         tolerance = {{ m1 = \"0%\", m2 = \"0%\" }}\ncorrelation = [[\"l1\", \"l2\", 1.0]]\n",
        declaration.display().to_string()
    );
    let study = file(&folder, "study.toml", &study);
    let spreads = |question: &[&str]| -> Vec<f64> {
        let csv = ["--csv"];
        let text = answer(&[&["tolerance"], question, &csv].concat());
        let mut lines = text.lines().map(|line| line.split(','));
        let mut heading = lines.next().unwrap();
        let place = heading.position(|name| name == "sigma of frequency [rad/s]").unwrap();
        lines.map(|mut line| line.nth(place).unwrap().parse().unwrap()).collect()
    };
    let one_length = ["rotating_double_pendulum.mechanism", "--set", "omega=5rad/s", "--start", "theta1=60deg"];
    let (propagations, expected) = (spreads(&["--study", &study]), spreads(&one_length));
    assert_eq!(expected.len(), 2);
    for (found, expected) in propagations.iter().zip(&expected) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
    let apart = std::fs::read_to_string(&study).unwrap().replace("1.0]]", "0.0]]");
    let apart = spreads(&["--study", &file(&folder, "apart.toml", &apart)]);
    assert!(apart[0] < expected[0]);
}

#[test]
fn samples_can_be_kept() {
    let keep = ["--samples", "20", "--keep", "--csv", "--table", "samples"];
    let text = answer(&pendulum("sample", &keep));
    assert!(text.starts_with("sample,outcome,"), "{text}");
    assert_eq!(text.lines().count(), 21);
}

/// The frequency depends only on the length, and nearly linearly. The cheapest half-width is the widest that keeps the
/// frequency above the limit with probability 0.999, so that the limit is 3.09 sigmas from the mean.
#[test]
fn allocation_finds_the_widest_tolerance() {
    let (study, _) = study("allocated");
    let text = answer(&["allocate", "--study", &study, "--csv"]);
    let mut lines = text.lines();
    let heading = lines.next().unwrap().to_owned();
    let place = heading.split(',').position(|name| name.starts_with("half-width")).unwrap();
    let row = lines.find(|line| line.starts_with("l,")).unwrap();
    let value: f64 = row.split(',').nth(place).unwrap().parse().unwrap();
    // omega^2 = 25 - (14.715 / (5 l))^2 = 16 at l = 0.981.
    let expected = 3.0 * (1.0 - 0.981) / 3.090_232_306_167_813;
    assert!((value / expected - 1.0).abs() < 1e-6, "{value} {expected}");
}

/// `u_c = (1.5 g / l)^(1/2)`, and the frequency is `0.8 u` at `u = (1.5 g / (0.6 l))^(1/2)`: both decrease with the
/// length, so that the widest half-width is again the one with the limit 3.09 sigmas away.
#[test]
fn allocation_for_values_of_an_input() {
    let folder = folder("events");
    for (require, limit, factor) in [
        ("critical omega=0..8rad/s >= 3.8 rad/s", 3.8_f64, 1.0),
        ("resonance 1 omega=4..8rad/s order 0.8 >= 4.9 rad/s", 4.9, 0.6),
    ] {
        let text = format!(
            "mechanism = \"{}\"\nrequire = [{require:?}]\nfailure = 0.001\n[set]\nomega = \"5 rad/s\"\n[start]\ntheta = \"60 deg\"\n\
             [[choose]]\ntolerance = \"l\"\nleast = \"0.1 mm\"\nmost = \"300 mm\"\ncost = {{ factor = 1.0 }}\n",
            crate::program::examples().join(PENDULUM).display(),
        );
        let study = file(&folder, "event.toml", &text);
        let text = answer(&["allocate", "--study", &study, "--samples", "300", "--csv"]);
        let heading = text.lines().next().unwrap();
        let place = heading.split(',').position(|name| name.starts_with("half-width"));
        let row = text.lines().find(|line| line.starts_with("l,")).unwrap();
        let value: f64 = row.split(',').nth(place.unwrap()).unwrap().parse().unwrap();
        let longest = 1.5 * 9.81 / (factor * limit * limit);
        let expected = 3.0 * (longest - 1.0) / 3.090_232_306_167_813;
        assert!((value / expected - 1.0).abs() < 1e-6, "{value} {expected}");
    }
}

#[test]
fn expansions_at_every_stage() {
    for (stage, part) in [
        ("flat", "mechanism RotatingPendulum"),
        ("mechanism", "theta"),
        ("topology", "shaft"),
        ("functions", "residual"),
        ("program", "residual"),
        ("rust", "impl ::eigentol::Mechanism for RotatingPendulum"),
        ("operations", "mode_gradient"),
    ] {
        let text = answer(&["expand", PENDULUM, "--stage", stage]);
        assert!(text.contains(part), "{stage}: {text}");
    }
    assert_eq!(answer(&["expand", PENDULUM]), answer(&["expand", PENDULUM, "--stage", "rust"]));
}

#[test]
fn completions_of_three_shells() {
    for (shell, part) in
        [("bash", "complete -F _eigentol"), ("zsh", "#compdef eigentol"), ("fish", "complete -c eigentol")]
    {
        assert!(answer(&["completions", shell]).contains(part), "{shell}");
    }
}

#[test]
fn every_subcommand_has_help_with_its_values() {
    let help = answer(&["--help"]);
    for command in [
        "check",
        "modes",
        "converge",
        "sensitivities",
        "tolerance",
        "campbell",
        "branches",
        "sample",
        "merge",
        "probability",
        "allocate",
        "expand",
        "new",
        "import",
        "completions",
    ] {
        assert!(help.contains(command), "{command}: {help}");
        assert!(answer(&[command, "--help"]).contains("Usage: eigentol"), "{command}");
    }
    assert_eq!(run(&[]).code, 2);
}

/// The same order twice is one order, and one of negative speeds is a multiple of their amount.
#[test]
fn orders_are_counted_once() {
    let along = |speeds: &str, orders: &str| {
        let sweep = ["--sweep", speeds, "--points", "3", "--order", orders];
        answer(&[&["campbell", "jeffcott_rotor.mechanism"], &sweep[..]].concat())
    };
    let forwards = "speed=2000..4000rpm";
    assert_eq!(along(forwards, "1,1,1.0"), along(forwards, "1"));
    for order in ["-1", "1", "1,-1"] {
        let backwards = along("speed=-4000..-2000rpm", order);
        let both = along("speed=-4000..4000rpm", order);
        let crossing = "frequency 1 crosses -1x speed";
        assert!(backwards.contains(crossing), "{backwards}");
        assert!(!backwards.contains("crosses 1x"), "{backwards}");
        assert!(both.contains(crossing) && both.contains("frequency 1 crosses 1x speed"), "{both}");
    }
}

#[test]
fn help_about_study_files_lists_their_keys() {
    let help = answer(&["help", "allocate"]);
    for key in ["require = [", "failure =", "[[choose]]", "cost = {"] {
        assert!(help.contains(key), "{key}");
    }
}

/// A search that ends before everything seems to be found says so, and from how many places; more can be asked for.
#[test]
fn equilibria_that_are_missing_are_announced() {
    let file = chain(&folder("many_equilibria"), 8);
    let search = |more: &[&str]| {
        let asked = ["equilibria", &file, "--set", "omega=3rad/s"];
        let found = run(&[&asked[..], more].concat()).out;
        let note = found.lines().last().unwrap_or_default();
        let starts = note.strip_prefix("  From ").and_then(|x| x.split_once(' '));
        let (starts, rest) = starts.unwrap_or_else(|| panic!("{note}"));
        assert_eq!(rest, "starts; more equilibria are to be expected from more starts.");
        starts.parse::<usize>().unwrap()
    };
    let usual = search(&[]);
    assert!(usual > 33, "{usual}");
    assert_eq!(search(&["--starts", "1000"]), usual + 1000 - 32);
    let few = run(&pendulum("equilibria", &[])).out;
    assert!(few.contains("4 equilibria") && !few.contains("starts"), "{few}");
}
