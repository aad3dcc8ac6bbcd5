//! Requests that are not those of a page: each gets a refusal or is cut off, and the page is answered meanwhile.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use eigentol::Study;
use eigentol_interpreter::Interpreted;
use eigentol_live::{Server, Subject, compiled};
use serde_json::Value;

const TEXT: &str = "mechanism Bob {
    design l = 1 m +/- 1%; design m = 2 kg;
    gravity 9.81 m/s^2 along -z;
    body bar: rod(mass: m, length: l, along: -z);
    joint theta: revolute(y) from ground to bar;
}";

fn server() -> Server {
    serving(TEXT)
}

fn serving(text: &'static str) -> Server {
    let subject = Subject {
        name: "bob.mechanism".to_owned(),
        read: Box::new(|| Ok(text.to_owned())),
        compile: Box::new(compiled),
        study: Box::new(|compilation| Ok(Study::new(Interpreted::new(compilation)))),
        settings: toml::Table::new(),
    };
    Server::start(subject, 0).unwrap()
}

/// Host with port, and token.
fn parts(server: &Server) -> (String, String) {
    let address = server.address();
    let inside = address.strip_prefix("http://").unwrap().strip_suffix('/').unwrap();
    let (host, token) = inside.split_once('/').unwrap();
    (host.to_owned(), token.to_owned())
}

/// Sends bytes as they are; status and what follows the head.
fn send(host: &str, bytes: &[u8]) -> (u16, String) {
    let mut stream = TcpStream::connect(host).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    // The server may refuse before it has read all.
    let _ = stream.write_all(bytes);
    let mut all = Vec::new();
    let _ = stream.read_to_end(&mut all);
    let text = String::from_utf8_lossy(&all).into_owned();
    let status = text.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
    let body = text.split_once("\r\n\r\n").map(|(_, body)| body.to_owned()).unwrap_or_default();
    (status, body)
}

fn post(host: &str, path: &str, body: &str) -> (u16, String) {
    let length = body.len();
    send(host, format!("POST {path} HTTP/1.1\r\nHost: {host}\r\nContent-Length: {length}\r\n\r\n{body}").as_bytes())
}

/// The last line of an answer.
fn asked(host: &str, token: &str, question: &str) -> Value {
    let began = Instant::now();
    loop {
        let (status, body) = post(host, &format!("/{token}/answer"), question);
        assert_eq!(status, 200, "{body}");
        let line = body.lines().rfind(|line| line.starts_with("{\"answer\"") || line.starts_with("{\"refused\""));
        let value: Value = serde_json::from_str(line.unwrap_or_else(|| panic!("{body}"))).unwrap();
        // The declaration is read after the server has started.
        if !value["refused"].as_str().is_some_and(|text| text.contains("no machine yet")) {
            return value;
        }
        assert!(began.elapsed() < Duration::from_secs(60));
    }
}

fn frequency(host: &str, token: &str, length: &str) -> f64 {
    let question = format!("{{\"ask\":\"at_point\",\"given\":{{\"set\":{{\"l\":\"{length}\"}}}}}}");
    let answer = asked(host, token, &question);
    answer["answer"]["sections"]["slopes"]["modes"][0]["frequency"].as_f64().unwrap_or_else(|| panic!("{answer}"))
}

