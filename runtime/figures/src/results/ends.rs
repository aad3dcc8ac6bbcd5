//! Names of modes at the right ends of their curves, for readers who cannot tell colours apart.

use std::collections::BTreeMap;

use super::tracks::Track;
use crate::figure::{Curve, Panel, Point};
use crate::style::Style;

/// The last points of the curves of each mode.
#[derive(Default)]
pub(crate) struct Ends(BTreeMap<usize, Vec<Point>>);

impl Ends {
    pub(crate) fn add(&mut self, track: &Track, curve: &Curve) {
        let points = curve.pieces.iter().flatten().copied();
        self.0.entry(track.label).or_default().extend(points);
    }

    /// Writes the name of each mode at its last point within the panel; a single mode needs none.
    pub(crate) fn write(self, panel: &mut Panel, style: &Style) {
        if self.0.len() < 2 {
            return;
        }
        let [low, high] = panel.y.range;
        for (label, points) in self.0 {
            let seen = points.into_iter().filter(|point| (low..=high).contains(&point[1]));
            if let Some(last) = seen.max_by(|a, b| a[0].total_cmp(&b[0])) {
                panel.label(last, style.mode(label));
            }
        }
    }
}
