//! Ctrl-C or a request to terminate during a run: finished work is kept.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use eigentol_tables::csv;

use crate::program::{PENDULUM, answer, command, examples, file, folder, pendulum, run, swept};

/// Waits until a program has its own signal handlers; before that a signal would simply terminate it.
pub(crate) fn listens(child: &Child) {
    for _ in 0..600 {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
        let caught = u64::from_str_radix(caught.unwrap().trim(), 16).unwrap();
        // SIGINT is signal 2, SIGTERM 15; signal k is bit k - 1.
        if caught & (1 << 1) != 0 && caught & (1 << 14) != 0 {
            return;
        }
        sleep(Duration::from_millis(50));
    }
    panic!("no handler after half a minute");
}

/// Waits until a program has used so many seconds of the processors: it is then as far as it would be on an idle machine.
pub(crate) fn works_for(child: &Child, seconds: f64) {
    let ticks = (100.0 * seconds) as u64;
    for _ in 0..12_000 {
        let stat = fs::read_to_string(format!("/proc/{}/stat", child.id())).unwrap();
        // The name, which may have spaces, ends with a bracket; user and system time are fields 14 and 15.
        let fields: Vec<&str> = stat.rsplit_once(')').unwrap().1.split_whitespace().collect();
        let used: u64 = fields[11..13].iter().map(|field| field.parse::<u64>().unwrap()).sum();
        if used >= ticks || fields[0] == "Z" {
            return;
        }
        sleep(Duration::from_millis(10));
    }
    panic!("not {seconds} s of work in two minutes");
}

pub(crate) fn interrupt(child: &Child) {
    send("-INT", child);
}

fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(sent.unwrap().success());
}

