//! A headless Chromium, controlled through the Chrome DevTools Protocol: JSON over a WebSocket.

use std::io::{BufRead as _, BufReader};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use serde_json::{Value, json};
use tungstenite::{Message, WebSocket};

/// Browser executables to look for.
const PROGRAMS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// A browser with one page.
pub(crate) struct Chrome {
    process: Child,
    profile: PathBuf,
    socket: WebSocket<TcpStream>,
    session: String,
    number: u64,
    /// Console messages and errors of the page.
    pub(crate) complaints: Vec<String>,
    /// Requested addresses.
    pub(crate) requests: Vec<String>,
}

impl Chrome {
    /// Starts a browser; `None` if there is none.
    pub(crate) fn start(name: &str) -> Option<Self> {
        let profile = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("chrome-{name}-{}", std::process::id()));
        let mut process = PROGRAMS.iter().find_map(|program| {
            Command::new(program)
                .args([
                    "--headless",
                    "--no-sandbox",
                    "--disable-gpu",
                    "--no-first-run",
                    "--disable-background-networking",
                    "--disable-component-update",
                    "--disable-sync",
                    "--remote-debugging-port=0",
                    "--window-size=1200,900",
                    "about:blank",
                ])
                .arg(format!("--user-data-dir={}", profile.display()))
                .stderr(Stdio::piped())
                .stdout(Stdio::null())
                .spawn()
                .ok()
        })?;
        let mut lines = BufReader::new(process.stderr.take().expect("its messages")).lines();
        let address = lines
            .by_ref()
            .map_while(Result::ok)
            .find_map(|line| Some(line.split_once("listening on ")?.1.to_owned()))
            .expect("a browser says where it listens");
        // Its output must be read, or it blocks.
        std::thread::spawn(move || lines.for_each(drop));
        let host = address.trim_start_matches("ws://");
        let host = host.split('/').next().expect("a host");
        let stream = TcpStream::connect(host).expect("the browser listens");
        let (socket, _) = tungstenite::client(&*address, stream).expect("the browser answers");
        let mut own = Self {
            process,
            profile,
            socket,
            session: String::new(),
            number: 0,
            complaints: Vec::new(),
            requests: Vec::new(),
        };
        let target = own.ask("Target.createTarget", json!({ "url": "about:blank" }));
        let attached = own.ask("Target.attachToTarget", json!({ "targetId": target["targetId"], "flatten": true }));
        own.session = attached["sessionId"].as_str().expect("a session").to_owned();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            own.ask(&format!("{domain}.enable"), json!({}));
        }
        Some(own)
    }

    /// One command and its result.
    pub(crate) fn ask(&mut self, method: &str, parameters: Value) -> Value {
        self.number += 1;
        let mut message = json!({ "id": self.number, "method": method, "params": parameters });
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        self.socket.send(Message::text(message.to_string())).expect("the browser listens");
        loop {
            let answer = self.receive();
            if answer["id"] == json!(self.number) {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].clone();
            }
        }
    }

    fn receive(&mut self) -> Value {
        let message = self.socket.read().expect("the browser speaks");
        let value: Value = serde_json::from_str(message.to_text().expect("text")).expect("JSON");
        match value["method"].as_str() {
            Some("Runtime.exceptionThrown" | "Runtime.consoleAPICalled" | "Log.entryAdded") => {
                self.complaints.push(value["params"].to_string());
            }
            Some("Network.requestWillBeSent") => {
                let address = &value["params"]["request"]["url"];
                self.requests.push(address.as_str().unwrap_or_default().to_owned());
            }
            _ => {}
        }
        value
    }

    /// Opens a file and waits until it is drawn.
    pub(crate) fn open(&mut self, file: &Path) {
        self.visit(&format!("file://{}", file.display()));
    }

    /// Opens an address and waits until it is drawn.
    pub(crate) fn visit(&mut self, address: &str) {
        self.complaints.clear();
        self.requests.clear();
        self.ask("Page.navigate", json!({ "url": address }));
        loop {
            let done = self
                .evaluate("document.readyState === 'complete' && document.documentElement?.dataset.drawn === 'yes'");
            if done == json!(true) || !self.complaints.is_empty() {
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    }

    /// The value of an expression in the page; promises are awaited.
    pub(crate) fn evaluate(&mut self, expression: &str) -> Value {
        let asked =
            json!({ "expression": expression, "returnByValue": true, "awaitPromise": true, "userGesture": true });
        let answer = self.ask("Runtime.evaluate", asked);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// The whole page as PNG.
    pub(crate) fn screenshot(&mut self) -> Vec<u8> {
        let asked = json!({ "format": "png", "captureBeyondViewport": true });
        bytes(&self.ask("Page.captureScreenshot", asked)["data"])
    }

    /// The printed page.
    pub(crate) fn pdf(&mut self) -> Vec<u8> {
        let asked = json!({ "printBackground": true, "preferCSSPageSize": true });
        bytes(&self.ask("Page.printToPDF", asked)["data"])
    }

    pub(crate) fn number(&mut self, expression: &str) -> f64 {
        let value = self.evaluate(expression);
        value.as_f64().unwrap_or_else(|| panic!("{expression} is {value}"))
    }

    pub(crate) fn text(&mut self, expression: &str) -> String {
        let value = self.evaluate(expression);
        value.as_str().unwrap_or_else(|| panic!("{expression} is {value}")).to_owned()
    }

    /// Moves, presses or releases the mouse as a user would.
    pub(crate) fn mouse(&mut self, kind: &str, [x, y]: [f64; 2]) {
        let pressed = kind != "mouseMoved";
        let button = if pressed { "left" } else { "none" };
        let clicks = u8::from(pressed);
        let event = json!({ "type": kind, "x": x, "y": y, "button": button, "clickCount": clicks });
        self.ask("Input.dispatchMouseEvent", event);
    }

    pub(crate) fn drag(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.mouse("mouseMoved", from);
        self.mouse("mousePressed", from);
        for share in [0.3, 0.7, 1.0] {
            let place = [0, 1].map(|k| from[k] + share * (to[k] - from[k]));
            let event = json!({ "type": "mouseMoved", "x": place[0], "y": place[1], "button": "left", "buttons": 1 });
            self.ask("Input.dispatchMouseEvent", event);
        }
        self.mouse("mouseReleased", to);
    }

    pub(crate) fn key(&mut self, key: &str) {
        for kind in ["keyDown", "keyUp"] {
            let text = match key {
                "Enter" => "\r",
                key if key.chars().count() == 1 => key,
                _ => "",
            };
            let event =
                json!({ "type": kind, "key": key, "code": key, "text": if kind == "keyDown" { text } else { "" } });
            self.ask("Input.dispatchKeyEvent", event);
        }
    }
}

fn bytes(data: &Value) -> Vec<u8> {
    let text = data.as_str().expect("data");
    data_encoding::BASE64.decode(text.as_bytes()).expect("base 64")
}

impl Drop for Chrome {
    fn drop(&mut self) {
        // On this request it also ends its other processes, which write to the profile.
        let close = json!({ "id": 0, "method": "Browser.close" });
        let _ = self.socket.send(Message::text(close.to_string()));
        let ended = (0..100).any(|_| {
            std::thread::sleep(std::time::Duration::from_millis(30));
            matches!(self.process.try_wait(), Ok(Some(_)))
        });
        if !ended {
            let _ = self.process.kill();
            let _ = self.process.wait();
        }
        let _ = std::fs::remove_dir_all(&self.profile);
    }
}
