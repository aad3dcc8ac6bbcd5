//! Settings of a study as names and texts: `set speed = 3000 rpm`.

use eigentol::{Coordinate, CoordinateInfo, DesignVariable, Error, Input, Parameter, Role, Study, Text, Unit};
use eigentol_compiler::syntax::ast::Ast;

use crate::given::{design_tolerance, tolerance, tolerate, value};
use crate::mechanism::Interpreted;
use crate::names::meant;
use crate::wanted::WantedError;

type Result<T> = core::result::Result<T, WantedError>;

/// A setting whose value is a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Setting {
    /// The value of an input or a design variable.
    Set,
    /// Where the search for the equilibrium starts.
    Start,
    /// Where a dependent coordinate starts.
    Guess,
    /// The value of an unknown where steady motions come in a family.
    Hold,
    /// The tolerance of an input or a design variable.
    Tolerance,
}

impl Setting {
    /// In the order of application: tolerances are about values.
    pub const ALL: [Self; 5] = [Self::Set, Self::Start, Self::Guess, Self::Hold, Self::Tolerance];

    /// Its word in a study file.
    pub fn word(self) -> &'static str {
        match self {
            Self::Set => "set",
            Self::Start => "start",
            Self::Guess => "guess",
            Self::Hold => "hold",
            Self::Tolerance => "tolerance",
        }
    }
}

/// Applies a setting to all that a name or a pattern of names means.
///
/// ```
/// use eigentol::Study;
/// use eigentol_compiler::{compile_text, mechanics::Limits};
/// use eigentol_interpreter::{Interpreted, Setting, with_setting};
///
/// let text = "mechanism A { design k = 9 N/m; body a: point(mass: 1 kg); joint x: prismatic(x) from ground to a;
///     force s: spring(on: x, stiffness: k); }";
/// let compilation = compile_text(text, Limits::default())?;
/// let study = Study::new(Interpreted::new(&compilation));
/// let study = with_setting(study, &compilation.ast, Setting::Set, "k", "4 N/m")?;
/// assert_eq!(study.design_values(), [4.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`WantedError`]: a name that nothing has, or a value that cannot be read.
pub fn with_setting(
    mut study: Study<Interpreted>,
    of: &Ast,
    setting: Setting,
    pattern: &str,
    text: &str,
) -> Result<Study<Interpreted>> {
    for name in &meant(pattern, study.description()) {
        study = match setting {
            Setting::Set => {
                let (parameter, unit) = parameter(&study, name)?;
                let value = read(setting.word(), name, text, &unit)?;
                match parameter {
                    Parameter::Input(input) => study.input(input, value),
                    Parameter::Design(variable) => study.design(variable, value),
                }
            }
            Setting::Tolerance => toleranced(study, of, name, text)?,
            Setting::Start | Setting::Guess | Setting::Hold => {
                let (coordinate, unit) = coordinate(&study, name)?;
                let value = read(setting.word(), name, text, &unit)?;
                match setting {
                    Setting::Start => study.start(coordinate, value),
                    Setting::Guess => study.guess(coordinate, value),
                    _ => study.hold(coordinate, value),
                }
            }
        };
    }
    Ok(study)
}

fn toleranced(study: Study<Interpreted>, of: &Ast, name: &str, text: &str) -> Result<Study<Interpreted>> {
    let (parameter, unit) = parameter(&study, name)?;
    let place = || format!("tolerance {name}={text}");
    let (value, parsed) = match parameter {
        Parameter::Input(input) => {
            let value = study.input_values()[input.index()];
            (value, tolerance(text, &unit, value))
        }
        Parameter::Design(variable) => {
            let (k, design) = (variable.index(), study.design_values());
            (design[k], design_tolerance(of, text, k, design))
        }
    };
    let parsed = parsed.map_err(|mistakes| WantedError::Value { place: place(), mistakes })?;
    Ok(tolerate(study, parameter, parsed, value))
}

/// Reads the value (SI) that an option gives to a name.
///
/// # Errors
/// [`WantedError::Value`].
pub fn read(option: &str, name: &str, text: &str, unit: &Unit) -> Result<f64> {
    let place = || format!("{option} {name}={text}");
    value(text, unit, &format!("`{name}`")).map_err(|mistakes| WantedError::Value { place: place(), mistakes })
}

/// The input or design variable with this name, and its unit.
///
/// # Errors
/// [`WantedError`]: there is none.
pub fn parameter(study: &Study<Interpreted>, name: &str) -> Result<(Parameter<Interpreted>, Unit)> {
    if let Ok((input, unit)) = input(study, name) {
        return Ok((input.into(), unit));
    }
    if let Ok((variable, unit)) = design(study, name) {
        return Ok((variable.into(), unit));
    }
    if study.find_coordinate(name).is_ok() {
        return Err(WantedError::Meaning {
            message: format!("`{name}` is a coordinate, not an input or design variable"),
            help: "the analysis finds its value; `--start` says where the search begins".to_owned(),
        });
    }
    let description = study.description();
    let inputs = description.inputs.iter().map(|info| &info.name);
    let known = inputs.chain(description.design.iter().map(|info| &info.name));
    Err(unknown(study, "input or design variable", name, known))
}

/// The design variable with this name, and its unit.
///
/// # Errors
/// [`WantedError`]: there is none.
pub fn design(study: &Study<Interpreted>, name: &str) -> Result<(DesignVariable<Interpreted>, Unit)> {
    let variable = study.find_design(name)?;
    Ok((variable, study.description().design[variable.index()].unit.clone()))
}

fn input(study: &Study<Interpreted>, name: &str) -> Result<(Input<Interpreted>, Unit)> {
    let input = study.find_input(name)?;
    Ok((input, study.description().inputs[input.index()].unit.clone()))
}

/// The unknown with this name, and its unit.
///
/// # Errors
/// [`WantedError`]: there is none.
pub fn coordinate(study: &Study<Interpreted>, name: &str) -> Result<(Coordinate<Interpreted>, Unit)> {
    let all = &study.description().coordinates;
    match study.find_coordinate(name) {
        Ok(coordinate) => Ok((coordinate, all[coordinate.index()].unit.clone())),
        Err(_) if parameter(study, name).is_ok() => Err(WantedError::Meaning {
            message: format!("`{name}` is not a coordinate"),
            help: format!("give the values of inputs and design variables by `--set {name}=...`"),
        }),
        Err(_) => {
            let moves = |info: &&CoordinateInfo| matches!(info.role, Role::Position | Role::Speed);
            Err(unknown(study, "coordinate", name, all.iter().filter(moves).map(|info| &info.name)))
        }
    }
}

fn unknown<'a>(
    study: &Study<Interpreted>,
    kind: &'static str,
    name: &str,
    known: impl Iterator<Item = &'a Text>,
) -> WantedError {
    let mechanism = study.description().name.clone();
    WantedError::Name(Error::UnknownName { kind, name: name.to_owned(), mechanism, known: known.cloned().collect() })
}
