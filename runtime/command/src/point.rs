//! The operating point and tolerances of a command, from the declaration, then the study file, then the command line.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Args;
use eigentol::equilibrium::{Equilibria, Search};
use eigentol::judge;
use eigentol::{Coordinate, Input, Matrix, Parameter, Study, Unit};
use eigentol_compiler::Compilation;
use eigentol_interpreter::{
    Interpreted, Setting, UnitError, coordinate, meant, parameter, read, value, with_setting, with_unit_of,
};

use crate::advice;
use crate::declaration::Declaration;
use crate::diagnostics;
use crate::failure::{Failure, unknown};
use crate::progress;
use crate::study_file::{Correlation, StudyFile, Written};

/// What is studied, and at which values.
#[derive(Args, Debug)]
pub(crate) struct Point {
    /// File with the declaration, `-` for standard input; a study file may name it instead
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    /// Study file in TOML; the command line overrides it
    #[arg(long, value_name = "FILE")]
    study: Option<PathBuf>,
    /// Value of an input or a design variable: `speed=3000rpm`; of several: `blade[..].mass=2kg`
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    set: Vec<(String, String)>,
    /// Tolerance of a design variable or an input: `l=3%`, `l="+0.2 -0.1 mm uniform"`, `l="one of [9, 10] mm"`
    #[arg(long, value_name = "NAME=TOLERANCE", value_parser = pair)]
    tol: Vec<(String, String)>,
    /// Where the search for the equilibrium starts; held while a mechanism with loops is assembled
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    start: Vec<(String, String)>,
    /// Take the equilibrium nearest to the start, whatever its stability
    #[arg(long)]
    stay: bool,
    /// Value of an unknown where steady motions come in a family: `lean=20deg`
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    hold: Vec<(String, String)>,
    /// Bounds of the starts of a search for equilibria: `x=-1..1m`; without them, angles start anywhere
    #[arg(long, value_name = "NAME=FROM..TO", value_parser = pair)]
    between: Vec<(String, String)>,
    /// Least number of random starts of that search [default: 32; more follow as long as they find more, within seconds]
    #[arg(long, value_name = "COUNT", value_parser = whole)]
    starts: Option<usize>,
    /// Take this equilibrium, as numbered by `eigentol equilibria`, whatever its stability
    #[arg(long, value_name = "NUMBER", value_parser = whole)]
    equilibrium: Option<usize>,
    /// Where a dependent coordinate starts, free to move while a mechanism with loops is assembled
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    guess: Vec<(String, String)>,
    /// Unit in which answers state an input, design variable, coordinate or output: `y=um`
    #[arg(long, value_name = "NAME=UNIT", value_parser = pair)]
    unit: Vec<(String, String)>,
    /// Unit of frequencies in texts and figures, `Hz`, `rad/s` or `rpm` [default: Hz where an input is in rpm or Hz,
    /// otherwise rad/s]
    #[arg(long, value_name = "UNIT")]
    frequency_unit: Option<String>,
    /// How many standard deviations make a half-width [default: 3]
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true)]
    sigma_level: Option<f64>,
}

/// A study, together with the study file's settings beyond the operating point.
pub(crate) struct Question {
    pub(crate) study: Study<Interpreted>,
    pub(crate) file: StudyFile,
    /// The declaration.
    pub(crate) text: String,
    /// The names that the command line sets.
    pub(crate) set: Vec<String>,
    /// Where starts of a search for equilibria lie.
    between: Vec<(Coordinate<Interpreted>, f64, f64)>,
    /// Least number of random starts.
    starts: Option<usize>,
}

impl Question {
    /// Where to search for equilibria.
    pub(crate) fn search(&self) -> Result<Search, Failure> {
        let search = self.study.search(&self.between)?;
        let starts = self.starts.unwrap_or(search.starts);
        Ok(search.starts(starts))
    }

    /// Says which inputs an answer at one state takes as zero, because nothing gives their value.
    pub(crate) fn note_unset(&self) {
        for info in self.study.description().inputs.iter().filter(|info| !self.gives(&info.name)) {
            diagnostics::note(&format!("`{}` was not given: 0 {}", info.name, info.unit.symbol));
        }
    }

    fn gives(&self, name: &str) -> bool {
        self.set.iter().any(|set| set == name) || self.file.set.contains_key(name)
    }

    /// Takes a value from a range for an input that nothing gives, if there is no state at zero: tables may begin behind it.
    pub(crate) fn begin(&mut self, input: usize, value: f64) {
        let info = self.study.description().inputs.get(input);
        if info.is_some_and(|info| !self.gives(&info.name)) && self.study.equilibrium().is_err() {
            self.study = self.study.clone().input(Input::new(input), value);
        }
    }

    /// The equilibria of a search.
    pub(crate) fn equilibria(&self) -> Result<Equilibria, Failure> {
        let bar = progress::bar("starts", None);
        Ok(progress::watched(self.study.clone(), &bar).equilibria(&self.search()?)?)
    }

