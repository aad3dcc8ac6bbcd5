//! Forced vibration.

use clap::{ArgGroup, Args};
use eigentol::Study;
use eigentol::bode::Bode;
use eigentol::peaks::Peaks;
use eigentol::response::Vibration;
use eigentol_figures as figures;
use eigentol_interpreter::{Interpreted, vibration};

use crate::diagnostics;
use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::{Point, Question, whole};
use crate::progress;
use crate::requirements::named_orbit;
use crate::sweep::{Points, Range, Sweep, range, unswept};
use crate::verdict::Verdict;

/// Most designs solved anew for each band, unless their number is given.
const CHECKED: usize = 64;

/// Vibration under the declared excitations: amplitudes and phases, their derivatives and their bands under tolerances
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("detail").args(["bands", "peaks", "figure"]).multiple(true))]
pub(crate) struct Response {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    sweep: Sweep,
    #[command(flatten)]
    points: Points,
    /// Bands of the amplitudes under tolerances
    #[arg(long)]
    bands: bool,
    /// Number of samples of a band [default: 3000; fewer where each is costly]
    #[arg(long, value_name = "COUNT", value_parser = whole, allow_negative_numbers = true, requires = "bands")]
    samples: Option<usize>,
    /// Number of designs solved anew to check each band along an input [default: 64]
    #[arg(long, value_name = "COUNT", value_parser = whole, allow_negative_numbers = true, requires = "bands")]
    checked: Option<usize>,
    /// The peaks of every amplitude in the range of `--sweep`, with their half-power points and spreads
    #[arg(long, conflicts_with_all = ["bands", "figure", "points"])]
    peaks: bool,
    /// Speeds of operation, for separation margins in the manner of API 617: `speed=4000..6000rpm`
    #[arg(long, value_name = "NAME=FROM..TO", requires = "peaks")]
    operating: Option<String>,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    picture: Picture,
    /// Only this vibration among bands, peaks and in the figure: `shake`, or `shake under u`
    #[arg(long, value_name = "VIBRATION", requires = "detail")]
    of: Option<String>,
    /// The figure is a polar plot: the path of the complex amplitude along the input of `--sweep`
    #[arg(long, requires = "figure")]
    polar: bool,
    /// The figure is the orbit of two outputs at one operating point: `shake,lift`, or `shake,lift under u`
    #[arg(long, value_name = "OUTPUTS", requires = "figure", conflicts_with_all = ["polar", "of"])]
    orbit: Option<String>,
}

