//! Runs in parts give the same bits as one run, and incompatible parts are refused.

use std::fs;

use crate::program::{answer, file, folder, pendulum, run};

const SAMPLES: [&str; 4] = ["--samples", "2000", "--seed", "7"];

fn sample(more: &[&str]) -> String {
    answer(&pendulum("sample", &[&SAMPLES[..], more].concat()))
}

/// Computes the parts of a run and returns their files.
fn parts(folder: &str, count: usize) -> Vec<String> {
    let folder = crate::program::folder(folder);
    let part = |k: usize| {
        let text = sample(&["--shard", &format!("{k}/{count}")]);
        file(&folder, &format!("{k}.json"), &text)
    };
    (1..=count).map(part).collect()
}

#[test]
fn parts_merge_to_the_same_bits_in_any_order() {
    let files = parts("merged", 3);
    let [one, two, three] = [&files[0], &files[1], &files[2]];
    for form in [&[][..], &["--json"], &["--csv"]] {
        let whole = sample(form);
        for order in [[one, two, three], [three, one, two]] {
            let order = order.map(String::as_str);
            assert_eq!(answer(&[&["merge"], &order[..], form].concat()), whole);
        }
    }
    let both = folder("merged_twice").join("both.json").display().to_string();
    answer(&["merge", "--partial", three, one, "-o", &both]);
    assert_eq!(answer(&["merge", two, &both]), sample(&[]));
}

#[test]
fn a_run_goes_on_with_what_is_done() {
    let files = parts("resumed", 2);
    assert_eq!(sample(&["--resume", &files[1]]), sample(&[]));
    let second = sample(&["--shard", "2/2", "--resume", &files[0], "--partial"]);
    let path = file(&folder("resumed_shard"), "all.json", &second);
    assert_eq!(answer(&["merge", &path]), sample(&[]));
}

#[test]
fn gaps_are_named() {
    let files = parts("gaps", 4);
    let run = run(&["merge", &files[3], &files[0]]);
    assert_eq!(run.code, 1);
    let drawn = "1000 samples, seed 7, numbers 0 to 499 and 1500 to 1999: 1000 stable";
    assert!(run.out.contains(drawn), "{}", run.out);
    assert!(run.err.contains("samples are missing: 500 to below 1500"), "{}", run.err);
}

#[track_caller]
fn refused(arguments: &[&str], parts: &[&str]) {
    let run = run(arguments);
    assert_eq!((run.code, run.out.as_str()), (3, ""), "{}", run.err);
    for part in parts {
        assert!(run.err.contains(part), "`{part}` is not in\n{}", run.err);
    }
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let files = parts("refused", 2);
    let [one, two] = [files[0].as_str(), files[1].as_str()];
    let again = format!("`{two}` cannot be merged: its samples 1000 to below 2000 are already included");
    refused(&["merge", two, one, two], &[&again]);

    let folder = folder("other_runs");
    let other = |name: &str, more: &[&str]| {
        let shard = ["--shard", "2/2"];
        file(&folder, name, &answer(&pendulum("sample", &[&shard[..], more].concat())))
    };
    let seed = other("seed", &["--samples", "2000", "--seed", "8"]);
    refused(&["merge", one, &seed], &[&seed, "another run: its seed is 8, that of the others 7"]);
    let total = other("total", &["--samples", "3000", "--seed", "7"]);
    refused(&["merge", one, &total], &[&total, "another run"]);
    let length = other("length", &[&SAMPLES[..], &["--set", "l=1.1m"]].concat());
    refused(&["merge", one, &length], &["its design variable `l` is 1.1, that of the others 1"]);
    let resumed = pendulum("sample", &[&SAMPLES[..], &["--resume", &seed]].concat());
    refused(&resumed, &["another run: its seed is 8, that of the others 7"]);
}

#[test]
fn damaged_files_are_refused() {
    let files = parts("damaged", 2);
    let whole = fs::read_to_string(&files[1]).unwrap();
    let folder = folder("damages");
    let with = |text: &str| file(&folder, "damaged.json", text);
    for end in [0, 1, 100, whole.len() / 2, whole.len() - 2] {
        refused(&["merge", &files[0], &with(&whole[..end])], &["cannot be merged: the file is cut off"]);
    }
    let newer = whole.replace("{\"format\":2,", "{\"format\":99,");
    assert_ne!(newer, whole);
    refused(&["merge", &files[0], &with(&newer)], &["version 99", "version 2 can be read"]);
    refused(&["merge", &files[0], &with("{}")], &["cannot be merged", "missing field"]);
    refused(&["merge", &files[0], &with(&sample(&["--json"]))], &["cannot be merged"]);
    refused(&["merge", "missing.json"], &["cannot read `missing.json`"]);
}

#[test]
fn shards_that_make_no_sense() {
    for shard in ["0/4", "5/4", "3", "a/b"] {
        let run = run(&pendulum("sample", &["--shard", shard]));
        assert_eq!(run.code, 2, "{}", run.err);
        assert!(run.err.contains("/64`"), "{}", run.err);
    }
}
