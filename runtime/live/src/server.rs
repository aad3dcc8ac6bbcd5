//! The server: connections on 127.0.0.1, and what each request gets.
//!
//! # One question, one request
//!
//! A page asks for news of the declaration and waits until there are some, and asks its questions with all that it has set, so
//! that the server keeps nothing of a page: two pages have values of their own, and the address of each holds them. The state is
//! in one place (`machine.rs`); a question is answered from the newest machine on a thread of its own, and ends when its
//! connection does. Every request has a connection of its own: what is slow to ask holds nobody up, and is cut off.

use std::convert::Infallible;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use eigentol_report::frame;
use http_body_util::{BodyExt as _, Either, Full, Limited};
use hyper::body::{Bytes, Incoming};
use hyper::header::{CACHE_CONTROL, CONTENT_TYPE, HeaderValue, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Request, Response, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use tokio::time::timeout;

use crate::Error;
use crate::gate::{Asked, Gate};
use crate::machine::{State, Subject};
use crate::work;

/// Time in which a request must be complete.
const PATIENCE: Duration = Duration::from_secs(10);
/// Time after which a page asks for news again.
const QUIET: Duration = Duration::from_secs(25);
/// Bytes of a question.
const LONGEST: usize = 1 << 20;
/// Pause where no connection can be had, and between two looks whether to end.
const PAUSE: Duration = Duration::from_millis(100);

type Body = Either<Full<Bytes>, http_body_util::channel::Channel<Bytes>>;

/// A server of one page. It ends when it is dropped.
#[derive(Debug)]
pub struct Server {
    gate: Arc<Gate>,
    ended: Arc<AtomicBool>,
    answering: Option<JoinHandle<()>>,
}

impl Server {
    /// Begins to serve on a port of 127.0.0.1, or on any that is free if it is 0.
    ///
    /// # Errors
    /// [`Error`].
    pub fn start(subject: Subject, port: u16) -> Result<Self, Error> {
        let refused = |source| Error::Listen { port, source };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(refused)?;
        listener.set_nonblocking(true).map_err(refused)?;
        let own = listener.local_addr().map_err(refused)?.port();
        let gate = Arc::new(Gate::new(own)?);
        let state = Arc::new(State::new(subject));
        let ended = Arc::new(AtomicBool::new(false));
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(refused)?;
        let listener = {
            let _inside = runtime.enter();
            tokio::net::TcpListener::from_std(listener).map_err(refused)?
        };
        let (following, until) = (Arc::clone(&state), Arc::clone(&ended));
        std::thread::spawn(move || following.follow(|| until.load(Ordering::Relaxed)));
        let answering = {
            let (gate, ended) = (Arc::clone(&gate), Arc::clone(&ended));
            std::thread::spawn(move || {
                runtime.block_on(accept(&listener, &gate, &state, &ended));
                // Work that goes on is told to end, and not waited for.
                runtime.shutdown_background();
            })
        };
        Ok(Self { gate, ended, answering: Some(answering) })
    }

    /// The address of the page, with its token.
    #[must_use]
    pub fn address(&self) -> String {
        self.gate.address()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.ended.store(true, Ordering::Relaxed);
        // The port is free after this; what reads the declaration ends when it has read it.
        if let Some(thread) = self.answering.take() {
            // What a thread died of is on standard error.
            let _ = thread.join();
        }
    }
}

async fn accept(listener: &tokio::net::TcpListener, gate: &Arc<Gate>, state: &Arc<State>, ended: &AtomicBool) {
    while !ended.load(Ordering::Relaxed) {
        let Ok(accepted) = timeout(PAUSE, listener.accept()).await else { continue };
        let Ok((stream, _)) = accepted else {
            tokio::time::sleep(PAUSE).await;
            continue;
        };
        let (gate, state) = (Arc::clone(gate), Arc::clone(state));
        tokio::spawn(async move {
            let service = service_fn(|request| respond(request, &gate, &state));
            let mut connection = http1::Builder::new();
            connection.timer(TokioTimer::new()).header_read_timeout(PATIENCE).keep_alive(false);
            // A connection that breaks is over.
            let _ = connection.serve_connection(TokioIo::new(stream), service).await;
        });
    }
}

async fn respond(request: Request<Incoming>, gate: &Gate, state: &Arc<State>) -> Result<Response<Body>, Infallible> {
    let answer = match gate.asked(request.method(), request.uri().path(), request.headers()) {
        Ok(asked) => answered(asked, request.into_body(), state).await,
        Err(refusal) => Err(refusal),
    };
    Ok(answer.unwrap_or_else(|(status, reason)| {
        let mut response = with_headers("text/plain; charset=utf-8", text(reason.to_owned()));
        *response.status_mut() = status;
        response
    }))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct After {
    after: u64,
}

type Refusal = (StatusCode, &'static str);

async fn answered(asked: Asked, body: Incoming, state: &Arc<State>) -> Result<Response<Body>, Refusal> {
    let json = "application/json";
    Ok(match asked {
        Asked::Page => {
            let page =
                frame(&state.subject.name, include_str!("../assets/live.css"), include_str!("../assets/live.js"));
            with_headers("text/html; charset=utf-8", text(page))
        }
        Asked::News => {
            let After { after } = read(body).await?;
            let news = state.news_after(after, QUIET).await;
            let unwritten = (StatusCode::INTERNAL_SERVER_ERROR, "the news cannot be written");
            with_headers(json, text(serde_json::to_string(&news).map_err(|_| unwritten)?))
        }
        Asked::Answer => with_headers(json, Either::Right(work::begin(Arc::clone(state), read(body).await?))),
    })
}

fn text(text: String) -> Body {
    Either::Left(Full::new(Bytes::from(text)))
}

fn with_headers(kind: &'static str, body: Body) -> Response<Body> {
    let mut response = Response::new(body);
    for (name, value) in [
        (CONTENT_TYPE, kind),
        (CACHE_CONTROL, "no-store"),
        // The address is a secret.
        (REFERRER_POLICY, "no-referrer"),
        (X_CONTENT_TYPE_OPTIONS, "nosniff"),
    ] {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response.headers_mut().insert("cross-origin-resource-policy", HeaderValue::from_static("same-origin"));
    response
}

/// Reads a request in time and within its length.
async fn read<T: DeserializeOwned>(body: Incoming) -> Result<T, Refusal> {
    let whole = Limited::new(body, LONGEST).collect();
    let whole = timeout(PATIENCE, whole).await.map_err(|_| (StatusCode::REQUEST_TIMEOUT, "the request did not end"))?;
    let whole = whole.map_err(|_| (StatusCode::PAYLOAD_TOO_LARGE, "the request is too long, or broke off"))?;
    serde_json::from_slice(&whole.to_bytes()).map_err(|_| (StatusCode::BAD_REQUEST, "this is not a question"))
}
