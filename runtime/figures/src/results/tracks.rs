//! Eigenvalues along an input as lines: one for each motion, kind and sense of whirl, joined where two of them meet.
//!
//! No sweep point lies exactly where a pair of conjugate eigenvalues becomes two real ones, or where an undamped
//! frequency vanishes. Near such a point `s = m +- sqrt(D)` with smooth `m` and `D`; interpolating both linearly from
//! the neighbouring points lets the lines meet as they truly do.

use eigentol::Complex;
use eigentol::modes::{Character, Sense};

use super::along::{Sample, Station};
use crate::figure::Point;

/// Number of points between a station and a turning point.
const STEPS: usize = 12;

/// An eigenvalue at a value of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TrackPoint {
    pub(crate) value: f64,
    pub(crate) s: Complex,
}

/// What a line shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Motion {
    /// An oscillation, with its kind and sense of whirl if something spins.
    Oscillation(Option<Character>),
    /// A real eigenvalue.
    Real,
}

/// A motion, in pieces.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Track {
    pub(crate) label: usize,
    pub(crate) motion: Motion,
    pub(crate) pieces: Vec<Vec<TrackPoint>>,
}

impl Track {
    /// The pieces as points of a figure.
    pub(crate) fn points(&self, of: impl Fn(&TrackPoint) -> Point) -> Vec<Vec<Point>> {
        self.pieces.iter().map(|piece: &Vec<TrackPoint>| piece.iter().map(&of).collect()).collect()
    }

    pub(crate) fn oscillates(&self) -> bool {
        self.motion != Motion::Real
    }
}

/// The lines of all motions by label, oscillations first. `critical` holds the values at which stiffness is lost.
pub(crate) fn tracks(stations: &[Station], critical: &[f64]) -> Vec<Track> {
    let mut lines = Lines::default();
    for pair in stations.windows(2) {
        lines.between(&pair[0], &pair[1], critical);
    }
    for station in stations {
        lines.alone(station);
    }
    let mut tracks = lines.tracks;
    tracks.sort_by_key(|track| (track.label, order(track.motion)));
    tracks
}

fn order(motion: Motion) -> usize {
    match motion {
        Motion::Oscillation(character) => match character.and_then(|x| x.sense) {
            None => 0,
            Some(Sense::Forward) => 1,
            Some(Sense::Backward) => 2,
            Some(Sense::Planar) => 3,
        },
        Motion::Real => 4,
    }
}

#[derive(Default)]
struct Lines {
    tracks: Vec<Track>,
}

impl Lines {
    /// Adds a stretch of a motion, extending a piece that ends where it begins.
    fn stretch(&mut self, label: usize, motion: Motion, states: &[TrackPoint]) {
        let existing = self.tracks.iter().position(|track: &Track| track.label == label && track.motion == motion);
        let index = existing.unwrap_or_else(|| {
            self.tracks.push(Track { label, motion, pieces: Vec::new() });
            self.tracks.len() - 1
        });
        let pieces = &mut self.tracks[index].pieces;
        match pieces.last_mut() {
            Some(piece) if piece.last() == states.first() => piece.extend(&states[1..]),
            _ => pieces.push(states.to_vec()),
        }
    }

    /// Adds a mode that belongs to no line yet as a single point.
    fn alone(&mut self, station: &Station) {
        for sample in &station.modes {
            let state = TrackPoint { value: station.value, s: sample.s };
            let mut tracks = self.tracks.iter().filter(|track| track.label == sample.label);
            if !tracks.any(|item| item.pieces.iter().flatten().any(|known| *known == state)) {
                self.stretch(sample.label, motion(sample, sample), &[state]);
            }
        }
    }

