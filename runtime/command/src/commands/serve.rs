//! The page that answers while one edits.

use std::fs;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Args;
use eigentol_live::{Server, Subject};

use crate::declaration::Declaration;
use crate::destination::print;
use crate::diagnostics::plain;
use crate::failure::Failure;
use crate::interrupt;
use crate::point::Point;
use crate::verdict::Verdict;

/// Time between two looks for an interrupt.
const LOOK: Duration = Duration::from_millis(100);

/// A page for a browser on this machine that answers while one edits: sliders for all values and tolerances, and beside them
/// modes in motion, sensitivities, bands, Campbell diagram and response. Saving the file updates it; Ctrl-C ends it
#[derive(Args, Debug)]
pub(crate) struct Serve {
    #[command(flatten)]
    point: Point,
    /// Port of 127.0.0.1 [default: any that is free]
    #[arg(long, value_name = "NUMBER", default_value_t = 0, hide_default_value = true)]
    port: u16,
}

impl Serve {
    pub(crate) fn run(self) -> Result<Verdict, Failure> {
        let stop = interrupt::stop();
        let (file, path) = self.point.files()?;
        if path.as_os_str() == "-" {
            let message = "a page follows a file, and `-` is standard input";
            return Err(Failure::usage(message, "write the declaration to a file"));
        }
        // What is not there at the start is a mistake on the command line; what is wrong in it is shown by the page.
        fs::metadata(&path).map_err(|source| Failure::read(&path, source))?;
        let settings = self.point.settings(&file, &path);
        let name = path.display().to_string();
        let shown = name.clone();
        let subject = Subject {
            name: name.clone(),
            read: Box::new(move || Ok(Declaration::read(&path).map_err(|failure| plain(&failure))?.text)),
            compile: Box::new(move |text| {
                let declaration = Declaration { name: name.clone(), text: text.to_owned() };
                declaration.compiled().map_err(|failure| plain(&failure))
            }),
            study: Box::new(move |compilation| {
                let question = self.point.question_about(compilation, String::new(), file.clone());
                Ok(question.map_err(|failure| plain(&failure))?.study)
            }),
            settings,
        };
        let server = Server::start(subject, self.port)?;
        print(&format!("{shown}: {}\n", server.address()))?;
        while !stop.load(Ordering::Relaxed) {
            std::thread::sleep(LOOK);
        }
        interrupt::answer();
        drop(server);
        Ok(Verdict::Stopped("the page is no longer served".to_owned()))
    }
}
