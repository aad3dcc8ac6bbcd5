//! Work ends when its page leaves. Alone in its process, whose use of the processor says so.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::time::Duration;

use eigentol::Study;
use eigentol_interpreter::Interpreted;
use eigentol_live::{Server, Subject, compiled};

const TEXT: &str = "mechanism Bob {
    design l = 1 m +/- 1%;
    gravity 9.81 m/s^2 along -z;
    body bar: rod(mass: 2 kg, length: l, along: -z);
    joint theta: revolute(y) from ground to bar;
}";

#[test]
fn work_ends_when_nobody_waits() {
    let subject = Subject {
        name: "bob.mechanism".to_owned(),
        read: Box::new(|| Ok(TEXT.to_owned())),
        compile: Box::new(compiled),
        study: Box::new(|compilation| Ok(Study::new(Interpreted::new(compilation)))),
        settings: toml::Table::new(),
    };
    let server = Server::start(subject, 0).unwrap();
    let address = server.address();
    let (host, token) = address.strip_prefix("http://").unwrap().split_once('/').unwrap();
    std::thread::sleep(Duration::from_millis(500));
    let endless = "{\"ask\":\"all\",\"given\":{\"samples\":2000000000}}";
    let length = endless.len();
    let head = format!("POST /{token}answer HTTP/1.1\r\nHost: {host}\r\nContent-Length: {length}\r\n\r\n");
    let mut stream = TcpStream::connect(host).unwrap();
    stream.write_all((head + endless).as_bytes()).unwrap();
    let used = |what: &str| {
        let before = processor_seconds()?;
        std::thread::sleep(Duration::from_secs(2));
        let used = processor_seconds()? - before;
        println!("{what}: {used} s in 2 s");
        Some(used)
    };
    let mut some = [0; 256];
    assert!(stream.read(&mut some).unwrap() > 0);
    let Some(busy) = used("while a page waits") else {
        println!("skipped, nothing says what the processor does: there is no /proc");
        return;
    };
    drop(stream);
    std::thread::sleep(Duration::from_secs(1));
    let idle = used("after it has left").unwrap();
    assert!(idle < 0.5 * busy, "{idle} {busy}");
}

/// Of this process and all its threads.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<f64> =
        text.rsplit_once(')')?.1.split_whitespace().skip(11).take(2).filter_map(|x| x.parse().ok()).collect();
    Some(fields.iter().sum::<f64>() / 100.0)
}