    fn between(&mut self, from: &Station, to: &Station, critical: &[f64]) {
        if from.modes.is_empty() || to.modes.is_empty() {
            return;
        }
        let same = |a: &Sample, b: &Sample| a.label == b.label && a.oscillates == b.oscillates;
        let turn =
            |value: &&f64| (from.value < **value && **value < to.value) || (to.value < **value && **value < from.value);
        let turn = critical.iter().find(turn).copied();
        // Undamped modes lose their stiffness where the softest frequency vanishes.
        let softest = turn.and_then(|_| softest(from));
        for a in &from.modes {
            let Some(b) = to.modes.iter().find(|b| same(a, b)) else {
                continue;
            };
            match turn.filter(|_| softest == Some(a.label) && a.oscillates && undamped(a, b)) {
                Some(turn) => {
                    self.half(&[a], from.value, turn, Complex::ZERO, false);
                    self.half(&[b], to.value, turn, Complex::ZERO, true);
                }
                None => self.stretch(a.label, motion(a, b), &[state(from, a), state(to, b)]),
            }
        }
        let lost = unmatched(from, to, same);
        let gained = unmatched(to, from, same);
        self.turns(from, to, (&lost, &gained), turn);
        self.turns(to, from, (&gained, &lost), turn);
    }

    /// Adds the turning points where oscillations of `pair` become real eigenvalues in `single`.
    fn turns(
        &mut self,
        pair: &Station,
        single: &Station,
        (lost, gained): (&[Sample], &[Sample]),
        critical: Option<f64>,
    ) {
        let mut reals: Vec<&Sample> = gained.iter().filter(|x| !x.oscillates).collect();
        reals.sort_by(|a, b| a.s.re.total_cmp(&b.s.re));
        let backwards = pair.value > single.value;
        for sample in lost.iter().filter(|x| x.oscillates) {
            let two = (0..reals.len().saturating_sub(1)).min_by(|&a, &b| {
                let far = |k: usize| (middle(&reals[k..k + 2]) - sample.s.re).abs();
                far(a).total_cmp(&far(b))
            });
            let first = -sample.s.im * sample.s.im;
            let (partners, last, mean) = match two {
                Some(k) if sample.s.re != 0.0 || reals[k].s.re * reals[k + 1].s.re >= 0.0 => {
                    let half = 0.5 * (reals[k + 1].s.re - reals[k].s.re);
                    let mean = middle(&reals[k..k + 2]);
                    let partners = vec![reals.remove(k), reals.remove(k)];
                    (partners, half * half, mean)
                }
                _ => match reals.iter().position(|real| real.label == sample.label) {
                    Some(k) if sample.s.re == 0.0 => {
                        let real = reals.remove(k);
                        (vec![real], real.s.re * real.s.re, 0.0)
                    }
                    _ => continue,
                },
            };
            let share = if last > first { first / (first - last) } else { 0.5 };
            let value =
                critical.filter(|_| sample.s.re == 0.0).unwrap_or(pair.value + share * (single.value - pair.value));
            let at = Complex::new(sample.s.re + share * (mean - sample.s.re), 0.0);
            self.half(&[sample], pair.value, value, at, backwards);
            self.half(&partners, single.value, value, at, !backwards);
        }
    }

    /// Draws from a station to a turning point, where all of `samples` reach `at`.
    ///
    /// A pair of real eigenvalues stays on either side of its mean. `reverse` draws from the turning point to the
    /// station.
    fn half(&mut self, samples: &[&Sample], station: f64, turn: f64, at: Complex, reverse: bool) {
        let mean = match samples {
            [a, b] => 0.5 * (a.s.re + b.s.re),
            [a] if a.oscillates => a.s.re,
            _ => 0.0,
        };
        for sample in samples {
            let mut states: Vec<TrackPoint> = (0..=STEPS)
                .map(|k| {
                    let t = k as f64 / STEPS as f64;
                    let middle = mean + t * (at.re - mean);
                    let root = (sample.s - mean) * (1.0 - t).sqrt();
                    TrackPoint { value: station + t * (turn - station), s: Complex::new(middle + root.re, root.im) }
                })
                .collect();
            states[0] = TrackPoint { value: station, s: sample.s };
            if reverse {
                states.reverse();
            }
            self.stretch(sample.label, motion(sample, sample), &states);
        }
    }
}