    /// The same question of the equilibrium with this number.
    fn of_equilibrium(mut self, number: usize) -> Result<Self, Failure> {
        let equilibria = self.equilibria()?;
        let Some(state) = number.checked_sub(1).and_then(|k| equilibria.get(k)) else {
            let message = format!("there is no equilibrium {number}: the search finds {}", equilibria.len());
            return Err(Failure::usage(message, "`eigentol equilibria` lists them"));
        };
        self.study = self.study.at(state);
        Ok(self)
    }
}

fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write a name, `=` and a value: `speed=3000rpm`".to_owned()),
    }
}

/// Parses a count: `10000` or `1e4`.
pub(crate) fn whole(text: &str) -> Result<usize, String> {
    let number = text.parse::<f64>().ok();
    let whole = number.filter(|number| number.fract() == 0.0 && (0.0..1e15).contains(number));
    whole.map(|x| x as usize).ok_or_else(|| "write a whole number: `10000` or `1e4`".to_owned())
}

/// Parses a number such as a seed, of which every digit counts.
pub(crate) fn exact<N: FromStr>(text: &str) -> Result<N, String> {
    text.parse().map_err(|_| "write a whole number that is not negative: `7`".to_owned())
}

/// The number of samples of the command line or else the study file.
pub(crate) fn samples(option: Option<usize>, file: &StudyFile) -> Result<usize, Failure> {
    match option.or(file.samples).unwrap_or(3000) {
        0 => {
            let help = "take at least 1: `--samples 3000`";
            Err(Failure::usage("0 samples have no result", help))
        }
        count => Ok(count),
    }
}

impl Question {
    /// The number of samples of an answer that is not about samples: fewer than usual where each is costly.
    pub(crate) fn few_samples(&self, option: Option<usize>) -> Result<usize, Failure> {
        let modes = self.study.modes();
        let usual = modes.map_or(3000, |modes| judge::affordable(&modes, 5.0));
        samples(option.or(self.file.samples).or(Some(usual)), &self.file)
    }
}

impl Point {
    /// The mechanism with the units in which answers are to state its quantities.
    fn stated(&self, machine: Interpreted, file: &StudyFile) -> Result<Interpreted, Failure> {
        let options = self.unit.iter().map(|(name, unit)| (name, unit));
        let mut stated = machine;
        for (name, unit) in file.unit.iter().chain(options) {
            let label = format!("unit {name}={unit}");
            stated = match stated.clone().in_unit(name, unit) {
                Ok(stated) => stated,
                Err(UnitError::Mistakes(mistakes)) => return Err(Failure::value(label, &mistakes)),
                Err(_) => {
                    let d = stated.description();
                    let named = d.inputs.iter().map(|info| &*info.name).chain(d.design.iter().map(|info| &*info.name));
                    let named = named.chain(d.coordinates.iter().map(|info| &*info.name));
                    let named = named.chain(d.outputs.iter().map(|info| &*info.name));
                    return Err(unknown(&d.name, "input, design variable, coordinate or output", name, named));
                }
            };
        }
        match self.frequency_unit.as_ref().or(file.frequency_unit.as_ref()) {
            None => Ok(stated),
            Some(unit) => {
                let refused = |mistakes| Failure::value(format!("frequency_unit {unit}"), &mistakes);
                stated.frequencies_in(unit).map_err(refused)
            }
        }
    }

    /// The study file, and the file of the declaration.
    pub(crate) fn files(&self) -> Result<(StudyFile, PathBuf), Failure> {
        let file = match &self.study {
            Some(path) => StudyFile::read(path)?,
            None => StudyFile::default(),
        };
        match self.file.as_ref().or(file.mechanism.as_ref()).cloned() {
            Some(path) => Ok((file, path)),
            None => {
                let help = "name the file with the declaration, or a study file that does";
                Err(Failure::usage("no mechanism is given", help))
            }
        }
    }

    /// The study of a declaration with all settings but the number of an equilibrium.
    fn study(&self, compilation: &Compilation, file: &StudyFile) -> Result<Study<Interpreted>, Failure> {
        let machine = self.stated(Interpreted::new(compilation), file)?;
        advice::remember(&machine, compilation);
        let mut study = Study::new(machine);
        if let Some(level) = self.sigma_level.or(file.sigma_level) {
            study = study.sigma_level(positive_level(level)?);
        }
        for (setting, given, options) in [
            (Setting::Set, &file.set, &self.set),
            (Setting::Start, &file.start, &self.start),
            (Setting::Guess, &file.guess, &self.guess),
            (Setting::Hold, &file.hold, &self.hold),
            (Setting::Tolerance, &file.tolerance, &self.tol),
        ] {
            let given = given.iter().map(|(name, text)| (name.clone(), text.to_string()));
            for (name, text) in given.chain(options.iter().cloned()) {
                study = with_setting(study, &compilation.ast, setting, &name, &text)?;
            }
        }
        if let Some(Correlation::Pairs(pairs)) = &file.correlation {
            study = correlate(study, pairs)?;
        }
        Ok(if self.stay || file.stay { study.stay() } else { study })
    }

