//! The page in a real headless browser. The tests print a message if there is none.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../../../report/tests/browser/chrome.rs"]
#[allow(dead_code, reason = "shared with the tests of reports")]
mod chrome;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use eigentol::{InDeclaredUnit, Study};
use eigentol_interpreter::Interpreted;
use eigentol_live::{Server, Subject, compiled, read_file};
use serde_json::{Value, json};

use crate::chrome::Chrome;

/// A page about a file of its own with this text, whose first input has this value.
struct Page {
    chrome: Chrome,
    server: Server,
    file: PathBuf,
}

fn example(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../examples/{name}.mechanism"))).unwrap()
}

fn study(text: &str, input: f64) -> Study<Interpreted> {
    let study = Study::new(Interpreted::from_text(text).unwrap());
    match study.description().inputs.first().map(|info| info.name.to_string()) {
        Some(name) => {
            let handle = study.find_input(&name).unwrap();
            study.input(handle, InDeclaredUnit(input))
        }
        None => study,
    }
}

impl Page {
    /// `None` and a message if there is no browser.
    fn open(name: &str, text: &str, input: f64) -> Option<Self> {
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.mechanism"));
        fs::write(&file, text).unwrap();
        let Some(chrome) = Chrome::start(&format!("live-{name}")) else {
            println!("skipped, the page is not seen in a browser: there is no Chromium");
            return None;
        };
        let read = file.clone();
        let subject = Subject {
            name: format!("{name}.mechanism"),
            read: Box::new(move || read_file(&read)),
            compile: Box::new(compiled),
            study: Box::new(move |compilation| {
                let study = Study::new(Interpreted::new(compilation));
                let first = study.description().inputs.first().map(|info| info.name.to_string());
                Ok(match first {
                    Some(first) => {
                        let handle = study.find_input(&first).map_err(|error| error.to_string())?;
                        study.input(handle, InDeclaredUnit(input))
                    }
                    None => study,
                })
            }),
            settings: toml::Table::new(),
        };
        let server = Server::start(subject, 0).unwrap();
        let mut page = Self { chrome, server, file };
        page.chrome.visit(&page.server.address());
        page.until("document.querySelector('#modes') !== null");
        Some(page)
    }

