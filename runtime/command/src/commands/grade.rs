//! The grade of balancing that meets a limit.

use clap::Args;
use eigentol::forced::Extent;
use eigentol::peaks::{Peak, PeakQuantity};
use eigentol::requirement::Requirement;
use eigentol::response::{Response, Vibration};
use eigentol::sweep::Range;
use eigentol::tolerance::Spread;
use eigentol::{Description, Input, Shared, Study};
use eigentol_compiler::compile_text;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::model::rotor::{Unbalanced, turning_mass, unbalances};
use eigentol_interpreter::{Interpreted, value};
use eigentol_results::numbers::{frequency_in, in_unit as number_in, number, rough, short, with_unit};
use eigentol_results::{Answer, Columns, Findings, at_point};
use serde::Serialize;

use crate::failure::Failure;
use crate::output::Output;
use crate::point::{Point, Question};
use crate::progress;
use crate::requirements::requirements;
use crate::sweep::Sweep;
use crate::verdict::Verdict;

/// Grades of balancing of ISO 21940-11, mm/s.
const STANDARD: [f64; 11] = [0.4, 1.0, 2.5, 6.3, 16.0, 40.0, 100.0, 250.0, 630.0, 1600.0, 4000.0];

/// Which grade of balancing meets a limit of vibration, and in how many of the designs within tolerances
#[derive(Args, Debug)]
pub(crate) struct Grade {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    sweep: Sweep,
    /// A limit: `velocity bearing <= 4.5 mm/s rms`; may be given several times, in place of those of a study file
    #[arg(long, value_name = "REQUIREMENT")]
    require: Vec<String>,
    /// The service speed, for which a grade holds [default: the highest of the range, or the speed that is set]
    #[arg(long, value_name = "VALUE")]
    service: Option<String>,
    #[command(flatten)]
    output: Output,
}

impl Grade {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let mut question = self.point.question()?;
        let range = self.sweep.range_alone(&question)?;
        match &range {
            // A limit that depends on the speed is that of service, the highest.
            Some(range) => question.study = question.study.input(range.input, range.high),
            None => question.note_unset(),
        }
        let range = range.map(|range| Range::new(range.input.any(), range.low, range.high));
        let required = if self.require.is_empty() { &question.file.require } else { &self.require };
        if required.is_empty() {
            let help = "state one: `--require 'velocity bearing <= 4.5 mm/s rms'`";
            return Err(Failure::usage("no limit is given", help));
        }
        let bar = progress::bar("designs", None);
        let study = progress::watched(question.study.clone(), &bar);
        let rotor = Rotor::of(&question, study)?;
        let (wanted, _) = requirements::<()>(&question.study, required, &[])?;
        let each = wanted.iter().map(|wanted| rotor.grade(self, wanted, range.as_ref()));
        let each = each.collect::<Result<Vec<_>, _>>()?;
        drop(bar);
        let verdict = match () {
            () if each.iter().any(|grade| !grade.stable) => Verdict::No("not every state is stable".to_owned()),
            () if each.iter().any(|grade| grade.standard.is_none()) => {
                Verdict::No("no standard grade meets every limit".to_owned())
            }
            () => Verdict::of(&question.study)?,
        };
        self.output.show(&Grades {
            each,
            inputs: question.study.input_values().to_vec(),
            description: Shared::from(question.study.description().clone()),
        })?;
        Ok(verdict)
    }
}

/// The rotor: its unbalances, and a study in which they do not vary.
struct Rotor {
    study: Study<Interpreted>,
    unbalances: Vec<Unbalanced>,
    mass: f64,
}