    /// All settings as in a study file about the declaration in this file.
    pub(crate) fn settings(&self, file: &StudyFile, path: &Path) -> toml::Table {
        let mut all = file.all.clone();
        // Beside the file that the page writes, wherever that is put.
        let name = path.file_name().unwrap_or(path.as_os_str());
        all.insert("mechanism".to_owned(), name.display().to_string().into());
        let options = [("set", &self.set), ("start", &self.start), ("guess", &self.guess), ("hold", &self.hold)];
        for (key, given) in
            options.into_iter().chain([("tolerance", &self.tol), ("unit", &self.unit), ("between", &self.between)])
        {
            let own = given.iter().map(|(name, text)| (name.clone(), text.clone().into()));
            match all.get_mut(key) {
                Some(toml::Value::Table(table)) => table.extend(own),
                _ if given.is_empty() => {}
                _ => {
                    all.insert(key.to_owned(), toml::Value::Table(own.collect()));
                }
            }
        }
        if self.stay {
            all.insert("stay".to_owned(), true.into());
        }
        if let Some(number) = self.equilibrium.and_then(|number| i64::try_from(number).ok()) {
            all.insert("equilibrium".to_owned(), number.into());
        }
        if let Some(level) = self.sigma_level {
            all.insert("sigma_level".to_owned(), level.into());
        }
        if let Some(unit) = &self.frequency_unit {
            all.insert("frequency_unit".to_owned(), unit.clone().into());
        }
        all
    }

    /// Reads the files and applies all settings.
    pub(crate) fn question(&self) -> Result<Question, Failure> {
        let (file, path) = self.files()?;
        let declaration = Declaration::read(&path)?;
        let compilation = declaration.compiled()?;
        self.question_about(&compilation, declaration.text, file)
    }

    /// The question about a declaration with this text.
    pub(crate) fn question_about(
        &self,
        compilation: &Compilation,
        text: String,
        file: StudyFile,
    ) -> Result<Question, Failure> {
        let study = self.study(compilation, &file)?;
        let given = file.between.iter();
        let options = self.between.iter().map(|(name, text)| (name, text));
        let between = given.chain(options).map(|(name, text)| bounds(&study, name, text));
        let question = Question {
            between: between.collect::<Result<_, _>>()?,
            starts: self.starts,
            set: self.set.iter().flat_map(|(name, _)| meant(name, study.description())).collect(),
            study,
            text,
            file,
        };
        match self.equilibrium.or(question.file.equilibrium) {
            Some(number) => question.of_equilibrium(number),
            None => Ok(question),
        }
    }
}

fn positive_level(level: f64) -> Result<f64, Failure> {
    if level > 0.0 && level.is_finite() {
        return Ok(level);
    }
    let message = format!("the sigma level is {level}, but it must be positive and finite");
    let help = "it is the number of standard deviations in a half-width: `--sigma-level 3`";
    Err(Failure::usage(message, help))
}

/// Bounds of an unknown, SI.
fn bounds(study: &Study<Interpreted>, name: &str, text: &str) -> Result<(Coordinate<Interpreted>, f64, f64), Failure> {
    let (coordinate, unit) = coordinate(study, name)?;
    let Some((low, high)) = text.split_once("..") else {
        let message = format!("`{text}` is not a range");
        return Err(Failure::usage(message, format!("write `--between {name}=-1..1`")));
    };
    let low = read("between", name, &with_unit_of(low, high), &unit)?;
    Ok((coordinate, low, read("between", name, high, &unit)?))
}

/// Sets pairwise correlations of the design variables, followed by the inputs with tolerances.
fn correlate(study: Study<Interpreted>, pairs: &[(String, String, f64)]) -> Result<Study<Interpreted>, Failure> {
    if pairs.is_empty() {
        return Ok(study);
    }
    let (design, inputs) = (study.design_values().len(), study.deviating_inputs());
    let count = design + inputs.len();
    let independent = || Matrix::from_fn(count, count, |i, j| if i == j { 1.0 } else { 0.0 });
    let mut matrix = study.correlation_matrix().unwrap_or_else(independent);
    let index_of = |name: &str| match parameter(&study, name)?.0 {
        Parameter::Design(variable) => Ok(variable.index()),
        Parameter::Input(input) => {
            let position = inputs.iter().position(|x| *x == input);
            position.map(|k| design + k).ok_or_else(|| {
                let message = format!("correlation of `{name}`, which has no tolerance");
                Failure::usage(message, format!("give `{name}` a tolerance"))
            })
        }
    };
    for (first, second, correlation) in pairs {
        for first in meant(first, study.description()) {
            // One of several instances is not correlated with itself.
            let others = meant(second, study.description()).into_iter();
            for second in &others.filter(|other| *other != first || !second.contains("..")).collect::<Vec<_>>() {
                let (i, j) = (index_of(&first)?, index_of(second)?);
                matrix[i][j] = *correlation;
                matrix[j][i] = *correlation;
            }
        }
    }
    Ok(study.correlation(matrix))
}

/// Reads a value from a study file.
pub(crate) fn written(label: &str, text: &Written, unit: &Unit) -> Result<f64, Failure> {
    let text = text.to_string();
    let refused = |mistakes| Failure::value(format!("{label} = \"{text}\""), &mistakes);
    value(&text, unit, &format!("`{label}`")).map_err(refused)
}
