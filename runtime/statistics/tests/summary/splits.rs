//! Any split, any order of merging and any number of threads give the same bits.

use eigentol_statistics::Error;
use eigentol_statistics::summary::{Chunk, Partial, Plan, chunks};
use proptest::prelude::*;

use crate::common::{add, gathered, plan, quantities, uniform};

/// The bits of every reported number.
fn bits(partial: &Partial) -> Result<Vec<u64>, Error> {
    let mut bits = Vec::new();
    for quantity in 0..3 {
        let Some(s) = partial.statistics(quantity)? else {
            continue;
        };
        bits.extend([s.count, s.mean.to_bits(), s.min.to_bits(), s.max.to_bits()]);
        let optional = [s.standard_error, s.sigma, s.sigma_error, s.skewness, s.excess_kurtosis];
        bits.extend(optional.into_iter().flatten().map(f64::to_bits));
        if s.sketch().is_some() {
            for p in [0.0, 0.01, 0.3, 0.5, 0.9, 1.0] {
                let quantile = s.quantile(p)?;
                bits.extend([quantile.value.to_bits(), quantile.error.to_bits()]);
            }
        }
    }
    for (first, second) in [(0, 1), (0, 2), (2, 1)] {
        if let Some(c) = partial.covariance(first, second)? {
            bits.extend(c.means.map(f64::to_bits));
            bits.extend([c.covariance, c.correlation].into_iter().flatten().map(f64::to_bits));
        }
    }
    bits.extend(partial.outcomes());
    Ok(bits)
}

/// The pieces between these cuts of `0..end`, in an order determined by `order`.
fn pieces(mut cuts: Vec<u64>, end: u64, order: &[u64]) -> Vec<std::ops::Range<u64>> {
    cuts.extend([0, end]);
    cuts.sort_unstable();
    cuts.dedup();
    let mut pieces: Vec<_> = cuts.windows(2).map(|pair| pair[0]..pair[1]).collect();
    for k in (1..pieces.len()).rev() {
        pieces.swap(k, (order[k % order.len()] % (k as u64 + 1)) as usize);
    }
    pieces
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_split_and_order_of_merging_gives_the_same_bits(
        end in 1_u64..3000,
        cuts in prop::collection::vec(0_u64..3000, 0..12),
        order in prop::collection::vec(any::<u64>(), 1..12),
        grouping in prop::collection::vec(any::<u64>(), 1..12),
    ) {
        let whole = gathered(0..end)?;
        let cuts = cuts.into_iter().filter(|cut| *cut < end).collect();
        let mut parts = Vec::new();
        for piece in pieces(cuts, end, &order) {
            parts.push(gathered(piece)?);
        }
        // Merge pairs until one is left.
        for choice in grouping.iter().cycle() {
            if parts.len() == 1 {
                break;
            }
            let taken = parts.swap_remove((choice % parts.len() as u64) as usize);
            let to = (choice >> 32) % parts.len() as u64;
            parts[to as usize].merge(taken)?;
        }
        prop_assert_eq!(bits(&parts[0])?, bits(&whole)?);
        prop_assert_eq!(&parts[0], &whole);
    }

    #[test]
    fn added_in_any_order_with_gaps(
        cuts in prop::collection::vec(0_u64..2500, 1..10),
        order in prop::collection::vec(any::<u64>(), 1..10),
        left_out in any::<u64>(),
    ) {
        let end = 2500;
        let mut shuffled = pieces(cuts.clone(), end, &order);
        let gap = shuffled.swap_remove((left_out % shuffled.len() as u64) as usize);
        let mut partial = Partial::new(plan()?);
        let mut other = Partial::new(plan()?);
        for piece in &shuffled {
            add(&mut partial, piece.clone())?;
        }
        shuffled.sort_by_key(|piece| piece.start);
        for piece in &shuffled {
            other.merge(gathered(piece.clone())?)?;
        }
        prop_assert_eq!(bits(&partial)?, bits(&other)?);
        prop_assert_eq!(partial.missing(0..end), [gap.clone()]);
        add(&mut partial, gap)?;
        prop_assert_eq!(partial.ranges(), [0..end]);
        prop_assert_eq!(bits(&partial)?, bits(&gathered(0..end)?)?);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() -> Result<(), Error> {
    let whole = gathered(0..20_000)?;
    for threads in [2, 3, 7] {
        let parts = std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads)
                .map(|k| scope.spawn(move || gathered(20_000 * k / threads..20_000 * (k + 1) / threads)))
                .collect();
            workers.into_iter().map(|worker| worker.join().expect("no panic")).collect::<Vec<_>>()
        });
        let mut all = Partial::new(plan()?);
        for part in parts {
            all.merge(part?)?;
        }
        assert_eq!(all, whole);
    }
    Ok(())
}

/// The summation tree matters: with plain sums, the bits would depend on the split.
#[test]
fn the_samples_tell_splits_apart() {
    let sum = |samples: std::ops::Range<u64>| samples.filter_map(|k| quantities(k)[1]).sum::<f64>();
    let whole = sum(0..3000);
    assert!((1..3000).any(|cut| (sum(0..cut) + sum(cut..3000)).to_bits() != whole.to_bits()));
}

/// Memory use in terms of the numbers printed: sixteen times the samples need a few more nodes, not sixteen times as
/// many.
#[test]
fn memory_is_flat() -> Result<(), Error> {
    let plan = Plan::new(1).sketch(0, 0.5, 0.1)?;
    let size = |samples| {
        let mut partial = Partial::new(plan.clone());
        for piece in chunks(samples) {
            let mut chunk = Chunk::new(&plan, piece.clone())?;
            for sample in piece {
                chunk.set(sample, 0, Some(0.6 + 0.1 * uniform(50, sample)))?;
            }
            partial.add(&chunk)?;
        }
        Ok::<_, Error>(format!("{partial:?}").len())
    };
    let (few, many) = (size(100..5000)?, size(100..80_000)?);
    assert!(2 * many < 3 * few, "{few} and {many}");
    Ok(())
}
