//! Reports.

use clap::Args;
use eigentol::Output;

use crate::destination::Destination;
use crate::failure::Failure;
use crate::interrupt;
use crate::picture::Wording;
use crate::point::{Point, Question, exact, whole};
use crate::progress;
use crate::requirements::named_pair;
use crate::sweep::{Orders, Points, Sweep};
use crate::verdict::Verdict;

/// Everything about a mechanism in one HTML file: a 3-D view with moving modes, charts, verdicts and tables
#[derive(Args, Debug)]
pub(crate) struct Report {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    sweep: Sweep,
    #[command(flatten)]
    points: Points,
    #[command(flatten)]
    orders: Orders,
    /// Two outputs whose orbits are drawn, `shake,lift`; may be given several times
    #[arg(long = "orbit", value_name = "OUTPUTS")]
    orbits: Vec<String>,
    /// Number of Monte Carlo samples [default: 3000; fewer where each is costly]
    #[arg(long, value_name = "COUNT", value_parser = whole, allow_negative_numbers = true)]
    samples: Option<usize>,
    /// Seed of the samples [default: 0]
    #[arg(long, value_name = "NUMBER", value_parser = exact::<u64>, allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Heading of the report [default: the name of the mechanism]
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    #[command(flatten)]
    wording: Wording,
    #[command(flatten)]
    place: Destination,
}

impl Report {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        if self.place.is_terminal() {
            let message = "a report is a file for a browser, and standard output is a terminal";
            return Err(Failure::usage(message, "write it to a file: `-o report.html`"));
        }
        self.place.check()?;
        let mut question = self.point.question()?;
        let range = self.sweep.range_if_any(&question)?;
        if let Some(range) = &range {
            question.begin(range.input.index(), range.low);
        }
        let values = match &range {
            Some(range) => self.points.values(range, &question, true)?,
            None => {
                question.note_unset();
                self.points.refuse_without_sweep()?;
                Vec::new()
            }
        };
        self.check_names(&question, range.is_some())?;
        let file = &question.file;
        let bar = progress::bar("samples, values and points", None);
        let study = progress::watched(question.study.clone(), &bar)
            .samples(question.few_samples(self.samples)?)
            .seed(self.seed.or(file.seed).unwrap_or(0))
            .stream(file.stream.unwrap_or(0));
        let orders = self.orders.or_first(range.as_ref(), &question)?;
        let mut report = eigentol_report::Report::new(&study)
            .style(self.wording.style(&question))
            .declaration(question.text)
            .orders(&orders);
        if let Some(title) = &self.title {
            report = report.title(title);
        }
        for text in &self.orbits {
            let [x, y] = named_pair(&question.study, text)?;
            report = report.orbit(Output::new(x.index()), Output::new(y.index()));
        }
        if let Some(range) = &range {
            report = report.sweep(range.input, &values);
        }
        let html = report.html()?;
        drop(bar);
        self.place.write(&html)?;
        if interrupt::stopped() {
            return Ok(Verdict::Stopped("the report says what is done".to_owned()));
        }
        // An equilibrium or modes that the report lacks count here as the answer "no".
        Ok(Verdict::of(&study)?)
    }

    /// Refuses more names than there can be modes: of those along an input only the greatest number is known before.
    fn check_names(&self, question: &Question, is_swept: bool) -> Result<(), Failure> {
        let most = if is_swept { 2 * question.study.description().coordinates.len() } else { 0 };
        // The report says why there are no modes.
        match question.study.modes() {
            Ok(modes) => self.wording.check(question, most.max(modes.modes.len())),
            Err(_) => Ok(()),
        }
    }
}
