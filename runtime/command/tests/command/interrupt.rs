//! Ctrl-C in the middle: what is done is kept.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::program::{answer, command, folder, pendulum, run};

/// Waits until a program has its own handler of SIGINT: before that the signal would just end it.
fn listens(child: &Child) {
    for _ in 0..600 {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
        let caught = u64::from_str_radix(caught.unwrap().trim(), 16).unwrap();
        // Signal 2 is bit 1.
        if caught & 2 != 0 {
            return;
        }
        sleep(Duration::from_millis(50));
    }
    panic!("no handler after half a minute");
}

fn interrupt(child: &Child) {
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
}

/// More samples than any machine takes in the time of a test.
fn endless(more: &[&str]) -> Child {
    let samples = ["--samples", "2000000000", "--threads", "1"];
    let mut command = command(&pendulum("sample", &[&samples[..], more].concat()));
    command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

#[test]
fn samples_that_are_done_are_kept() {
    let folder = folder("interrupted");
    let path = folder.join("part.json");
    let name = path.display().to_string();
    let child = endless(&["--partial", "-o", &name]);
    listens(&child);
    sleep(Duration::from_millis(500));
    interrupt(&child);
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{err}");
    // The first signal may have come before there was anything to keep.
    if err.starts_with("stopped: nothing was written") {
        assert!(!path.exists());
        return;
    }
    assert!(
        err.starts_with("stopped: after ") && err.contains("of 2000000000 samples"),
        "{err}"
    );
    let merged = run(&["merge", &name]);
    assert_eq!(merged.code, 1);
    assert!(merged.err.contains("samples are missing"), "{}", merged.err);
    assert_eq!(
        answer(&["merge", "--partial", &name]),
        fs::read_to_string(&path).unwrap()
    );
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

#[test]
fn an_answer_says_that_it_is_not_complete() {
    let child = endless(&[]);
    listens(&child);
    sleep(Duration::from_millis(1500));
    interrupt(&child);
    let output = child.wait_with_output().unwrap();
    let (out, err) = (
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    );
    assert_eq!(output.status.code(), Some(130), "{err}");
    assert!(err.starts_with("stopped: "), "{err}");
    if !err.starts_with("stopped: nothing was written") {
        assert!(
            out.contains("Not complete: 2000000000 samples were asked for"),
            "{out}"
        );
    }
}

/// What cannot be kept half done leaves what was there.
#[test]
fn other_work_ends_at_once() {
    let path = folder("ended").join("diagram.csv");
    fs::write(&path, "old").unwrap();
    let name = path.display().to_string();
    let sweep = [
        "--sweep",
        "speed=0..6000rpm",
        "--points",
        "5000000",
        "--csv",
        "-o",
        &name,
    ];
    let mut command = command(&[&["campbell", "jeffcott_rotor.mechanism"], &sweep[..]].concat());
    let child = command.stderr(Stdio::piped()).spawn().unwrap();
    listens(&child);
    sleep(Duration::from_millis(300));
    interrupt(&child);
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        (output.status.code(), err.as_str()),
        (Some(130), "stopped: nothing was written\n")
    );
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
}

/// No bar where nobody looks at it.
#[test]
fn progress_is_for_terminals() {
    let run = run(&pendulum("sample", &["--samples", "500"]));
    assert_eq!((run.code, run.err.as_str()), (0, ""));
}