impl Rotor {
    fn of(question: &Question, mut study: Study<Interpreted>) -> Result<Self, Failure> {
        let compilation = compile_text(&question.text, Limits::default());
        let compilation = compilation.map_err(|mistakes| Failure::value("the declaration", &mistakes))?;
        let (u, b) = (study.input_values().to_vec(), study.design_values().to_vec());
        let unbalances = unbalances(&compilation.mechanism, &u, &b);
        let mass = turning_mass(&compilation.mechanism, &u, &b);
        // The question is how large they may be.
        for size in unbalances.iter().filter_map(|unbalance| unbalance.size) {
            study = study.tolerance(eigentol::DesignVariable::new(size.index()), 0.0);
        }
        Ok(Self { study, unbalances, mass })
    }

    fn grade(&self, asked: &Grade, wanted: &Requirement, along: Option<&Range>) -> Result<BalanceGrade, Failure> {
        let d = self.study.description();
        let help = "write `velocity bearing <= 4.5 mm/s rms`, or `vibration y <= 50 um p-p`";
        let refused = || Failure::usage("a grade of balancing meets an upper limit of a vibration", help);
        let Requirement::Within { response, high, .. } = wanted else {
            return Err(refused());
        };
        let (vibration, range) = match (*response, along) {
            (Response::Vibration(vibration), along) => (vibration, along.copied()),
            (Response::Peak { vibration, range, quantity: PeakQuantity::Height }, _) => (vibration, Some(range)),
            _ => return Err(refused()),
        };
        if !high.is_finite() || matches!(vibration.extent, Extent::Sum | Extent::Rms) {
            return Err(refused());
        }
        let response = Response::Vibration(vibration);
        let unbalance = self.first_moment(d, vibration)?;
        let nothing = || Failure::usage("the unbalances do not shake this output", "see `eigentol response`");
        let (highest, stable) = self.highest(vibration, range)?;
        let highest = highest.filter(|highest| highest.spread.mean > 0.0).ok_or_else(nothing)?;
        let (now, most) = (highest.spread.mean, highest.spread.mean + highest.spread.band);
        let place = highest.place.zip(range).and_then(|(place, range)| {
            let unit = &d.inputs.get(range.input.index())?.unit;
            Some(with_unit(number_in(place, unit), unit))
        });
        let service = self.service(asked, vibration, range)?;
        let unit = response.unit(d);
        let of = |amplitude: f64| high / amplitude * unbalance / self.mass * service;
        let (grade, in_most) = (of(now), of(most));
        Ok(BalanceGrade {
            vibration: response.name(d),
            unit: unit.symbol.to_string(),
            limit: unit.from_si(*high),
            now: unit.from_si(now),
            service,
            mass: self.mass,
            unbalance,
            allowed: high / now * unbalance,
            grade,
            in_most,
            stable,
            place,
            amplification: highest.amplification,
            standard: STANDARD.into_iter().rev().find(|standard| *standard <= 1e3 * in_most),
        })
    }

    /// The greatest amplitude and its spread, at the operating point or in a range, at its peaks and its ends; and whether
    /// all of these states are stable. Those that are not do not count in a range.
    fn highest(&self, vibration: Vibration, range: Option<Range>) -> Result<(Option<Highest>, bool), Failure> {
        let study = &self.study;
        let tolerances = study.tolerances()?;
        let at = |study: &Study<Interpreted>, place: Option<f64>| -> Result<Option<Highest>, Failure> {
            let found = study.forced_sensitivities()?;
            let slopes = vibration.slopes(&found).map(|slopes| slopes.by_design);
            let zero = || study.design_values().iter().map(|_| 0.0).collect();
            let value = vibration.of(&found.response);
            let spread = |value| Spread::new(value, slopes.unwrap_or_else(zero), &tolerances);
            Ok(value.map(|value| Highest { spread: spread(value), place, amplification: None }))
        };
        let Some(range) = range else {
            return Ok((at(study, None)?, study.modes()?.stable()));
        };
        let peaks = study.peaks(vibration, Input::new(range.input.index()), range.low, range.high)?;
        // A peak whose derivatives are lost in rounding counts without a spread.
        let still = |height: f64| Spread::new(height, vec![0.0; study.design_values().len()].into(), &tolerances);
        let mut all_stable = peaks.peaks.iter().all(|peak| peak.stable);
        let stable = peaks.peaks.into_iter().filter(|peak| peak.stable);
        let top = |peak: Peak| Highest {
            spread: peak.height.spread.unwrap_or_else(|| still(peak.height.value)),
            place: Some(peak.place.value),
            amplification: peak.amplification.map(|factor| factor.value),
        };
        let mut all: Vec<Highest> = stable.map(top).collect();
        for place in [range.low, range.high] {
            let end = study.clone().input(Input::new(range.input.index()), place);
            if end.modes()?.stable() { all.extend(at(&end, Some(place))?) } else { all_stable = false }
        }
        Ok((all.into_iter().max_by(|a, b| a.spread.mean.total_cmp(&b.spread.mean)), all_stable))
    }