#[test]
fn strangers_get_nothing() {
    let server = server();
    let (host, token) = parts(&server);
    let get = |path: &str, head: &str| send(&host, format!("GET {path} HTTP/1.1\r\n{head}\r\n\r\n").as_bytes());
    let own = format!("Host: {host}");
    let page = format!("/{token}/");
    assert_eq!(get(&page, &own).0, 200);
    for (path, head, status) in [
        ("/", &*own, 404),
        (&*format!("/{}/", "0".repeat(32)), &own, 404),
        (&format!("/{token}"), &own, 404),
        (&format!("/{token}/../../../etc/passwd"), &own, 404),
        (&format!("/{token}/%2e%2e/%2e%2e/etc/passwd"), &own, 404),
        (&format!("/{token}/answer"), &own, 405),
        (&page, "Host: evil.example", 403),
        (&page, "Accept: */*", 403),
        (&page, &format!("{own}\r\nOrigin: http://evil.example"), 403),
        (&page, &format!("{own}\r\nOrigin: null"), 403),
    ] {
        let (found, body) = get(path, head);
        assert_eq!(found, status, "{path} {head}");
        assert!(!body.contains(&token) && !body.contains("design"), "{body}");
    }
    assert!(send(&host, b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03").0 != 200);
    assert!(send(&host, b"NONSENSE\r\n\r\n").0 != 200);
    let endless = format!("GET {page} HTTP/1.1\r\n{own}\r\nX: {}\r\n\r\n", "x".repeat(1 << 20));
    assert!(send(&host, endless.as_bytes()).0 != 200);
    for question in ["", "{}", "[]", "{\"ask\":\"nothing\"}", "{\"ask\":\"all\",\"given\":{\"more\":1}}", "\u{0}"] {
        assert_eq!(post(&host, &format!("/{token}/answer"), question).0, 400, "{question}");
    }
    assert_eq!(post(&host, &format!("/{token}/answer"), &"[".repeat(100_000)).0, 400);
    assert_eq!(post(&host, &format!("/{token}/answer"), &" ".repeat((1 << 20) + 1)).0, 413);
    for value in ["-1 m", "1", "1 kg", "</script>", "1e999 m", "0/0 m", ""] {
        let question = serde_json::json!({ "ask": "at_point", "given": { "set": { "l": value } } }).to_string();
        let answer = asked(&host, &token, &question);
        let shown = answer.to_string();
        assert!(!shown.contains("NaN") && !shown.contains("<script>"), "{shown}");
        let refused = answer["refused"].is_string();
        let no =
            shown.contains("no equilibrium") || shown.contains("must be positive") || shown.contains("not positive");
        assert!(refused || no, "{value}: {shown}");
    }
}

#[test]
fn slow_clients_hold_nobody_up() {
    let server = server();
    let (host, token) = parts(&server);
    let begin = |text: &str| {
        let mut stream = TcpStream::connect(&host).unwrap();
        stream.write_all(text.as_bytes()).unwrap();
        stream
    };
    let slow: Vec<TcpStream> = (0..300)
        .map(|k| match k % 3 {
            0 => begin(""),
            1 => begin(&format!("GET /{token}/ HTTP/1.1\r\nHost: ")),
            _ => begin(&format!("POST /{token}/answer HTTP/1.1\r\nHost: {host}\r\nContent-Length: 100\r\n\r\n{{")),
        })
        .collect();
    let (one, other) = (frequency(&host, &token, "1 m"), frequency(&host, &token, "4 m"));
    assert!((one / other - 2.0).abs() < 1e-9, "{one} {other}");
    // They are cut off: a read ends.
    for mut stream in slow {
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        let mut rest = Vec::new();
        let ended = stream.read_to_end(&mut rest);
        assert!(ended.is_ok() || ended.is_err_and(|error| error.kind() == std::io::ErrorKind::ConnectionReset));
    }
}

#[test]
fn pages_at_once_have_values_of_their_own() {
    let server = server();
    let (host, token) = parts(&server);
    let expected = |length: f64| frequency(&host, &token, &format!("{length} m")) * length.sqrt();
    let unit = expected(1.0);
    std::thread::scope(|scope| {
        for page in 1..=4 {
            let expected = &expected;
            scope.spawn(move || {
                for k in 0..10 {
                    let found = expected(f64::from(page) + 0.1 * f64::from(k));
                    assert!((found - unit).abs() < 1e-9 * unit, "{found} {unit}");
                }
            });
        }
    });
}

#[test]
fn files_hold_what_was_set() {
    let server = server();
    let (host, token) = parts(&server);
    let given = "\"given\":{\"set\":{\"l\":\"1.5 m\"},\"tolerance\":{\"m\":\"2% uniform\"}}";
    let file = |ask: &str| {
        let answer = asked(&host, &token, &format!("{{\"ask\":\"{ask}\",{given}}}"));
        answer["answer"]["file"]["text"].as_str().unwrap_or_else(|| panic!("{answer}")).to_owned()
    };
    let declaration = file("declaration");
    assert!(declaration.contains("design l = 1.5 m +/- 1%; design m = 2.0 kg +/- 2% uniform;"), "{declaration}");
    assert_eq!(Interpreted::from_text(&declaration).unwrap().description().design[0].nominal, 1.5);
    let study: toml::Table = file("study").parse().unwrap();
    assert_eq!(study["set"]["l"].as_str(), Some("1.5 m"));
    let report = file("report");
    assert!(report.starts_with("<!doctype html>") && report.contains("1.5"));
}

/// Shares and derivatives beside the controls are those of the library.
#[test]
fn controls_have_their_own_derivatives_and_shares() {
    let server = server();
    let (host, token) = parts(&server);
    let question = "{\"ask\":\"at_point\",\"given\":{\"tolerance\":{\"m\":\"5%\"}}}";
    let slopes = asked(&host, &token, question)["answer"]["sections"]["slopes"].clone();
    // f = sqrt(1.5 g / l) / 2 pi, whatever the mass.
    let omega = (1.5_f64 * 9.81).sqrt();
    let (by, shares) = (&slopes["by"], &slopes["shares"]);
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{slopes}"));
    let scale = number(&slopes["modes"][0]["frequency"]) / omega;
    assert!((number(&by["l"][0]) + 0.5 * scale * omega).abs() < 1e-9);
    assert!(number(&by["m"][0]).abs() < 1e-9);
    assert_eq!((number(&shares["l"][0]), number(&shares["m"][0])), (1.0, 0.0));
    assert!((number(&slopes["modes"][0]["band"]) - 0.005 * scale * omega).abs() < 1e-9);
}

/// Forced vibration is among what follows a move: at the operating point in words, along an input in figures.
#[test]
fn vibration_follows_too() {
    let text = "mechanism Shaken {
        input speed: rpm; design k = 20 kN/m +/- 5%; design c = 40 N*s/m;
        body mass: point(mass: 2 kg); joint x: prismatic(x) from ground to mass;
        force spring: spring(on: x, stiffness: k); force film: damper(on: x, damping: c);
        force u: harmonic(on: x, force: 3 N, frequency: speed);
        output shake: mm = x;
    }";
    let server = serving(text);
    let (host, token) = parts(&server);
    let part = |ask: &str, speed: &str| {
        let question = format!("{{\"ask\":\"{ask}\",\"given\":{{\"set\":{{\"speed\":\"{speed}\"}},\"points\":11}}}}");
        let answer = asked(&host, &token, &question);
        let sections =
            answer["answer"]["sections"]["sections"].as_array().unwrap_or_else(|| panic!("{answer}")).clone();
        let html = |id: &str| {
            let own = sections.iter().find(|own| own["id"] == id);
            own.map(|own| own["html"].as_str().unwrap().to_owned()).unwrap_or_default()
        };
        ["brief", "verdicts", "vibration", "along", "distributions"].map(html)
    };
    // |x| = F / |k - m w^2 + i w c|
    let amplitude = |rpm: f64| {
        let w = rpm * std::f64::consts::PI / 30.0;
        3e3 / (20e3 - 2.0 * w * w).hypot(40.0 * w)
    };
    for rpm in [600.0, 1200.0] {
        let [brief, verdicts, vibration, ..] = part("at_point", &format!("{rpm} rpm"));
        let words = brief.split("Shake under u is ").nth(1).unwrap_or_else(|| panic!("{brief}"));
        let found: f64 = words.split(' ').next().unwrap().parse().unwrap();
        assert!((found / amplitude(rpm) - 1.0).abs() < 1e-4, "{words}");
        assert!(vibration.is_empty() && verdicts.is_empty() && !brief.contains("trusted"));
        let [brief, verdicts, vibration, along, distributions] = part("along", &format!("{rpm} rpm"));
        assert!(vibration.contains("Bode plot of") && along.contains("Campbell diagram"));
        assert!(verdicts.contains("nothing contradicts the first-order sigma"), "{verdicts}");
        assert!(brief.is_empty() && distributions.is_empty());
    }
}

/// A server that is dropped has ended: its port is free.
#[test]
fn a_dropped_server_is_gone() {
    let server = server();
    let (host, _) = parts(&server);
    drop(server);
    assert!(TcpStream::connect(host).is_err());
}
