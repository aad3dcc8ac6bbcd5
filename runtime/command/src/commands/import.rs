//! Translation of robots in URDF or MuJoCo files into declarations.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use eigentol::Unit;
use eigentol_interpreter::value;
use eigentol_urdf::{Options, Resistance, import_mjcf, is_mjcf};

use crate::declaration::Declaration;
use crate::destination::{Destination, is_same};
use crate::diagnostics;
use crate::failure::Failure;
use crate::mistake::Mistake;
use crate::rotor;
use crate::superelement::{self, identifier, is_superelement};
use crate::verdict::Verdict;

/// Translate a robot in a URDF file, a model of MuJoCo (MJCF), a rotor that ROSS has saved, or a superelement, into a declaration; notes say what a mechanism cannot express.
///
/// A model of MuJoCo says itself what holds it and what resists its joints: of the options only `--name` and `--joints` matter to it, to a rotor and a superelement only `--name`.
#[derive(Args, Debug)]
pub(crate) struct Import {
    /// URDF, MJCF or ROSS file, or JSON of a superelement, `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// How the root of the robot is held
    #[arg(long, value_enum, default_value = "fixed")]
    base: Base,
    /// What resists the joints, so that the robot has an equilibrium [default: springs; of a model of MuJoCo what it says]
    #[arg(long, value_enum)]
    joints: Option<Joints>,
    /// Stiffness of the springs of turning joints [default: 50 N*m/rad]
    #[arg(long, value_name = "VALUE")]
    stiffness: Option<String>,
    /// Damping of turning joints [default: 0.5 N*m*s/rad]
    #[arg(long, value_name = "VALUE")]
    damping: Option<String>,
    /// Stiffness of the springs of sliding joints [default: 50 N/m]
    #[arg(long, value_name = "VALUE")]
    linear_stiffness: Option<String>,
    /// Damping of sliding joints [default: 0.5 N*s/m]
    #[arg(long, value_name = "VALUE")]
    linear_damping: Option<String>,
    /// Leave out the damping of joints in the file
    #[arg(long)]
    no_damping: bool,
    /// Replace an inertia that no body can have by the nearest possible one
    #[arg(long)]
    nearest_inertias: bool,
    /// Name of the mechanism [default: that of the robot]
    #[arg(long)]
    name: Option<String>,
    /// Do not print notes
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    place: Destination,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Base {
    /// Welded to the ground
    Fixed,
    /// Free in space
    Floating,
    /// Free in the horizontal plane
    Planar,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Joints {
    /// A spring and a damper on every joint
    Springs,
    /// Joints that nothing resists are driven at 0
    Driven,
    /// What the file says, and nothing else
    File,
    /// Nothing: the declaration is for its kernels alone
    Free,
}

impl Import {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.place.check()?;
        let file = Declaration::raw(&self.file)?;
        let folder = self.file.parent().unwrap_or(Path::new(""));
        if is_superelement(&file.text) {
            return self.superelement(&file, folder);
        }
        if rotor::is_rotor(&file.text) {
            let imported =
                rotor::import(&file.text, self.name.as_deref()).map_err(|mistake| file.refused(vec![mistake]))?;
            self.place.write(&imported.declaration)?;
            if !self.quiet {
                imported.notes.iter().for_each(diagnostics::note);
            }
            return Ok(Verdict::Yes);
        }
        if !file.text.trim_start().starts_with('<') {
            return Err(file.refused(vec![of_no_kind()]));
        }
        let is_mjcf = is_mjcf(&file.text);
        let options = self.options(self.joints.unwrap_or(if is_mjcf { Joints::File } else { Joints::Springs }))?;
        let robot = if is_mjcf {
            import_mjcf(&file.text, &options, &|name| fs::read(folder.join(name)))
        } else {
            eigentol_urdf::import(&file.text, &options)
        };
        let robot = robot.map_err(|error| file.refused(error.mistakes.iter().map(Mistake::from).collect()))?;
        self.place.write(&robot.declaration)?;
        if !self.quiet {
            robot.notes.iter().for_each(diagnostics::note);
        }
        Ok(Verdict::Yes)
    }

    /// The matrices are written first: a declaration without them would be of no use.
    fn superelement(&self, file: &Declaration, folder: &Path) -> Result<Verdict, Failure> {
        let beside =
            || Failure::usage("a superelement has matrices beside it: give --output", "as in `--output casing.part`");
        let output = self.place.path().ok_or_else(beside)?;
        let stem = identifier(&output.file_stem().unwrap_or_default().to_string_lossy());
        let imported = superelement::import(file, folder, &stem, self.name.as_deref())?;
        let mut writes = Vec::new();
        for (name, text) in &imported.matrices {
            writes.push((self.place.beside(name).ok_or_else(beside)?, text));
        }
        for path in writes.iter().filter_map(|(place, _)| place.path()).chain([output]) {
            if imported.read.iter().chain([&self.file]).any(|read| is_same(read, path)) {
                let message = format!("`{}` is read, and would be replaced", path.display());
                return Err(Failure::usage(message, "write into another folder, or give --output another name"));
            }
        }
        for (place, _) in &writes {
            place.check()?;
        }
        for (place, text) in writes {
            place.write(text)?;
        }
        self.place.write(&imported.declaration)?;
        if !self.quiet {
            imported.notes.iter().for_each(diagnostics::note);
        }
        Ok(Verdict::Yes)
    }

    fn options(&self, joints: Joints) -> Result<Options, Failure> {
        let resistance = match joints {
            Joints::Springs => self.springs()?,
            Joints::Driven => Resistance::Drives,
            Joints::File => Resistance::File,
            Joints::Free => Resistance::KernelsOnly,
        };
        let options = Options::default()
            .base(match self.base {
                Base::Fixed => eigentol_urdf::Base::Fixed,
                Base::Floating => eigentol_urdf::Base::Floating,
                Base::Planar => eigentol_urdf::Base::Planar,
            })
            .resistance(resistance)
            .damping(!self.no_damping)
            .nearest_inertias(self.nearest_inertias);
        Ok(match &self.name {
            Some(name) => options.name(name),
            None => options,
        })
    }

    fn springs(&self) -> Result<Resistance, Failure> {
        let mut springs = Resistance::default();
        if let Resistance::Springs { stiffness, damping, linear_stiffness, linear_damping } = &mut springs {
            for (slot, option, text, unit) in [
                (stiffness, "stiffness", &self.stiffness, "N*m/rad"),
                (damping, "damping", &self.damping, "N*m*s/rad"),
                (linear_stiffness, "linear-stiffness", &self.linear_stiffness, "N/m"),
                (linear_damping, "linear-damping", &self.linear_damping, "N*s/m"),
            ] {
                if let Some(text) = text {
                    *slot = si(option, text, unit)?;
                }
            }
        }
        Ok(springs)
    }
}

/// What a file is not.
fn of_no_kind() -> Mistake {
    let message = "this is no URDF, MJCF, rotor of ROSS or superelement, or it is cut off".to_owned();
    let help = "`import` reads URDF and MJCF (XML), what `Rotor.save` of ROSS writes (TOML or JSON), and JSON that begins with \
                `{\"superelement\": \"name\"` and names the files of its matrices";
    Mistake { help: Some(help.to_owned()), ..Mistake::at("", 0, message) }
}

fn si(option: &str, text: &str, symbol: &str) -> Result<f64, Failure> {
    let unit = Unit { symbol: symbol.to_owned().into(), scale: 1.0 };
    let parsed = value(text, &unit, &format!("`{option}`"));
    parsed.map_err(|mistakes| Failure::value(format!("--{option} {text}"), &mistakes))
}