/// More samples than any machine can finish during a test.
fn endless(more: &[&str]) -> Child {
    let samples = ["--samples", "2000000000", "--threads", "1"];
    let mut command = command(&pendulum("sample", &[&samples[..], more].concat()));
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn samples_that_are_done_are_kept() {
    kept_after("-INT");
}

/// A job that reaches its time limit is asked to terminate.
#[test]
fn samples_that_are_done_are_kept_at_a_time_limit() {
    kept_after("-TERM");
}

fn kept_after(signal: &str) {
    let folder = folder(&format!("interrupted{signal}"));
    let path = folder.join("part.json");
    let name = path.display().to_string();
    let child = endless(&["--partial", "-o", &name]);
    listens(&child);
    works_for(&child, 0.1);
    send(signal, &child);
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{err}");
    // The first signal may arrive before there is anything to keep.
    if err.starts_with("stopped: nothing was written") {
        assert!(!path.exists());
        return;
    }
    assert!(err.starts_with("stopped: after ") && err.contains("of 2000000000 samples"), "{err}");
    let merged = run(&["merge", &name]);
    assert_eq!(merged.code, 1);
    assert!(merged.err.contains("samples are missing"), "{}", merged.err);
    assert_eq!(answer(&["merge", "--partial", &name]), fs::read_to_string(&path).unwrap());
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

/// A run that outlives its terminal.
#[test]
fn nohup_goes_on() {
    let samples = ["--samples", "2000000000", "--threads", "1"];
    let run = command(&pendulum("sample", &samples));
    let mut child = Command::new("nohup")
        .arg(run.get_program())
        .args(run.get_args())
        .current_dir(examples())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    listens(&child);
    send("-HUP", &child);
    works_for(&child, 0.2);
    assert!(child.try_wait().unwrap().is_none(), "it ended");
    send("-TERM", &child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
}

#[test]
fn an_answer_says_that_it_is_not_complete() {
    let child = endless(&[]);
    listens(&child);
    works_for(&child, 0.2);
    interrupt(&child);
    let output = child.wait_with_output().unwrap();
    let (out, err) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert_eq!(output.status.code(), Some(130), "{err}");
    assert!(err.starts_with("stopped: "), "{err}");
    if !err.starts_with("stopped: nothing was written") {
        assert!(out.contains("Not complete: 2000000000 samples were asked for"), "{out}");
    }
}

/// Output that cannot be shown half finished leaves the old file in place.
#[test]
fn what_has_no_half_leaves_the_old_file() {
    let path = folder("ended").join("sensitivities.csv");
    fs::write(&path, "old").unwrap();
    let name = path.display().to_string();
    let robot = "../tests/truth/robots/Icub.mech";
    let mut command = command(&["sensitivities", robot, "-o", &name]);
    let child = command.stderr(Stdio::piped()).spawn().unwrap();
    listens(&child);
    interrupt(&child);
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), err.as_str()), (Some(130), "stopped: nothing was written\n"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
}

/// Ctrl-C after some work, or after more if nothing has begun by then: exit code 130; returns what was written and printed.
fn stopped(arguments: &[&str]) -> (String, String) {
    for seconds in [0.3, 1.0, 4.0, 16.0] {
        let mut command = command(arguments);
        let child = (command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()).unwrap();
        listens(&child);
        works_for(&child, seconds);
        interrupt(&child);
        let output = child.wait_with_output().unwrap();
        let out = String::from_utf8(output.stdout).unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(130), "{err}");
        if !err.starts_with("stopped: nothing was written") {
            return (out, err);
        }
    }
    panic!("nothing was begun in 16 s");
}

#[test]
fn a_report_says_how_far_it_came() {
    let path = folder("half a report").join("report.html");
    let name = path.display().to_string();
    let samples = ["--samples", "2000000000", "--output", &name];
    let (_, err) = stopped(&pendulum("report", &samples));
    assert!(err.starts_with("stopped: "), "{err}");
    let html = fs::read_to_string(&path).unwrap();
    assert!(html.starts_with("<!doctype html>") && html.contains("</html>"));
    assert!(html.contains("2000000000"), "what was asked for is not said");
}

#[test]
fn an_allocation_is_checked_by_the_samples_that_are_done() {
    let folder = folder("half an allocation");
    let declaration = fs::canonicalize(examples().join(PENDULUM)).unwrap();
    let study = format!(
        "mechanism = {declaration:?}\nsamples = 100000000\nset.omega = \"5 rad/s\"\nstart.theta = \"60 deg\"\n\
         tolerance.l = \"10%\"\nrequire = [\"frequency 1 >= 3.9 rad/s\"]\nfailure = 0.01\n\
         [[choose]]\ntolerance = \"l\"\nleast = \"1 mm\"\nmost = \"300 mm\"\ncost = {{ fixed = 0, factor = 1.0, power = 1 }}\n"
    );
    let study = file(&folder, "study.toml", &study);
    let (out, err) = stopped(&["allocate", "--study", &study]);
    assert!(err.starts_with("stopped: after ") && err.contains("of 100000000 samples"), "{err}");
    assert!(out.contains("Not complete: 100000000 samples were asked for"), "{out}");
}

/// The file of a chain of bars that hangs from a turning axis.
pub(crate) fn chain(folder: &Path, bars: usize) -> String {
    let mut chain = String::from(
        "pub mechanism Chain {\n input omega: rad/s;\n design l = 1 m +/- 1%;\n gravity 9.81 m/s^2 along -z;\n body b0: massless;\n\
         joint spin: revolute(z) from ground to b0, driven at omega;\n output reach = q1;\n",
    );
    for k in 1..=bars {
        let place = if k == 1 { "" } else { " at [0, 0, -l]" };
        chain += &format!(
            " body b{k}: rod(mass: 1 kg, length: l, along: -z);\n joint q{k}: revolute(y) from b{} to b{k}{place};\n",
            k - 1
        );
    }
    file(folder, &format!("chain_{bars}.mechanism"), &(chain + "}\n"))
}

/// Subcommands that are done at once, whatever they are about.
const AT_ONCE: [&str; 6] = ["merge", "new", "import", "schema", "completions", "help"];

/// Whatever it is busy with, a subcommand ends soon after it is asked to: within a second where nothing else runs.
#[test]
fn every_subcommand_ends_soon() {
    let folder = folder("all_ended");
    let (long, short) = (chain(&folder, 500), chain(&folder, 48));
    let ask = |question: &str, words: &str| -> Vec<String> {
        let words = words.split(' ').map(|word| word.replace('~', " "));
        [question.to_owned()].into_iter().chain(words).collect()
    };
    let declaration = fs::canonicalize(examples().join(PENDULUM)).unwrap();
    let study = format!(
        "mechanism = {declaration:?}\nset.omega = \"5 rad/s\"\nstart.theta = \"60 deg\"\nsamples = 2000000000\n\
         require = [\"frequency 1 >= 3.9 rad/s\"]\nfailure = 0.01\n\
         [[choose]]\ntolerance = \"l\"\nleast = \"1 mm\"\nmost = \"300 mm\"\ncost = {{ fixed = 0, factor = 1.0, power = 1 }}\n"
    );
    let study = file(&folder, "study.toml", &study);
    let report = folder.join("report.html").display().to_string();
    let rotor = file(
        &folder,
        "rotor.mechanism",
        "mechanism Rotor {
            input speed: rpm; design k = 1 MN/m +/- 1%;
            body base: massless; body seat: massless; body disk: disk(mass: 20 kg, radius: 20 cm, axis: z);
            joint side: prismatic(x) from ground to base; joint up: prismatic(y) from base to seat;
            joint spin: revolute(z) from seat to disk, driven at speed;
            force kx: spring(on: side, stiffness: k); force ky: spring(on: up, stiffness: 1.1 * k);
            force c: damper(on: side, damping: 200 N*s/m);
            unbalance u: on disk, amount: 20 g*mm;
            output shake = side; }",
    );
    let rotor_of_blades = fs::canonicalize(examples().join("bladed_rotor.mechanism")).unwrap();
    let pendulum = format!("{PENDULUM} --start theta=60deg");
    let mut all = vec![
        ask("equilibria", &format!("{short} --starts 1e9")),
        ask("tolerance", &long),
        ask("sensitivities", &long),
        ask("modes", &long),
        ask("check", &long),
        ask("expand", &long),
        ask("converge", &long),
        ask("campbell", &format!("{pendulum} --sweep omega=4..8rad/s --points 1e6 --csv")),
        ask("map", &format!("{long} --sweep omega=4..8rad/s --over l=1..9m --values 1000000")),
        ask("sweep", &format!("{pendulum} --sweep omega=4..8rad/s --points 1e6 --csv")),
        ask("mistuning", &format!("{} --set omega=600rpm --order 2 --samples 2000000000", rotor_of_blades.display())),
        ask("branches", &format!("{short} --sweep omega=0..60rad/s")),
        ask("sample", &format!("{pendulum} --samples 2000000000")),
        ask("report", &format!("{pendulum} --set omega=5rad/s --samples 2000000000 -o {report}")),
        ask("allocate", &format!("--study {study}")),
        ask("serve", &long),
        ask(
            "probability",
            &format!(
                "{pendulum} --set omega=5rad/s --tol l=one~of~[1,1.1]~m --samples 2000000000 --require frequency~1~>=~3.9~rad/s"
            ),
        ),
    ];
    let figure = format!("--figure {}", folder.join("bode.svg").display());
    for detail in ["--bands", &figure, ""] {
        let words = format!("{rotor} --sweep speed=0..6000rpm --points 1e5 {detail}");
        all.push(ask("response", words.trim()));
    }
    all.push(ask("response", &format!("{long} --sweep omega=1..6rad/s --peaks")));
    all.push(ask("grade", &format!("{long} --sweep omega=1..6rad/s --require vibration~reach~<=~1~mm")));
    let named = |name: &&str| all.iter().any(|words| words[0] == **name);
    let help = answer(&["--help"]);
    let commands = help.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let commands = commands.filter_map(|line| line.split_whitespace().next());
    for name in commands.filter(|word| word.chars().all(|c| c.is_ascii_lowercase())) {
        assert!(named(&name) || AT_ONCE.contains(&name), "{name} is not tried");
    }
    let start = |words: &Vec<String>| {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let mut command = command(&words);
        let run = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        std::thread::spawn(move || {
            listens(&run);
            works_for(&run, 0.3);
            interrupt(&run);
            let asked = Instant::now();
            let output = run.wait_with_output().unwrap();
            (output, asked.elapsed())
        })
    };
    let running: Vec<_> = all.iter().map(start).collect();
    for (words, run) in all.iter().zip(running) {
        let (output, time) = run.join().unwrap();
        let err = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(130), "{words:?}: {err}");
        println!("{time:?}: {}", words[0]);
        // All of them share the processors here.
        assert!(time < Duration::from_secs(20), "{time:?}: {words:?}");
    }
}

