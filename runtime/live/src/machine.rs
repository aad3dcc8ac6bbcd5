//! The state of a server: the newest text, the newest machine that it could be compiled to, and what is wrong with the text.

use std::fs;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use eigentol::Study;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::{Compilation, compile_text, with_included};
use eigentol_interpreter::Interpreted;
use serde::Serialize;
use tokio::sync::watch;

use crate::controls::{Control, controls, usual_sweep};

/// Time between two looks at the text.
const LOOK: Duration = Duration::from_millis(150);

/// What a page is about. Each message is as a command would print it.
pub struct Subject {
    /// What the page calls the declaration: the name of its file.
    pub name: String,
    /// Reads the declaration, with all that it includes, or says why it cannot.
    pub read: Read,
    /// Compiles a text, or says what is wrong with it.
    pub compile: Compile,
    /// The study that the page begins with, or what is wrong with its settings.
    pub study: Begin,
    /// The settings of that study, as in a study file.
    pub settings: toml::Table,
}

type Read = Box<dyn Fn() -> Result<String, String> + Send + Sync>;
type Compile = Box<dyn Fn(&str) -> Result<Compilation, String> + Send + Sync>;
type Begin = Box<dyn Fn(&Compilation) -> Result<Study<Interpreted>, String> + Send + Sync>;

/// Reads a declaration with all that it includes.
///
/// # Errors
/// Why it cannot, in a sentence for people.
pub fn read_file(file: &Path) -> Result<String, String> {
    let text = fs::read_to_string(file).map_err(|error| format!("cannot read `{}`: {error}", file.display()))?;
    with_included(&text, file).map(|(text, _)| text).map_err(|mistakes| mistakes.to_string())
}

/// Compiles a declaration.
///
/// # Errors
/// Its mistakes, each with line and column.
pub fn compiled(text: &str) -> Result<Compilation, String> {
    compile_text(text, Limits::default()).map_err(|mistakes| mistakes.to_string())
}

/// A declaration that compiled.
pub(crate) struct Machine {
    pub(crate) text: String,
    pub(crate) study: Study<Interpreted>,
}

/// What the page needs to know of the state.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct News {
    /// Grows with each change of anything here.
    pub(crate) version: u64,
    pub(crate) name: String,
    /// A changed text is being compiled.
    pub(crate) busy: bool,
    /// What is wrong with the newest text.
    pub(crate) mistakes: Option<String>,
    /// Grows with each machine; zero if there was none.
    pub(crate) machine: u64,
    pub(crate) mechanism: String,
    pub(crate) controls: Vec<Control>,
    /// The range along which to follow modes unless another is given.
    pub(crate) sweep: Option<String>,
}

/// The one state.
pub(crate) struct State {
    pub(crate) subject: Subject,
    machine: Mutex<Option<Arc<Machine>>>,
    news: watch::Sender<News>,
}

impl State {
    pub(crate) fn new(subject: Subject) -> Self {
        let news = News { name: subject.name.clone(), busy: true, version: 1, ..News::default() };
        Self { subject, machine: Mutex::default(), news: watch::Sender::new(news) }
    }

    /// The newest machine that compiled.
    pub(crate) fn machine(&self) -> Option<Arc<Machine>> {
        self.lock().clone()
    }

    fn lock(&self) -> MutexGuard<'_, Option<Arc<Machine>>> {
        self.machine.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The news, as soon as they are newer than this version.
    pub(crate) async fn news_after(&self, version: u64, patience: Duration) -> News {
        let mut listener = self.news.subscribe();
        let newer = listener.wait_for(|news| news.version != version);
        // Nothing new is an answer too: the page asks again.
        let _ = tokio::time::timeout(patience, newer).await.map(drop);
        self.news.borrow().clone()
    }

    fn tell(&self, change: impl FnOnce(&mut News)) {
        self.news.send_modify(|news| {
            change(news);
            news.version += 1;
        });
    }

    /// Follows the text until told to end.
    pub(crate) fn follow(&self, ended: impl Fn() -> bool) {
        let mut last = None;
        while !ended() {
            let read = (self.subject.read)();
            if last.as_ref() != Some(&read) {
                self.tell(|news| news.busy = true);
                match read.clone().and_then(|text| self.compiled(text)) {
                    Ok((machine, controls)) => self.replace(machine, controls),
                    Err(mistakes) => self.tell(|news| {
                        news.mistakes = Some(mistakes);
                        news.busy = false;
                    }),
                }
                last = Some(read);
            }
            std::thread::sleep(LOOK);
        }
    }

    fn compiled(&self, text: String) -> Result<(Machine, Vec<Control>), String> {
        let compilation = (self.subject.compile)(&text)?;
        let study = (self.subject.study)(&compilation)?;
        let controls = controls(&study, &compilation.ast, &self.subject.settings);
        Ok((Machine { text, study }, controls))
    }

    fn replace(&self, machine: Machine, controls: Vec<Control>) {
        let sweep = usual_sweep(&machine.study);
        let mechanism = machine.study.description().name.to_string();
        *self.lock() = Some(Arc::new(machine));
        self.tell(|news| {
            let (version, count) = (news.version, news.machine + 1);
            let name = std::mem::take(&mut news.name);
            *news = News { version, name, busy: false, mistakes: None, machine: count, mechanism, controls, sweep };
        });
    }
}
