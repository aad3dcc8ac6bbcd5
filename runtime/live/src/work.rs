//! A question while it is worked on: lines of JSON, each how far the work is, and the last one its answer.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use http_body_util::channel::{Channel, Sender};
use hyper::body::Bytes;
use serde::Serialize;
use tokio::task::JoinHandle;
use tokio::time::timeout;

use crate::answer::{Answer, Question, Watch};
use crate::machine::State;

/// Time between two lines.
const BEAT: Duration = Duration::from_millis(150);

/// A line.
#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum Line {
    Steps(usize),
    Answer(Answer),
    Refused(String),
}

/// Ends its work when nobody waits for it.
struct Asked {
    watch: Watch,
    work: JoinHandle<Line>,
}

impl Drop for Asked {
    fn drop(&mut self) {
        self.watch.stop.store(true, Ordering::Relaxed);
    }
}

/// Begins to work on a question; the body grows until the answer is there. If its reader leaves, the work ends.
pub(crate) fn begin(state: Arc<State>, question: Question) -> Channel<Bytes> {
    let (sender, body) = Channel::new(8);
    let watch = Watch::default();
    let own = watch.clone();
    let work = tokio::task::spawn_blocking(move || {
        let Some(machine) = state.machine() else {
            return Line::Refused("there is no machine yet: the declaration has mistakes".to_owned());
        };
        match question.answer(&machine, &state.subject, &own) {
            Ok(answer) => Line::Answer(answer),
            Err(message) => Line::Refused(message),
        }
    });
    tokio::spawn(report(Asked { watch, work }, sender));
    body
}

async fn report(mut asked: Asked, mut sender: Sender<Bytes>) {
    loop {
        let line = match timeout(BEAT, &mut asked.work).await {
            Err(_) => Line::Steps(asked.watch.steps.load(Ordering::Relaxed)),
            Ok(Ok(line)) => line,
            Ok(Err(error)) => Line::Refused(format!("the work ended too early: {error}")),
        };
        let text = serde_json::to_string(&line)
            .unwrap_or_else(|error| format!("{{\"refused\":\"the answer cannot be written: {error}\"}}"));
        let sent = sender.send_data(Bytes::from(text + "\n")).await;
        if sent.is_err() || !matches!(line, Line::Steps(_)) {
            return;
        }
    }
}