    /// The sum of the unbalances that act on a vibration, kg m, if nothing else acts with them.
    fn first_moment(&self, d: &Description, vibration: Vibration) -> Result<f64, Failure> {
        let with = |excitation: usize| d.excitations.get(excitation).map(|info| info.with);
        let own = with(vibration.excitation.index());
        let known = |k: usize| self.unbalances.iter().find(|unbalance| unbalance.excitation == k);
        let mut sum = 0.0;
        for k in (0..d.excitations.len()).filter(|&k| with(k) == own) {
            let Some(unbalance) = known(k) else {
                let message = format!("`{}` acts with them: a grade is of unbalance alone", d.excitations[k].name);
                return Err(Failure::usage(message, "name the unbalance: `velocity bearing under u <= 4.5 mm/s rms`"));
            };
            sum += unbalance.first_moment.abs();
        }
        Ok(sum)
    }

    /// The service speed, rad/s: the frequency of the unbalance at the end of the range, or at the operating point.
    fn service(&self, asked: &Grade, vibration: Vibration, range: Option<Range>) -> Result<f64, Failure> {
        let d = self.study.description();
        let rate = |info: &eigentol::InputInfo| value("1 rad/s", &info.unit, "a speed").is_ok();
        let input = range.map(|range| range.input.index()).or_else(|| d.inputs.iter().position(rate));
        let mut study = self.study.clone();
        if let (Some(input), Some(info)) = (input, input.and_then(|input| d.inputs.get(input))) {
            let given = asked.service.as_ref().map(|text| {
                let refused = |mistakes| Failure::value(format!("service {text}"), &mistakes);
                value(text, &info.unit, "the service speed").map_err(refused)
            });
            let highest = range.map(|range| if range.low.abs() > range.high.abs() { range.low } else { range.high });
            if let Some(service) = given.transpose()?.or(highest) {
                study = study.input(Input::new(input), service);
            }
        }
        let response = study.forced_response()?;
        let harmonic = response.harmonic(vibration.excitation);
        Ok(harmonic.map_or(f64::NAN, |harmonic| harmonic.frequency.abs()))
    }
}

/// The highest amplitude that a limit meets.
struct Highest {
    spread: Spread,
    /// The value of the input, SI.
    place: Option<f64>,
    amplification: Option<f64>,
}

/// Amplification factor beyond which a resonance has hardly any damping.
const UNDAMPED: f64 = 1e3;

