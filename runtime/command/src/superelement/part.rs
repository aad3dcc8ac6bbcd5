//! The part that a file describes: its stations, what the rows of its matrices are, and its declaration.

use std::collections::{HashMap, HashSet};

use eigentol_compiler::matrix_market::Mistake;

use super::assembly::{Row, in_order, rows};
use super::files::Found;
use super::json::{self, At, File};
use super::matrix::{Label, first};
use super::units::Scales;
use crate::failure::Failure;

pub(super) struct Part<'a> {
    text: &'a str,
    pub(super) file: File<'a>,
    pub(super) scales: Scales,
    /// Stations by their nodes.
    stations: HashMap<i64, usize>,
    /// The rows of matrices that do not say them.
    unknowns: Option<Vec<Row>>,
}

impl<'a> Part<'a> {
    pub(super) fn read(text: &'a str) -> Result<Self, Mistake> {
        let file = json::read(text)?;
        if file.stations.is_empty() {
            return Err(first("there are no stations: a superelement is held and loaded at one or more"));
        }
        let mut stations = HashMap::new();
        for (k, station) in file.stations.iter().enumerate() {
            let Some(at) = station.node else { continue };
            if let Some(other) = stations.insert(at.get(text)?, k) {
                return Err(at.mistake(text, format!("station {} is at this node already", other + 1)));
            }
        }
        let scales = Scales::of(&file.units, text)?;
        let said =
            |at: At<'a>| rows(&at.get::<Vec<Label>>(text)?, &stations).map_err(|message| at.mistake(text, message));
        let unknowns = file.unknowns.map(said).transpose()?;
        Ok(Self { text, file, scales, stations, unknowns })
    }

    /// What the rows of each matrix are.
    pub(super) fn rows(&self, all: &[Found]) -> Result<Vec<Vec<Row>>, Failure> {
        let stations = self.file.stations.len();
        let is_said = all.iter().any(|found| found.matrix.labels.is_some());
        let of = |found: &Found| {
            let (word, order) = (found.role.word, found.matrix.order);
            let (other, expected) = (all[0].role.word, all[0].matrix.order);
            let rows = match (&found.matrix.labels, &self.unknowns) {
                (Some(labels), _) => rows(labels, &self.stations),
                (None, Some(rows)) if rows.len() == order => Ok(rows.clone()),
                (None, Some(rows)) => Err(format!("the {word} has {order} rows, and `unknowns` lists {}", rows.len())),
                _ if is_said || order < 6 * stations => {
                    Err(format!("what are the {order} rows of the {word}? List the `unknowns`"))
                }
                _ if order != expected => {
                    Err(format!("the {word} has {order} rows, and the {other} {expected}: give matrices of one order"))
                }
                _ => Ok(in_order(order, stations)),
            };
            rows.map_err(first).map_err(found.file.wrong())
        };
        all.iter().map(of).collect()
    }

    /// Notes on motions of stations that no matrix has.
    pub(super) fn lacking(&self, listed: &HashSet<Row>) -> Result<Vec<String>, Mistake> {
        let mut notes = Vec::new();
        for (k, station) in self.file.stations.iter().enumerate() {
            let count = (6 * k..6 * k + 6).filter(|row| listed.contains(&Row::Station(*row))).count();
            let name = k + 1;
            if count == 0 {
                let message = format!("no matrix has a row of station {name}: give a node that was retained");
                return Err(station.node.map_or_else(|| first(&message), |at| at.mistake(self.text, &message)));
            }
            if count < 6 {
                notes.push(format!(
                    "station {name} has {count} of its 6 motions in the files: the rows of the others are zero"
                ));
            }
        }
        Ok(notes)
    }

    pub(super) fn declaration(&self, mechanism: Option<&str>, arguments: &str) -> String {
        let mut nodes: HashMap<usize, i64> = HashMap::new();
        nodes.extend(self.stations.iter().map(|(node, station)| (*station, *node)));
        let (mut comments, mut places) = (String::new(), Vec::new());
        for (k, station) in self.file.stations.iter().enumerate() {
            let name = station.name.as_deref().unwrap_or_default().replace(char::is_control, " ");
            let node = nodes.get(&k).map_or_else(String::new, |node| format!(" node {node}"));
            let comment = format!("    // station {}: {name}{node}", k + 1).replace(":  ", ": ");
            comments = comments + comment.trim_end_matches([':', ' ']) + "\n";
            places.push(format!("[{}]", station.position.map(|x| format!("{} m", self.scales.metres(x))).join(", ")));
        }
        let body = identifier(&self.file.superelement);
        let held = if self.file.held.is_some() { "held: inside, " } else { "" };
        let mechanism = mechanism.map_or_else(|| capitalised(&body), str::to_owned);
        format!(
            "/// A superelement from a finite element program.\nmechanism {mechanism} {{\n{comments}    \
             body {body}: superelement({arguments}{held}stations: [{}]);\n}}\n",
            places.join(", ")
        )
    }
}

fn capitalised(name: &str) -> String {
    let words = name.split('_').filter(|word| !word.is_empty());
    words.map(|word| word[..1].to_ascii_uppercase() + &word[1..]).collect()
}

/// A name that a declaration and a file can have.
pub(crate) fn identifier(text: &str) -> String {
    let plain: String = text.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if plain.starts_with(|c: char| c.is_ascii_alphabetic()) { plain } else { format!("part_{plain}") }
}