/// Each bar in series has a pitchfork, and each pitchfork has branches.
#[test]
fn branches_are_kept_as_far_as_they_came() {
    let folder = folder("half of the branches");
    let chain = chain(&folder, 32);
    let path = folder.join("rows.csv");
    let name = path.display().to_string();
    let arguments = ["branches", &chain, "--sweep", "omega=0..60 rad/s", "-o", &name];
    let (_, err) = stopped(&arguments);
    let points = err.strip_prefix("stopped: after ").and_then(|x| x.strip_suffix(" points\n"));
    let points: usize = points.unwrap_or_else(|| panic!("{err}")).parse().unwrap();
    let table = csv::read("branches", fs::File::open(path).unwrap()).unwrap();
    assert!(points > 0 && table.rows() == points, "{points} {}", table.rows());
}

/// A command's output on a terminal, which the program `script` emulates.
#[cfg(target_os = "linux")]
fn on_a_terminal(arguments: &[&str]) -> Option<String> {
    let own = env!("CARGO_BIN_EXE_eigentol");
    let words = [own].into_iter().chain(arguments.iter().copied());
    let quoted: Vec<String> = words.map(|word| format!("'{word}'")).collect();
    let mut terminal = Command::new("script");
    terminal
        .args(["-qec", &quoted.join(" "), "/dev/null"])
        .current_dir(examples())
        .env("TERM", "xterm")
        .stdin(Stdio::null());
    let output = terminal.output().ok()?;
    assert!(output.status.success(), "{arguments:?}");
    Some(String::from_utf8(output.stdout).unwrap())
}

