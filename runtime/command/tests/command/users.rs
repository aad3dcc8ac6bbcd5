//! What users stumbled over, each with what they expected: units, widths, modes and limits of the trade.

use std::path::{Path, PathBuf};

use crate::program::{Run, command_in, folder};

fn inputs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/users")
}

/// Runs in the folder of the users' files, on a page of so many characters.
fn run(columns: usize, arguments: &[&str]) -> Run {
    let output = command_in(&inputs(), arguments).env("COLUMNS", columns.to_string()).output().unwrap();
    Run {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

fn answer(columns: usize, arguments: &[&str]) -> String {
    let Run { code, out, err } = run(columns, arguments);
    assert_eq!(code, 0, "{arguments:?}: {err}");
    out
}

/// The numbers of a line behind its first word.
fn numbers(line: &str) -> Vec<f64> {
    line.split_whitespace().skip(1).filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn texts_are_as_wide_as_the_page() {
    let questions: [&[&str]; 8] = [
        &["campbell", "two_disks.mechanism", "--sweep", "speed=0..10000rpm", "--points", "3"],
        &["tolerance", "fan.mechanism", "--set", "speed=3000rpm"],
        &["modes", "two_disks.mechanism", "--set", "speed=3000rpm"],
        &["sensitivities", "fan.mechanism", "--set", "speed=3000rpm"],
        &["response", "blower.mechanism", "--sweep", "speed=2000..6000rpm", "--peaks"],
        &["sample", "fan.mechanism", "--set", "speed=3000rpm", "--samples", "50"],
        &["sweep", "fan.mechanism", "--sweep", "speed=0..6000rpm", "--points", "3"],
        &["grade", "blower.mechanism", "--set", "speed=3000rpm", "--require", "velocity shake under u <= 4.5 mm/s rms"],
    ];
    for columns in [80, 120] {
        for arguments in questions {
            let text = answer(columns, arguments);
            let widest = text.lines().max_by_key(|line| line.chars().count()).unwrap();
            assert!(widest.chars().count() <= columns, "{columns}: {widest}");
        }
    }
    for words in [["help", ""], ["help", "response"], ["help", "campbell"], ["help", "probability"], ["help", "grade"]]
    {
        let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
        let help = answer(80, &words);
        // Forms of a requirement are kept as they are to be written.
        let prose = help.lines().filter(|line| !line.trim_start().starts_with("--require '"));
        for line in prose {
            assert!(line.chars().count() <= 80 || !line.contains(". "), "{words:?}: {line}");
        }
    }
}

#[test]
fn a_campbell_diagram_is_in_hertz_and_has_the_modes_that_matter() {
    let sweep = ["--sweep", "speed=0..10000rpm", "--points", "3"];
    let text = answer(150, &[&["campbell", "two_disks.mechanism"], &sweep[..]].concat());
    // Torsion is no critical speed, though its frequency is crossed by the first order.
    assert!(text.contains("mode   f [Hz]") && text.contains("torsional") && !text.contains("3861"), "{text}");
    let crossings = text.lines().filter(|line| line.contains("crosses 1x speed"));
    assert_eq!(crossings.count(), 4, "{text}");
    let modes: Vec<&str> = text.lines().filter(|line| line.ends_with("damped")).collect();
    assert_eq!(modes.len(), 6, "{text}");
    assert!((numbers(modes[0])[0] - 27.8968).abs() < 1e-3, "{}", modes[0]);
    let more = answer(150, &[&["campbell", "two_disks.mechanism", "--modes", "9"], &sweep[..]].concat());
    assert_eq!(more.lines().filter(|line| line.ends_with("damped")).count(), 9, "{more}");
    let chosen = answer(150, &[&["campbell", "two_disks.mechanism", "--frequency-unit", "rpm"], &sweep[..]].concat());
    let line = chosen.lines().find(|line| line.ends_with("damped")).unwrap();
    assert!((numbers(line)[0] - 60.0 * 27.8968).abs() < 0.1, "{line}");

    let sweep = ["--sweep", "speed=0..6000rpm", "--order", "1,2,4", "--points", "3"];
    let blade = answer(150, &[&["campbell", "tapered_blade.mechanism"], &sweep[..]].concat());
    assert!(!blade.contains("forward") && !blade.contains("backward"), "{blade}");
    assert!(blade.contains("f3 [Hz]") && !blade.contains("f5 [Hz]"), "{blade}");
}

#[test]
fn what_was_not_given_is_named_and_unknown_files_are_refused() {
    let unset = run(80, &["tolerance", "fan.mechanism"]);
    assert!(unset.err.contains("`speed` was not given: 0 rpm"), "{}", unset.err);
    let wrong = run(80, &["modes", "fan.mechanism", "--set", "speed=10rpm", "-o", "out.xlsx"]);
    assert!(wrong.code == 2 && wrong.err.contains(".csv"), "{}", wrong.err);
    assert!(!inputs().join("out.xlsx").exists());
}

/// The same vibration in metres, millimetres and as a grade: a limit in every form that the standards have.
#[test]
fn limits_as_the_standards_state_them() {
    let amplitude = |unit: &[&str]| {
        let arguments = [&["response", "blower.mechanism", "--set", "speed=3600rpm"], unit].concat();
        let text = answer(150, &arguments);
        let line = text.lines().find(|line| line.contains("u  ") && line.contains("shake")).unwrap().to_owned();
        *numbers(&line).get(1).unwrap()
    };
    let metres = amplitude(&[]);
    assert!((amplitude(&["--unit", "shake=um"]) - 1e6 * metres).abs() < 1e-3 * 1e6 * metres);
    // Limits that are the same: at the amplitude itself the nominal design fails in half of the cases.
    let velocity = 1e3 * metres * 120.0 * std::f64::consts::PI;
    for limit in [
        format!("vibration shake under u <= {} mm", 1e3 * metres),
        format!("vibration shake under u <= {} um p-p", 2e6 * metres),
        format!("velocity shake under u <= {velocity} mm/s"),
        format!("velocity shake under u <= {} mm/s rms", velocity / std::f64::consts::SQRT_2),
    ] {
        let arguments = ["probability", "blower.mechanism", "--set", "speed=3600rpm", "--require", &limit];
        let text = answer(150, &arguments);
        let line = text.lines().find(|line| line.contains("1: ")).unwrap();
        let chance =
            line.split_whitespace().filter_map(|word| word.parse::<f64>().ok()).find(|x| (0.3..0.7).contains(x));
        assert!(chance.is_some(), "{limit}: {text}");
    }
}

/// The greatest of several outputs is a requirement on each, with the probability that the study file allows.
#[test]
fn the_greatest_of_several_outputs_is_limited() {
    let folder = folder("greatest");
    let machine = std::fs::read_to_string(inputs().join("blower.mechanism")).unwrap();
    let study = "mechanism = \"m.mechanism\"\nrequire = [\"max(shake, lift) <= 1 mm\", \"frequency 1 >= 60 Hz\"]\nfailure = [0.5, 0.9]\n";
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let text = run_in(&folder, &machine, &["probability", "--study", "study.toml", "--set", "speed=3000rpm"]);
    for line in ["1: shake at most", "2: lift at most", "3: frequency 1 at least"] {
        assert!(text.contains(line), "{line}: {text}");
    }
    let unclear = ["probability", "m.mechanism", "--set", "speed=3000rpm", "--require", "max(shake, lift) >= 1 mm"];
    let refused = command_in(&folder, &unclear).output().unwrap();
    assert!(refused.status.code() == Some(2), "{refused:?}");
}

/// An unbalance of the grade that `grade` finds reaches the limit, and a grade of the declaration is its eccentricity.
#[test]
fn the_grade_that_is_found_reaches_the_limit() {
    let folder = folder("graded");
    let text = std::fs::read_to_string(inputs().join("blower.mechanism")).unwrap();
    let sweep = ["--sweep", "speed=2000..6000rpm"];
    let require = ["--require", "velocity shake under u <= 4.5 mm/s rms"];
    let found = run_in(&folder, &text, &[&["grade", "m.mechanism", "--json"], &sweep[..], &require].concat());
    let grade = number_after(&found, "\"grade\":");
    let graded = text.replace("eccentricity: runout", &format!("grade: {} mm/s, service: 6000 rpm", 1e3 * grade));
    let peaks = run_in(
        &folder,
        &graded,
        &[&["response", "m.mechanism", "--peaks", "--of", "shake under u as velocity", "--csv"], &sweep[..]].concat(),
    );
    let heights = column(&peaks, "height");
    let highest = heights.into_iter().fold(0.0, f64::max);
    let limit = 4.5 * std::f64::consts::SQRT_2;
    assert!((highest - limit).abs() < 1e-6 * limit, "{highest} {limit}: {peaks}");
    let graded = text.replace("eccentricity: runout", "grade: G6.3, service: 3000 rpm");
    let plain = text.replace("eccentricity: runout", "eccentricity: 6.3 mm/s / (3000 rpm)");
    let responses =
        [graded, plain].map(|text| run_in(&folder, &text, &["response", "m.mechanism", "--set", "speed=3600rpm"]));
    assert_eq!(responses[0], responses[1]);
}

/// Both disks turn, and the shaft, which bends: a grade refers to the mass of all.
#[test]
fn all_that_turns_is_weighed() {
    let limit = ["--require", "velocity y1 under imbalance1 <= 2.8 mm/s rms"];
    let found =
        answer(120, &[&["grade", "two_disks.mechanism", "--set", "speed=1000rpm", "--json"], &limit[..]].concat());
    let circle = |radius: f64| std::f64::consts::PI * radius * radius;
    let mass = 7850.0 * (circle(0.025) * 1.2 + 2.0 * circle(0.14) * 0.06);
    let weighed = number_after(&found, "\"mass\":");
    assert!((weighed - mass).abs() < 1e-12 * mass, "{weighed} {mass}: {found}");
    // 150 g*mm on each disk.
    assert!((number_after(&found, "\"unbalance\":") - 300e-6).abs() < 1e-15, "{found}");
}

/// Of a disk on equal springs the greatest amplitude is the eccentricity over `2 z sqrt(1 - z^2)`, `z` the damping ratio.
#[test]
fn a_grade_is_that_of_the_resonance() {
    let (mass, stiffness, damping) = (12.0_f64, 1.9e6, 310.0);
    let limit = "vibration shake under u <= 100 um";
    let arguments = ["grade", "blower.mechanism", "--sweep", "speed=2000..6000rpm", "--require", limit, "--json"];
    let found = answer(120, &arguments);
    let z = damping / (2.0 * (stiffness * mass).sqrt());
    let service = 6000.0 * std::f64::consts::PI / 30.0;
    let expected = 100e-6 * 2.0 * z * (1.0 - z * z).sqrt() * service;
    let grade = number_after(&found, "\"grade\":");
    assert!((grade / expected - 1.0).abs() < 1e-9, "{grade} {expected}: {found}");
    // At r = w / w0 with r^2 = 1 / (1 - 2 z^2).
    let speed = (stiffness / mass / (1.0 - 2.0 * z * z)).sqrt() * 30.0 / std::f64::consts::PI;
    assert!(found.contains(&format!("{speed:.2} rpm")), "{found}");
}

/// A grade is no answer where the rotor is unstable or none is fine enough, and says where the amplitude is greatest.
#[test]
fn a_grade_that_cannot_be_met_is_a_no() {
    let grade = |text: &str, sweep: &str, limit: &str| {
        let folder = folder("no grade");
        std::fs::write(folder.join("m.mechanism"), text).unwrap();
        let output = command_in(&folder, &["grade", "m.mechanism", "--sweep", sweep, "--require", limit]);
        let output = { output }.env("COLUMNS", "200").output().unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    let machine = |name: &str| std::fs::read_to_string(inputs().join(name)).unwrap();
    let blower = machine("blower.mechanism");
    let (code, text) = grade(&blower, "speed=2000..6000rpm", "vibration shake under u <= 100 um");
    assert!(code == Some(0) && text.contains(" rpm ") && text.contains(" meets the limit of shake"), "{text}");
    let (code, text) = grade(&blower, "speed=2000..6000rpm", "vibration shake under u <= 1 nm");
    assert!(code == Some(1) && text.contains("No standard grade meets"), "{text}");
    // The damping of a material that turns drives the rotor beyond its critical speed.
    let shaft = machine("two_disks_no_torsion.mechanism");
    let lagging = shaft.replace("torsion: 0)", "torsion: 0, lag: 20 us)");
    let (code, text) = grade(&lagging, "speed=2200..6000rpm", "vibration y1 <= 1 mm");
    assert!(code == Some(1) && text.contains("Not all of these states are stable"), "{text}");
    assert!(!text.contains("\n  G"), "{text}");
}

#[test]
fn modes_that_beams_hardly_resolve_are_not_shown() {
    for (words, ends) in
        [(["modes", "--set", "speed=3000rpm"], "oscillates"), (["tolerance", "--set", "speed=3000rpm"], "yes")]
    {
        let arguments = [&[words[0], "tapered_blade.mechanism"], &words[1..]].concat();
        let text = answer(150, &arguments);
        assert_eq!(text.lines().filter(|line| line.ends_with(ends)).count(), 5, "{text}");
        assert!(text.contains("7 modes are left out"), "{text}");
        let table = answer(150, &[&arguments[..], &["--csv"]].concat());
        assert_eq!(table.lines().count(), 13, "{table}");
    }
    let slopes = answer(150, &["sensitivities", "tapered_blade.mechanism", "--set", "speed=3000rpm"]);
    assert!(slopes.contains("f5 [Hz]") && !slopes.contains("f6 [Hz]") && !slopes.contains("omega"), "{slopes}");
}

fn run_in(folder: &Path, text: &str, arguments: &[&str]) -> String {
    std::fs::write(folder.join("m.mechanism"), text).unwrap();
    let output = command_in(folder, arguments).output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn number_after(text: &str, key: &str) -> f64 {
    let rest = text.split_once(key).unwrap_or_else(|| panic!("{key}: {text}")).1.trim_start();
    let end = rest.find(|c: char| !c.is_ascii_digit() && !"+-.eE".contains(c)).unwrap_or(rest.len());
    rest[..end].parse().unwrap()
}

/// A column of CSV by the beginning of its heading.
fn column(text: &str, name: &str) -> Vec<f64> {
    let mut lines = text.lines();
    let place = lines.next().unwrap().split(',').position(|heading| heading.starts_with(name)).unwrap();
    lines.map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
}
