//! The command line, the same for every example.

use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{CommandFactory, FromArgMatches, Parser};

use crate::Failure;

/// What the user may choose.
#[derive(Clone, Debug, Parser)]
pub struct Options {
    /// Number of speeds of the sweep
    #[arg(long, value_name = "N", default_value = "89", allow_negative_numbers = true, value_parser = whole::<1, 100_000>)]
    pub speeds: usize,
    /// Samples of every Monte Carlo run
    #[arg(long, value_name = "N", default_value = "3000", allow_negative_numbers = true, value_parser = whole::<2, 1_000_000_000>)]
    pub samples: usize,
    /// Seed of the samples: the same seed gives the same numbers
    #[arg(long, value_name = "N", default_value = "0", allow_negative_numbers = true, value_parser = seed)]
    pub seed: u64,
    /// Threads of the Monte Carlo runs; 0 takes all
    #[arg(long, value_name = "N", default_value = "0", allow_negative_numbers = true, value_parser = whole::<0, 1024>)]
    pub threads: usize,
    /// Directory of the figures and CSV files [default: `target/` and the name of the example]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[arg(skip)]
    name: &'static str,
}

impl Options {
    /// Parses the arguments of the example `name` and checks that its directory is writable.
    ///
    /// A mistake therefore shows up before the computation, not after it.
    ///
    /// # Errors
    /// [`Failure::CommandLine`] and [`Failure::Output`].
    pub fn parse(
        name: &'static str,
        about: &'static str,
        arguments: impl IntoIterator<Item = OsString>,
    ) -> Result<Self, Failure> {
        let command = Self::command().name(name).about(about);
        let parsed = command
            .try_get_matches_from(arguments)
            .and_then(|matches| Self::from_arg_matches(&matches));
        let options = Self {
            name,
            ..parsed.map_err(|error| Failure::CommandLine(Box::new(error)))?
        };
        options.prepare_directory()?;
        Ok(options)
    }

    /// The path of a results file.
    pub fn file(&self, name: &str) -> PathBuf {
        self.directory().join(name)
    }

    /// The directory of the results.
    pub fn directory(&self) -> PathBuf {
        self.out
            .clone()
            .unwrap_or_else(|| Path::new("target").join(self.name))
    }

    /// Prints where the figures and CSV files are.
    ///
    /// # Errors
    /// [`Failure::Print`].
    pub fn print_directory(&self, out: &mut dyn Write) -> Result<(), Failure> {
        let directory = self.directory();
        writeln!(out, "Figures and CSV files: {}", directory.display())?;
        Ok(())
    }

    fn prepare_directory(&self) -> Result<(), Failure> {
        let refuse = |path: PathBuf, error: std::io::Error| Failure::Output {
            path,
            reason: error.to_string(),
        };
        let directory = self.directory();
        if directory.exists() && !directory.is_dir() {
            return Err(Failure::Output {
                path: directory,
                reason: "it is a file".to_owned(),
            });
        }
        fs::create_dir_all(&directory).map_err(|error| refuse(directory, error))?;
        // Append nothing, so that an earlier result survives if this run is stopped.
        let probe = self.file("sweep.csv");
        let mut opening = fs::OpenOptions::new();
        match opening.append(true).create(true).open(&probe) {
            Ok(_) => Ok(()),
            Err(error) => Err(refuse(probe, error)),
        }
    }
}

fn whole<const LEAST: usize, const MOST: usize>(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(number) if (LEAST..=MOST).contains(&number) => Ok(number),
        _ => Err(format!("give a whole number from {LEAST} to {MOST}")),
    }
}

fn seed(text: &str) -> Result<u64, String> {
    let range = format!("give a whole number from 0 to {}", u64::MAX);
    text.parse().map_err(|_| range)
}