#[cfg(target_os = "linux")]
#[test]
fn long_work_shows_how_far_it_is() {
    let path = folder("watched").join("out.csv");
    let file = path.display().to_string();
    let speeds = ["--sweep", "omega=4..8 rad/s", "-o", &file];
    let rows = [&speeds[..], &["--points", "20000"]].concat();
    for (arguments, what) in [
        (pendulum("sample", &["--samples", "20000", "-o", &file]), "samples"),
        (pendulum("equilibria", &["-o", &file]), "starts"),
        (swept("campbell", &rows), "values"),
        (swept("sweep", &rows), "values"),
        (swept("branches", &speeds), "points of branches"),
        (pendulum("report", &["--samples", "20000", "-o", &file]), "samples, values"),
        (pendulum("tolerance", &["--result", "summary", "-o", &file]), "samples"),
    ] {
        match on_a_terminal(&arguments) {
            Some(shown) => assert!(shown.contains(what), "{arguments:?}: {shown}"),
            None => println!("skipped: there is no program `script` to play a terminal"),
        }
    }
}

/// No progress bar when the output is not a terminal.
#[test]
fn progress_is_for_terminals() {
    let run = run(&pendulum("sample", &["--samples", "500"]));
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    let diagram = ["campbell", "jeffcott_rotor.mechanism", "--sweep", "speed=0..6000rpm"];
    assert_eq!(crate::program::run(&diagram).err, "");
}