impl Response {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        self.picture.check(&self.output)?;
        let mut question = self.point.question()?;
        let wanted = match &self.of {
            Some(text) => vec![vibration(&question.study, text)?],
            None => Vibration::all(question.study.description()),
        };
        let number = question.few_samples(self.samples)?;
        question.study = question.study.samples(number);
        if self.orbit.is_some() && self.sweep.range_if_any(&question)?.is_some() {
            let message = "an orbit is drawn at one operating point, not along an input";
            return Err(Failure::usage(message, "leave out the sweep, and set the input"));
        }
        let Some(range) = self.sweep.range_alone(&question)? else {
            self.points.refuse_without_sweep()?;
            if self.peaks {
                return Err(unswept("--peaks"));
            }
            if self.checked.is_some() {
                return Err(unswept("--checked"));
            }
            if self.picture.is_wanted() && self.orbit.is_none() {
                let message = "a Bode plot or a polar plot needs values of an input";
                let help = "give a range, `--sweep speed=0..6000rpm`, or draw an orbit: `--orbit shake,lift`";
                return Err(Failure::usage(message, help));
            }
            return self.at_point(&question, &wanted);
        };
        if self.peaks {
            return self.peaks_in(&question.study, &range, &wanted);
        }
        let values = self.points.values(&range, &question, true)?;
        // Without damping a peak is infinite, and the curves say so.
        let drawn = wanted.first().copied().filter(|_| self.picture.is_wanted());
        let peaks = drawn.and_then(|of| question.study.peaks(of, range.input, range.low, range.high).ok());
        let peaks: Vec<_> = peaks.into_iter().collect();
        let bar = progress::bar("values", Some(values.len() as u64));
        question.study = progress::watched(question.study, &bar);
        let (study, input) = (&question.study, range.input);
        let bode = if self.bands {
            study.bode_bands(input, &values, &wanted, self.checked.unwrap_or((number / 12).clamp(8, CHECKED)))?
        } else {
            study.bode(input, &values)?
        };
        let between: Vec<f64> = peaks.iter().flat_map(Peaks::bends).collect();
        let mut course = bode.clone();
        if !between.is_empty() {
            let bands = self.bands.then(|| study.bode_bands(input, &between, &wanted, 0));
            course = course.with_between(bands.unwrap_or_else(|| study.bode(input, &between))?);
        }
        drop(bar);
        self.figure(&question, &course, drawn, &peaks)?;
        self.output.show(&bode)?;
        if bode.points.len() < values.len() {
            return Ok(Verdict::stopped(bode.points.len(), values.len(), "values"));
        }
        let mut solved = bode.points.iter().filter(|point| point.vibration.is_ok());
        Ok(match solved.next() {
            None => Verdict::No("no value of the range has a vibration".to_owned()),
            Some(first) if first.stable || solved.any(|point| point.stable) => Verdict::Yes,
            Some(_) => Verdict::No("every state in the range is unstable".to_owned()),
        })
    }

    fn peaks_in(&self, study: &Study<Interpreted>, along: &Range, wanted: &[Vibration]) -> Result<Verdict, Failure> {
        let operating = self.operating.as_ref().map(|text| range(study, text));
        let operating = operating.transpose()?;
        if operating.as_ref().is_some_and(|operating| operating.input != along.input) {
            let help = "state it for the input of `--sweep`";
            let message = "the range of operation is of another input";
            return Err(Failure::usage(message, help));
        }
        let bar = progress::bar("states", None);
        let peaks = progress::watched(study.clone(), &bar).peaks_of(wanted, along.input, along.low, along.high)?;
        drop(bar);
        let mut answer = self.output.answer();
        answer.add(&peaks)?;
        let peaked: Vec<Peaks> = (peaks.into_iter()).filter(|x| !x.peaks.is_empty()).collect();
        let any = !peaked.is_empty();
        let mut tops = peaked.iter().flat_map(|peaks| &peaks.peaks);
        let stable = tops.any(|peak| peak.stable);
        if let (Some(operating), true) = (&operating, any) {
            let ends = [operating.low.min(operating.high), operating.low.max(operating.high)];
            let margins: Vec<_> = peaked.into_iter().map(|x| x.separation(ends)).collect();
            answer.add(&margins)?;
        }
        self.output.write(&answer)?;
        Ok(match (any, stable) {
            (false, _) => Verdict::No("no amplitude has a peak".to_owned()),
            (true, false) => Verdict::No("every peak is unstable".to_owned()),
            (true, true) => Verdict::Yes,
        })
    }

    /// The Bode plot or the polar plot of a vibration; `None` without outputs or excitations, which the analysis refuses.
    fn figure(
        &self,
        question: &Question,
        bode: &Bode,
        drawn: Option<Vibration>,
        peaks: &[Peaks],
    ) -> Result<(), Failure> {
        self.picture.draw(|| {
            let drawn = drawn.ok_or_else(|| figures::Error::Nothing("the mechanism has no output".to_owned()))?;
            let style = self.picture.plain_style(question);
            if self.polar {
                figures::polar(bode, drawn, peaks, &style)
            } else {
                figures::bode(bode, drawn, peaks, &style)
            }
        })
    }

    fn at_point(&self, question: &Question, wanted: &[Vibration]) -> Result<Verdict, Failure> {
        question.note_unset();
        let study = &question.study;
        let orbit = self.orbit.as_ref().map(|text| named_orbit(study, text));
        let orbit = orbit.transpose()?;
        let verdict = Verdict::of(study)?;
        let mut answer = self.output.answer();
        let response = match study.forced_sensitivities() {
            Ok(derivatives) => {
                answer.add(&derivatives)?;
                derivatives.response
            }
            // Amplitudes exist at critical states, and beside outputs that have none.
            Err(error) => {
                let response = study.forced_response().map_err(|_| error.clone())?;
                diagnostics::note(&format!("the amplitudes have no derivatives: {error}"));
                answer.add(&response)?;
                response
            }
        };
        if let Some((pair, excitation)) = orbit {
            let style = self.picture.plain_style(question);
            (self.picture).draw(|| figures::orbit(&response, pair, excitation, &style))?;
        }
        if self.bands {
            answer.add(&study.vibration_spread(wanted)?)?;
        }
        self.output.write(&answer)?;
        Ok(verdict)
    }
}