fn state(station: &Station, sample: &Sample) -> TrackPoint {
    TrackPoint { value: station.value, s: sample.s }
}

/// A step takes the kind and sense at its end or, if nothing spins there, at its beginning.
fn motion(from: &Sample, to: &Sample) -> Motion {
    if to.oscillates { Motion::Oscillation(to.character.or(from.character)) } else { Motion::Real }
}

fn undamped(a: &Sample, b: &Sample) -> bool {
    a.s.re == 0.0 && b.s.re == 0.0
}

fn softest(station: &Station) -> Option<usize> {
    let least = station.modes.iter().min_by(|a, b| a.s.norm().total_cmp(&b.s.norm()));
    least.map(|least| least.label)
}

/// Modes of `station` that continue in no mode of `other`.
fn unmatched(station: &Station, other: &Station, same: impl Fn(&Sample, &Sample) -> bool) -> Vec<Sample> {
    let modes = station.modes.iter().copied();
    modes.filter(|a| !other.modes.iter().any(|b| same(a, b))).collect()
}

fn middle(pair: &[&Sample]) -> f64 {
    0.5 * (pair[0].s.re + pair[1].s.re)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(label: usize, re: f64, im: f64) -> Sample {
        Sample { label, s: Complex::new(re, im), oscillates: im != 0.0, character: None }
    }

    fn station(value: f64, modes: Vec<Sample>) -> Station {
        Station { value, modes }
    }

    #[test]
    fn two_real_eigenvalues_meet_the_pair_they_turn_into() {
        // s = -1 +- sqrt(0.5 - v)
        let root = 0.5_f64.sqrt();
        let stations = [
            station(0.0, vec![sample(0, -1.0 - root, 0.0), sample(1, -1.0 + root, 0.0)]),
            station(1.0, vec![sample(0, -1.0, root)]),
        ];
        let tracks = tracks(&stations, &[]);
        assert_eq!(tracks.len(), 3);
        for track in &tracks {
            let ends = [track.pieces[0].first(), track.pieces[0].last()];
            let at_turn = ends.into_iter().flatten().filter(|x| (x.value - 0.5).abs() < 1e-12);
            let s: Vec<Complex> = at_turn.map(|at_turn| at_turn.s).collect();
            assert!(s.len() == 1 && (s[0] - Complex::new(-1.0, 0.0)).norm() < 1e-12, "{track:?}");
            for state in &track.pieces[0] {
                let exact = Complex::new(0.5 - state.value, 0.0).sqrt();
                let (a, b) = (exact - 1.0, -exact - 1.0);
                let far = (state.s - a).norm().min((state.s - b).norm());
                assert!(far < 1e-7, "{state:?}");
            }
        }
    }

    #[test]
    fn an_undamped_frequency_reaches_zero_at_the_critical_value() {
        let stations = [station(0.0, vec![sample(0, 0.0, 2.0)]), station(4.0, vec![sample(0, 0.0, 3.0)])];
        let tracks = tracks(&stations, &[1.0]);
        let [track] = &tracks[..] else {
            panic!("{tracks:?}");
        };
        let lowest = track.pieces.iter().flatten().find(|x| x.value == 1.0);
        assert_eq!(lowest.map(|own| own.s.im), Some(0.0));
        assert_eq!(track.pieces.len(), 1);
    }

    #[test]
    fn a_failed_point_leaves_a_gap() {
        let stations =
            [station(0.0, vec![sample(0, 0.0, 2.0)]), station(1.0, vec![]), station(2.0, vec![sample(0, 0.0, 2.0)])];
        let tracks = tracks(&stations, &[]);
        assert_eq!(tracks[0].pieces.len(), 2);
        assert!(tracks[0].pieces.iter().all(|piece| piece.len() == 1));
    }
}
