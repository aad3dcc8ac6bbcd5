//! Sorted, disjoint ranges of samples.

use std::ops::Range;

/// Joins adjacent ranges and drops empty ones.
pub(super) fn joined(ranges: impl IntoIterator<Item = Range<u64>>) -> Vec<Range<u64>> {
    let mut joined: Vec<Range<u64>> = Vec::new();
    for range in ranges.into_iter().filter(|range| !range.is_empty()) {
        match joined.last_mut() {
            Some(last) if last.end == range.start => last.end = range.end,
            _ => joined.push(range),
        }
    }
    joined
}

/// The first samples that both contain.
pub(super) fn overlap(first: &[Range<u64>], second: &[Range<u64>]) -> Option<Range<u64>> {
    let (mut i, mut j) = (0, 0);
    while let (Some(a), Some(b)) = (first.get(i), second.get(j)) {
        let common = a.start.max(b.start)..a.end.min(b.end);
        if !common.is_empty() {
            return Some(common);
        }
        if a.end <= b.end { i += 1 } else { j += 1 }
    }
    None
}

/// The parts of `whole` that are not in any of the ranges.
pub(super) fn missing(ranges: &[Range<u64>], whole: Range<u64>) -> Vec<Range<u64>> {
    let mut missing = Vec::new();
    let mut start = whole.start;
    for range in ranges {
        missing.push(start..range.start.min(whole.end));
        start = start.max(range.end);
    }
    missing.push(start..whole.end);
    joined(missing)
}