    fn until(&mut self, condition: &str) {
        let began = Instant::now();
        while self.chrome.evaluate(condition) != json!(true) {
            let state = "document.querySelector('header')?.textContent";
            assert!(
                began.elapsed() < Duration::from_secs(90) && self.chrome.complaints.is_empty(),
                "never: {condition}; the page says {} and {:?}",
                self.chrome.evaluate(state),
                self.chrome.complaints
            );
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// The number of answers at the operating point.
    fn answers(&mut self) -> u64 {
        self.chrome.evaluate("Number(document.documentElement.dataset.answered)").as_u64().unwrap()
    }

    /// Writes into an entry as a user would.
    fn write(&mut self, label: &str, text: &str) {
        let before = self.answers();
        self.chrome.evaluate(&format!(
            "(() => {{ const own = document.querySelector('[aria-label=\"{label}\"]'); own.value = {}; \
             own.dispatchEvent(new Event('change')); }})()",
            json!(text)
        ));
        self.until(&format!("Number(document.documentElement.dataset.answered) > {before}"));
    }

    /// The frequencies beside the controls.
    fn frequencies(&mut self) -> Vec<f64> {
        let all =
            self.chrome.evaluate("[...document.querySelectorAll('aside select option')].map((own) => own.textContent)");
        let number = |text: &Value| {
            let text = text.as_str().unwrap();
            text.split_once(": ").unwrap().1.split(' ').next().unwrap().parse().unwrap()
        };
        all.as_array().unwrap().iter().map(number).collect()
    }

    fn refusal(&mut self) -> String {
        self.chrome.text("document.querySelector('.refusal').textContent")
    }

    fn picture(&mut self, name: &str, width: u32) {
        let size = json!({ "width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": false });
        self.chrome.ask("Emulation.setDeviceMetricsOverride", size);
        std::thread::sleep(Duration::from_millis(300));
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
        fs::write(file, self.chrome.screenshot()).unwrap();
    }
}

fn close(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-5 * b.abs())
}

/// In Hz, those that oscillate.
fn hertz(study: &Study<Interpreted>) -> Vec<f64> {
    let modes = study.modes().unwrap();
    let all = modes.foremost(6).into_iter().filter_map(|mode| modes.modes[mode].frequency());
    all.map(|omega| omega / std::f64::consts::TAU).collect()
}

#[test]
fn a_move_an_edit_and_a_mistake_are_answered() {
    let text = example("jeffcott_rotor");
    let Some(mut page) = Page::open("moves", &text, 3000.0) else { return };
    assert!(close(&page.frequencies(), &hertz(&study(&text, 3000.0))));

    // A value, in another unit than the declared one.
    page.write("speed, value with unit", "25 Hz");
    assert!(close(&page.frequencies(), &hertz(&study(&text, 1500.0))));
    let slider = page.chrome.number("Number(document.querySelector('[aria-label=\"speed, slider\"]').value)");
    assert!((slider - 1500.0).abs() < 20.0, "{slider}");
    page.until(
        "document.documentElement.dataset.followed >= 1 && !document.querySelector('#along').classList.contains('old')",
    );
    assert!(page.chrome.number("document.querySelectorAll('#along figure svg').length") >= 1.0);

    // A slider.
    let before = page.answers();
    page.chrome.evaluate(
        "(() => { const own = document.querySelector('[aria-label=\"diameter, slider\"]'); own.value = 36; \
         own.dispatchEvent(new Event('input')); })()",
    );
    page.until(&format!("Number(document.documentElement.dataset.answered) > {before}"));
    let moved = study(&text, 1500.0);
    let diameter = moved.find_design("diameter").unwrap();
    let value = page.chrome.text("document.querySelector('[aria-label=\"diameter, value with unit\"]').value");
    let value: f64 = value.strip_suffix(" mm").unwrap().parse().unwrap();
    assert!((value - 36.0).abs() < 0.1);
    let moved = moved.design(diameter, 1e-3 * value);
    assert!(close(&page.frequencies(), &hertz(&moved)));
    // The derivative beside it.
    let slope = page.chrome.text(
        "[...document.querySelectorAll('.control')].find((own) => own.querySelector('.what').textContent === 'diameter').querySelector('.slope').textContent",
    );
    let slope: f64 = slope.strip_suffix(" Hz/mm").unwrap().parse().unwrap();
    let first = moved.modes().unwrap().foremost(1)[0];
    let exact = moved.sensitivities().unwrap().modes[first].frequency().unwrap().by_design[diameter.index()];
    assert!((slope - 1e-3 * exact / std::f64::consts::TAU).abs() < 1e-5 * slope.abs());

    // What cannot be read leaves the answer, and says so.
    page.write("diameter, value with unit", "36");
    assert!(page.refusal().contains("has no unit"), "{}", page.refusal());
    assert_eq!(page.chrome.evaluate("document.querySelector('#modes').classList.contains('old')"), json!(true));
    page.write("diameter, value with unit", "30 mm");
    assert_eq!(page.refusal(), "");

    // A mistake in the file keeps the last answer, marked; mended, all is new.
    fs::write(&page.file, text.replace("prismatic(x)", "prismatik(x)")).unwrap();
    page.until("!document.querySelector('.mistakes').hidden");
    assert!(page.chrome.text("document.querySelector('.mistakes').textContent").contains("prismatik"));
    assert_eq!(page.chrome.evaluate("document.querySelector('#modes').classList.contains('old')"), json!(true));
    assert!(page.chrome.text("document.querySelector('.state').textContent").contains("the last answer before them"));
    page.picture("live-mistake", 1400);
    let heavier = text.replace("radius = 250 mm", "radius = 300 mm");
    assert_ne!(heavier, text);
    fs::write(&page.file, &heavier).unwrap();
    page.until(
        "document.querySelector('.mistakes').hidden && !document.querySelector('#modes').classList.contains('old')",
    );
    assert!(close(&page.frequencies(), &hertz(&study(&heavier, 1500.0))));

    // Among many controls one is found by its name.
    page.chrome.evaluate(
        "(() => { const own = document.querySelector('[type=search]'); own.value = 'seal'; own.dispatchEvent(new Event('input')); })()",
    );
    let shown = "[...document.querySelectorAll('.control')].filter((own) => !own.hidden).map((own) => own.querySelector('.what').textContent)";
    assert_eq!(page.chrome.evaluate(shown), json!(["seal_x", "seal_y", "seal_damping"]));

    // The address holds what was set.
    page.until("location.search.includes('25+Hz')");
    let address = page.chrome.text("location.href");
    page.chrome.visit(&address);
    page.until("document.querySelector('#modes') !== null");
    assert!(close(&page.frequencies(), &hertz(&study(&heavier, 1500.0))));

    // No file at all, then a folder in its place, then half a file.
    for folder in [false, true] {
        page.until("document.querySelector('.mistakes').hidden");
        fs::remove_file(&page.file).unwrap();
        if folder {
            fs::create_dir(&page.file).unwrap();
        }
        page.until("!document.querySelector('.mistakes').hidden");
        assert_eq!(page.chrome.evaluate("document.querySelectorAll('#modes tbody tr').length > 0"), json!(true));
        let _ = fs::remove_dir(&page.file);
        fs::write(&page.file, &heavier).unwrap();
    }
    fs::write(&page.file, &heavier[..heavier.len() / 2]).unwrap();
    page.until("!document.querySelector('.mistakes').hidden");
    fs::write(&page.file, &heavier).unwrap();
    page.until(
        "document.querySelector('.mistakes').hidden && !document.querySelector('#modes').classList.contains('old')",
    );
    assert_eq!(page.chrome.complaints, Vec::<String>::new());
    let own = page.server.address();
    assert!(page.chrome.requests.iter().all(|request| request.starts_with(&own)), "{:?}", page.chrome.requests);
}

#[test]
fn long_work_shows_its_steps_and_can_be_stopped() {
    let text = example("jeffcott_rotor");
    let Some(mut page) = Page::open("long", &text, 3000.0) else { return };
    let button = |name: &str| {
        format!("[...document.querySelectorAll('.tools button')].find((own) => own.textContent === '{name}').click()")
    };
    page.write("Samples", "5000000");
    page.chrome.evaluate(&button("Take samples"));
    page.until("/^[1-9][0-9]* steps/.test(document.querySelector('.steps').textContent)");
    // What is short is answered meanwhile.
    page.write("speed, value with unit", "1500 rpm");
    assert!(close(&page.frequencies(), &hertz(&study(&text, 1500.0))));
    page.chrome.evaluate(&button("Stop"));
    page.until("document.querySelector('.steps').textContent === 'Stopped.'");
    assert_eq!(page.chrome.evaluate("document.querySelector('#distributions')"), Value::Null);

    page.write("Samples", "200");
    page.chrome.evaluate(&button("Take samples"));
    page.until("document.querySelector('#distributions') !== null && !document.querySelector('#distributions').classList.contains('old')");
    page.write("speed, value with unit", "1600 rpm");
    page.until("document.querySelector('#distributions').classList.contains('old')");
    page.picture("live-wide", 1400);
    page.picture("live-narrow", 800);
    for scheme in ["dark", "light"] {
        let media = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        page.chrome.ask("Emulation.setEmulatedMedia", media);
        page.picture(&format!("live-{scheme}"), 1400);
    }
    let wide = "document.documentElement.scrollWidth <= document.documentElement.clientWidth";
    assert_eq!(page.chrome.evaluate(wide), json!(true));
    assert_eq!(page.chrome.complaints, Vec::<String>::new());
}

/// Milliseconds from a move of a slider to its answer, at 95 %, and bytes of the page before and after all moves.
fn moves(page: &mut Page, slider: &str, count: u32) -> (f64, [f64; 2]) {
    let run = |page: &mut Page, count: u32| {
        let script = format!(
            "(async () => {{ const own = document.querySelector('[aria-label=\"{slider}, slider\"]'); const times = []; \
             const low = Number(own.min) + 0.4 * (own.max - own.min), wide = 0.2 * (own.max - own.min); \
             for (let k = 0; k < {count}; k++) {{ const before = document.documentElement.dataset.answered; \
             const began = performance.now(); own.value = low + wide * ((k * 0.618) % 1); own.dispatchEvent(new Event('input')); \
             while (document.documentElement.dataset.answered === before) await new Promise((done) => setTimeout(done, 2)); \
             times.push(performance.now() - began); }} times.sort((a, b) => a - b); return times[Math.floor(0.95 * times.length)]; }})()"
        );
        page.chrome.number(&script)
    };
    let heap = |page: &mut Page| {
        page.chrome.ask("HeapProfiler.collectGarbage", json!({}));
        page.chrome.ask("Runtime.getHeapUsage", json!({}))["usedSize"].as_f64().unwrap()
    };
    let server = "(async () => { const began = performance.now(); await (await fetch('answer', { method: 'POST', \
                  body: JSON.stringify({ ask: 'at_point', given: {} }) })).text(); return performance.now() - began; })()";
    println!("one answer alone: {:.0} ms", page.chrome.number(server));
    run(page, 20);
    let before = heap(page);
    let slowest = run(page, count);
    (slowest, [before, heap(page)])
}

#[test]
fn a_hundred_moves_leave_nothing_behind() {
    let Some(mut page) = Page::open("hundred", &example("jeffcott_rotor"), 3000.0) else { return };
    let (slowest, [before, after]) = moves(&mut page, "diameter", 100);
    println!(
        "95 % of the moves of the rotor are answered in {slowest:.0} ms; {before:.0} bytes before, {after:.0} after"
    );
    assert!(after < before + 2e6, "{before} {after}");
}

#[test]
#[ignore = "a thousand moves"]
fn a_thousand_moves_leave_nothing_behind() {
    let Some(mut page) = Page::open("thousand", &example("jeffcott_rotor"), 3000.0) else { return };
    let (slowest, [before, after]) = moves(&mut page, "diameter", 1000);
    println!(
        "95 % of 1000 moves of the rotor are answered in {slowest:.0} ms; {before:.0} bytes before, {after:.0} after"
    );
    assert!(after < before + 2e6, "{before} {after}");
    drop(page);
    let disks =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/users/two_disks.mechanism"));
    let Some(mut page) = Page::open("disks", &disks.unwrap(), 5000.0) else { return };
    let (slowest, _) = moves(&mut page, "speed", 200);
    println!("95 % of 200 moves of the rotor with two disks are answered in {slowest:.0} ms");
    drop(page);
    let chain = "mechanism Chain {
        design l = 30 mm +/- 1%;  design m = 20 g +/- 2%;  gravity 9.81 m/s^2 along -z;
        body link[0..60]: rod(mass: m, length: l, along: -z);
        joint theta[0]: revolute(y) from ground to link[0];
        for i in 1..60 { joint theta[i]: revolute(y) from link[i - 1] to link[i] at [0, 0, -l]; }
    }";
    let Some(mut page) = Page::open("chain", chain, 0.0) else { return };
    let (slowest, _) = moves(&mut page, "l", 100);
    println!("95 % of 100 moves of a chain of 60 are answered in {slowest:.0} ms");
}