/// The grade of balancing that meets one limit.
#[derive(Clone, Debug, Serialize)]
struct BalanceGrade {
    /// The vibration.
    vibration: String,
    /// Its unit.
    unit: String,
    /// The limit, from 0 to peak, in that unit.
    limit: f64,
    /// The amplitude under the declared unbalances.
    now: f64,
    /// Where in a range that is.
    place: Option<String>,
    /// The amplification factor of the peak there.
    amplification: Option<f64>,
    /// The service speed, rad/s.
    service: f64,
    /// The mass of what turns, kg.
    mass: f64,
    /// The sum of the declared unbalances, kg m.
    unbalance: f64,
    /// The sum of unbalances at which the nominal design meets the limit, kg m.
    allowed: f64,
    /// The grade at which the nominal design meets the limit, m/s.
    grade: f64,
    /// The grade at which designs meet it whose amplitude is greater by the band of the tolerances, m/s.
    in_most: f64,
    /// Whether all states that were compared are stable.
    stable: bool,
    /// The coarsest standard grade that is as fine, mm/s.
    standard: Option<f64>,
}

/// Grades of balancing.
#[derive(Clone, Debug, Serialize)]
struct Grades {
    each: Vec<BalanceGrade>,
    inputs: Vec<f64>,
    description: Shared<Description>,
}

/// `balance grades`: a row for each limit.
impl Answer for Grades {
    const KIND: &'static str = "balance grades";

    at_point!();

    fn findings(&self) -> Findings {
        let name = &self.description.name;
        let mut said = Findings::titled(format!("{name}: grades of balancing that meet limits"));
        let mut table = Columns::new("balance grades", &self.each);
        table.words("vibration", &|row| Some(row.vibration.clone())).shown();
        table.words("unit", &|row| Some(row.unit.clone())).shown();
        table.number("limit", "", &|row| Some(row.limit)).digits(rough);
        table.number("now", "", &|row| Some(row.now)).digits(rough);
        let place = table.words("highest at", &|row| row.place.clone());
        if self.each.iter().any(|row| row.place.is_some()) {
            place.shown();
        }
        table.number("amplification factor", "", &|row| row.amplification);
        table.number("unbalance", "g*mm", &|row| Some(1e6 * row.unbalance)).digits(rough);
        table.number("allowed", "g*mm", &|row| Some(1e6 * row.allowed)).digits(rough);
        table.number("eccentricity", "um", &|row| Some(1e6 * row.allowed / row.mass)).digits(short);
        table.number("grade", "mm/s", &|row| Some(1e3 * row.grade)).digits(short);
        table.number("with tolerances", "mm/s", &|row| Some(1e3 * row.in_most)).digits(short);
        table.number("standard grade", "mm/s", &|row| row.standard);
        table.flag("stable", &|row| Some(row.stable));
        table.number("mass", "kg", &|row| Some(row.mass));
        table.number("service speed", "rad/s", &|row| Some(row.service));
        said.columns(table);
        for row in &self.each {
            let unit = &self.description.frequency;
            let turning = format!("{} kg turning at {}", number(row.mass), frequency_in(row.service, unit, number));
            said.note(match row.standard {
                Some(grade) if row.stable => format!("G{grade} meets the limit of {}: {turning}.", row.vibration),
                Some(grade) => {
                    format!("In the stable states G{grade} meets the limit of {}: {turning}.", row.vibration)
                }
                None => format!("No standard grade meets the limit of {}: {turning}.", row.vibration),
            });
            if !row.stable {
                said.note("Not all of these states are stable, and no machine stays in the others: they are left out.");
            }
            if let (Some(place), Some(factor)) = (&row.place, row.amplification.filter(|factor| *factor > UNDAMPED)) {
                said.note(format!(
                    "At {place} a mode with hardly any damping resonates, amplification factor {}: leave that out of the range, \
                     or declare its damping.",
                    short(factor)
                ));
            }
        }
        let standard: Option<Vec<f64>> = self.each.iter().map(|row| row.standard).collect();
        if let Some(grade) = standard.filter(|all| all.len() > 1).and_then(|all| all.into_iter().reduce(f64::min)) {
            said.note(format!("All limits: G{grade}."));
        }
        said.note("With tolerances: for an amplitude that is greater by its band.");
        said.note("Limits are from 0 to peak. A grade is the eccentricity of all that turns times the service speed (ISO 21940-11).");
        said
    }
}
