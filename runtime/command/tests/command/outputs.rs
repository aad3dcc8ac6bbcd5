//! Destinations of answers.

use std::fs::{self, OpenOptions};
use std::io::Read as _;
use std::process::Stdio;

use crate::program::{answer, command, folder, pendulum, run};

#[test]
fn a_file_holds_what_is_printed_otherwise() {
    let path = folder("file").join("modes.txt");
    let name = path.display().to_string();
    assert_eq!(answer(&pendulum("modes", &["--output", &name])), "");
    assert_eq!(fs::read_to_string(&path).unwrap(), answer(&pendulum("modes", &[])));
}

#[test]
fn csv_has_units_in_its_headings() {
    let text = answer(&pendulum("modes", &["--csv"]));
    let mut lines = text.lines();
    assert!(lines.next().unwrap().starts_with("mode,frequency [rad/s],"), "{text}");
    assert!(lines.next().unwrap().starts_with("1,4.0421"), "{text}");
    let states = answer(&pendulum("modes", &["--csv", "--result", "equilibrium"]));
    assert!(states.contains("theta"), "{states}");
}

/// If the answer fails, the old file stays and nothing is left beside it.
#[test]
fn a_failure_leaves_the_old_file() {
    let folder = folder("kept");
    let path = folder.join("modes.txt");
    fs::write(&path, "old").unwrap();
    let name = path.display().to_string();
    let wrong = run(&["modes", "rotating_pendulum.mechanism", "--set", "omega=1m", "-o", &name]);
    assert_eq!(wrong.code, 2);
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

#[test]
fn places_that_cannot_be_written() {
    let folder = folder("places");
    let missing = folder.join("missing").join("modes.txt").display().to_string();
    let itself = folder.display().to_string();
    for place in [&missing, &itself] {
        // Before any work: the declaration is not even read.
        let run = run(&["modes", "missing.mechanism", "-o", place]);
        assert_eq!(run.code, 3);
        assert!(run.err.contains(&format!("cannot write `{place}`")), "{}", run.err);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported() {
    let run = run(&pendulum("modes", &["-o", "/dev/full"]));
    assert_eq!(run.code, 3);
    assert_eq!(run.err, "error: cannot write `/dev/full`: No space left on device (os error 28)\n");
    let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = command(&pendulum("modes", &[])).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(3));
    let err = String::from_utf8(output.stderr).unwrap();
    assert!(err.contains("cannot write to standard output: No space left"), "{err}");
}

/// The reader of a pipe may stop reading.
#[test]
fn a_broken_pipe_is_no_failure() {
    for arguments in [
        pendulum("modes", &[]),
        vec!["expand", "whipple_bicycle.mechanism"],
        vec!["completions", "zsh"],
        vec!["--help"],
    ] {
        let mut child = command(&arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let status = child.wait().unwrap();
        let mut err = String::new();
        child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
        assert_eq!((status.code(), err.as_str()), (Some(0), ""), "{arguments:?}");
    }
}

/// A pipe is opened once, so that its reader gets the answer and then its end; a link is followed.
#[cfg(unix)]
#[test]
fn pipes_and_links_are_written_through() {
    let folder = folder("through");
    let expected = answer(&pendulum("modes", &[]));
    let pipe = folder.join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    let place = pipe.display().to_string();
    let reader = std::thread::spawn(move || fs::read_to_string(pipe).unwrap());
    assert_eq!(answer(&pendulum("modes", &["-o", &place])), "");
    assert_eq!(reader.join().unwrap(), expected);

    let (target, later) = (folder.join("target.txt"), folder.join("later.txt"));
    fs::write(&target, "old").unwrap();
    for (name, end) in [("link", &target), ("new_link", &later)] {
        let link = folder.join(name);
        std::os::unix::fs::symlink(end.file_name().unwrap(), &link).unwrap();
        assert_eq!(answer(&pendulum("modes", &["-o", &link.display().to_string()])), "");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(end).unwrap(), expected);
    }
}
