//! Parts of a run written and read again have the same bits; unreadable ones are refused with a reason.

use eigentol::propagation::Samples;
use eigentol::response::Response;
use eigentol::tolerance::PartialMonteCarlo;
use eigentol::tolerance::{Points, Sampling};
use eigentol::{MonteCarlo, Quantity};
use serde_json::{Value, json};

use super::{bar, plate};

fn text(part: &PartialMonteCarlo) -> String {
    serde_json::to_string(part).expect("numbers and lists")
}

fn read(text: &str) -> PartialMonteCarlo {
    serde_json::from_str(text).expect("what was written")
}

fn refused(text: &str) -> String {
    let found = serde_json::from_str::<PartialMonteCarlo>(text);
    found.expect_err("not a part of a run").to_string()
}

#[test]
fn parts_that_were_written_are_merged_to_the_same_bits() {
    for keep in [false, true] {
        let study = bar().keep_samples(keep);
        let parts = [900..3000, 0..300, 300..900].map(|range| {
            let part = study.samples_between(range).unwrap();
            let found = read(&text(&part));
            assert!(found == part);
            found
        });
        let [mut all, first, second] = parts;
        all.merge(second).unwrap();
        all.merge(first).unwrap();
        let whole = study.monte_carlo().unwrap();
        assert!(all.result() == whole);
        let result = serde_json::to_string(&whole).expect("numbers and lists");
        let result: MonteCarlo = serde_json::from_str(&result).expect("what was written");
        assert!(result == whole);
        assert_eq!(result.modes[0].as_ref().unwrap().quantile(0.9), whole.modes[0].as_ref().unwrap().quantile(0.9));
    }
    // A stopped run is resumed from the written file.
    let study = plate();
    let mut part = read(&text(&study.samples_between(500..777).unwrap()));
    study.resume_samples(&mut part, &study.sampling()).unwrap();
    assert!(part.result() == study.monte_carlo().unwrap());
}

#[test]
fn responses_that_were_written_are_merged_to_the_same_bits() {
    let frequency = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    let study = bar();
    for points in [Points::Random, Points::Sobol] {
        let sampling = Sampling::default().points(points).samples(1024);
        let run = |range| {
            let continuation = sampling.clone().range(range);
            let part = study.sample_responses(&[frequency], &continuation).unwrap();
            let text = serde_json::to_string(&part).expect("numbers and lists");
            let samples: Samples = serde_json::from_str(&text).expect("what was written");
            assert!(samples == part);
            let other = text.replacen("\"of_each\":", "\"of_each\":9", 1);
            assert_ne!(serde_json::from_str::<Samples>(&other).ok(), Some(part));
            samples
        };
        let mut all = run(Some(100..1024));
        assert_eq!(all.missing(), [0..100]);
        assert!(all.check_complete().is_err());
        all.merge(run(Some(0..100))).unwrap();
        assert!(all.check_complete().is_ok() && all == run(None));
    }
}

#[test]
fn another_version_of_the_format_is_refused() {
    let written = text(&bar().samples_between(0..10).unwrap());
    assert!(written.starts_with(r#"{"format":2,"#));
    // The format of any other version.
    for other in ["1", "3"] {
        let later = format!(r#"{{"format":{other},"shards":[]}}"#);
        let reason = refused(&later);
        assert!(reason.contains(&format!("version {other} of the format, and version 2")), "{reason}");
        let changed = written.replacen("\"format\":2", &format!("\"format\":{other}"), 1);
        assert!(refused(&changed).contains("one version of eigentol for all parts"));
    }
}

#[test]
fn what_was_cut_off_or_changed_is_refused() {
    let part = bar().samples_between(100..700).unwrap();
    let written = text(&part);
    for share in [0.0, 0.1, 0.5, 0.9, 0.999] {
        let cut = &written[..(share * written.len() as f64) as usize];
        assert!(refused(cut).contains("EOF"));
    }
    let whole: Value = serde_json::from_str(&written).expect("JSON");
    let changed = |path: &str, value: Value| {
        let mut changed = whole.clone();
        *changed.pointer_mut(path).unwrap_or_else(|| panic!("no {path} in {whole}")) = value;
        let reason = refused(&changed.to_string());
        assert!(!reason.is_empty());
    };
    changed("/run/of_each", 699.into());
    changed("/run/parts", json!([]));
    let part = &whole["run"]["parts"][0];
    changed("/run/parts", json!([part, part]));
    changed("/run/parts/0/outcomes/0", 599.into());
    changed("/run/parts/0/outcomes", json!([]));
    changed("/family", "General".into());
    changed("/run/inputs", json!([]));
    let kept = bar().keep_samples(true).samples_between(0..3).unwrap();
    let mut kept: Value = serde_json::from_str(&text(&kept)).expect("JSON");
    kept["kept"].as_array_mut().expect("samples").pop();
    assert!(refused(&kept.to_string()).contains("do not fit together"));
}

/// Thirty times as many samples take little more space: only more buckets are occupied.
#[test]
fn what_is_written_does_not_grow_with_the_samples() {
    let length = |samples: u64| {
        let study = bar().samples(samples as usize);
        text(&study.samples_between(0..samples).unwrap()).len()
    };
    let (few, many) = (length(1 << 12), length(1 << 17));
    assert!(many < 3 * few && many < 100_000, "{few} {many}");
}
