//! The page that `serve` serves, as a program without a browser sees it: its numbers are those of the other subcommands.

use std::fs;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::Duration;

use serde_json::Value;

use crate::interrupt::{interrupt, listens};
use crate::program::{command, examples, file, folder, run};

/// A served page.
struct Page {
    process: Child,
    host: String,
    token: String,
}

impl Page {
    fn of(arguments: &[&str]) -> Self {
        let mut process = command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        listens(&process);
        let mut line = String::new();
        BufReader::new(process.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let (_, address) = line.trim_end().rsplit_once(": ").unwrap_or_else(|| panic!("{line}"));
        let (host, token) = address.strip_prefix("http://").unwrap().split_once('/').unwrap();
        Self { host: host.to_owned(), token: token.trim_end_matches('/').to_owned(), process }
    }

    fn post(&self, path: &str, body: &str) -> String {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        let (host, token, length) = (&self.host, &self.token, body.len());
        let head = format!("POST /{token}/{path} HTTP/1.1\r\nHost: {host}\r\nContent-Length: {length}\r\n\r\n");
        stream.write_all((head + body).as_bytes()).unwrap();
        let mut all = String::new();
        stream.read_to_string(&mut all).unwrap();
        all.split_once("\r\n\r\n").unwrap().1.to_owned()
    }

    /// The news, once they are as wanted.
    fn news(&self, wanted: impl Fn(&Value) -> bool) -> Value {
        for _ in 0..400 {
            let news: Value = serde_json::from_str(&self.post("news", "{\"after\":0}")).unwrap();
            if wanted(&news) {
                return news;
            }
            sleep(Duration::from_millis(50));
        }
        panic!("there are no such news");
    }

    /// The first line of an answer that is not about steps.
    fn asked(&self, question: &str) -> Value {
        let body = self.post("answer", question);
        let last = body.lines().find(|line| line.starts_with("{\"answer\"") || line.starts_with("{\"refused\""));
        serde_json::from_str(last.unwrap_or_else(|| panic!("{body}"))).unwrap()
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        interrupt(&self.process);
        let _ = self.process.wait();
    }
}

fn frequency(answer: &Value) -> f64 {
    answer["answer"]["sections"]["slopes"]["modes"][0]["frequency"].as_f64().unwrap_or_else(|| panic!("{answer}"))
}

#[test]
fn the_page_has_the_numbers_and_messages_of_the_command() {
    let text = fs::read_to_string(examples().join("jeffcott_rotor.mechanism")).unwrap();
    let folder = folder("served");
    let path = file(&folder, "rotor.mechanism", &text);
    let study = file(&folder, "study.toml", "seed = 7\n[tolerance]\nmodulus = \"3%\"\n");
    let page = Page::of(&["serve", &path, "--study", &study, "--set", "speed=3000rpm"]);
    let read = page.news(|news| news["machine"] == 1);
    assert_eq!(read["controls"][0]["value"], 3000.0);
    assert_eq!(read["controls"][1]["tolerance"], "3%");
    let modes = |set: &[&str]| {
        let json = run(&[&["modes", &path, "--json"], set].concat());
        let json: Value = serde_json::from_str(&json.out).unwrap();
        json["tables"][0]["columns"]
            .as_array()
            .unwrap()
            .iter()
            .find(|column| column["name"] == "frequency")
            .map(|column| column["values"][0].as_f64().unwrap() / std::f64::consts::TAU)
            .unwrap()
    };
    let shown = frequency(&page.asked("{\"ask\":\"at_point\"}"));
    assert_eq!(shown, modes(&["--set", "speed=3000rpm"]));
    let moved = page.asked("{\"ask\":\"at_point\",\"given\":{\"set\":{\"speed\":\"20 Hz\",\"diameter\":\"36 mm\"}}}");
    assert_eq!(frequency(&moved), modes(&["--set", "speed=20Hz", "--set", "diameter=36mm"]));

    // What is wrong in the file is told as `check` tells it.
    let wrong = text.replace("prismatic(x)", "prismatik(x)");
    fs::write(&path, &wrong).unwrap();
    let news = page.news(|news| !news["mistakes"].is_null());
    let check = run(&["check", &path]);
    assert_eq!(news["mistakes"].as_str().unwrap().trim_end(), check.err.trim_end());
    assert_eq!(frequency(&page.asked("{\"ask\":\"at_point\"}")), shown);
    fs::write(&path, &text).unwrap();
    page.news(|news| news["machine"] == 2 && news["mistakes"].is_null());

    // A study file is that of the start with what the page sets, and does what the page does.
    let given = "{\"ask\":\"study\",\"given\":{\"set\":{\"diameter\":\"36 mm\"},\"sweep\":\"speed=0..6000 rpm\"}}";
    let written = page.asked(given)["answer"]["file"]["text"].as_str().unwrap().to_owned();
    let back = file(&folder, "page.toml", &written);
    assert!(written.contains("seed = 7") && written.contains("sweep"), "{written}");
    let again = run(&["modes", "--study", &back]);
    let direct = run(&["modes", &path, "--set", "speed=3000rpm", "--set", "diameter=36mm"]);
    assert_eq!((again.code, again.out), (0, direct.out));
}

/// A page begins at the equilibrium that is chosen.
#[test]
fn a_page_begins_at_a_numbered_equilibrium() {
    let point = ["rotating_pendulum.mechanism", "--set", "omega=5rad/s"];
    let numbers = |number: &str| {
        let page = Page::of(&[&["serve"], &point[..], &["--equilibrium", number]].concat());
        page.news(|news| news["machine"] == 1);
        page.asked("{\"ask\":\"at_point\"}")["answer"]["sections"]["sections"][0]["html"].as_str().unwrap().to_owned()
    };
    let found: Vec<String> = ["1", "2", "3"].map(numbers).into();
    let stable = found.iter().filter(|html| html.contains("The equilibrium is stable")).count();
    let unstable = found.iter().filter(|html| html.contains("unstable")).count();
    assert!(stable >= 1 && unstable >= 1, "{found:?}");
}

#[test]
fn what_cannot_be_served_is_refused_at_once() {
    let nowhere = run(&["serve", "nowhere.mechanism"]);
    assert_eq!(nowhere.code, 3);
    let input = run(&["serve", "-"]);
    assert_eq!(input.code, 2);
    let page = Page::of(&["serve", "jeffcott_rotor.mechanism"]);
    let port = page.host.rsplit_once(':').unwrap().1;
    let taken = run(&["serve", "jeffcott_rotor.mechanism", "--port", port]);
    assert_eq!(taken.code, 3);
    assert!(taken.err.contains(&format!("cannot listen on port {port}")), "{}", taken.err);
}
