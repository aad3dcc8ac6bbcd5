//! Checks correlation and regression against exact linear models, hand calculation and their definitions.

use super::*;
use crate::Error;
use crate::sequence::Sequence;

fn inputs(rows: u64, dimensions: usize) -> Vec<Vec<f64>> {
    let sequence = Sequence::random(dimensions, 12, 0).unwrap();
    let mut walk = sequence.from(0);
    let mut rows: Vec<Vec<f64>> = (0..rows).filter_map(|_| walk.next_point().map(<[f64]>::to_vec)).collect();
    // Correlated inputs.
    rows.iter_mut().for_each(|row| row[1] += 0.7 * row[0]);
    rows
}

fn spread(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    (values.map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt()
}

#[test]
fn linear_models_are_found_exactly() {
    let inputs = inputs(50, 4);
    let c = [3.0, -1.0, 0.25, 0.0];
    let f = |row: &Vec<f64>| 100.0 + row.iter().zip(c).map(|(x, c)| c * x).sum::<f64>();
    let results: Vec<f64> = inputs.iter().map(f).collect();
    let values: Vec<Option<f64>> = results.iter().copied().map(Some).collect();
    let regression = Sample::new(&inputs, &values).unwrap().regression().unwrap();
    let unit = spread(results.iter().copied());
    for (j, c) in c.into_iter().enumerate() {
        let exact = c * spread(inputs.iter().map(|row| row[j])) / unit;
        assert!((regression.coefficients[j] - exact).abs() < 1e-12);
        if c != 0.0 {
            assert!((regression.partial[j] - c.signum()).abs() < 1e-9);
        }
    }
    assert!((regression.determination - 1.0).abs() < 1e-12);
}

/// For x = 1, 2, 3, 4 and y = 1, 3, 2, 6 the sum of products is 7, the sums of squares are 5 and 14.
#[test]
fn correlations_by_hand() {
    let inputs = [1.0_f64, 2.0, 3.0, 4.0].map(|x| vec![x, -x, x.exp()]);
    let sample = Sample::new(&inputs, &[1.0, 3.0, 2.0, 6.0].map(Some)).unwrap();
    let pearson = sample.pearson();
    assert!((pearson[0] - 7.0 / 70.0_f64.sqrt()).abs() < 1e-14);
    assert!((pearson[1] + 7.0 / 70.0_f64.sqrt()).abs() < 1e-14);
    // 1 - 6 sum of d^2 / (n (n^2 - 1)), one exchange of neighbours.
    for (value, exact) in sample.spearman().into_iter().zip([0.8, -0.8, 0.8]) {
        assert!((value - exact).abs() < 1e-14);
    }
    // Ranks 0.5, 0.5, 2, 3 of equal numbers: sums 4.5, 4.5 and 5.
    let inputs = [7.0, 7.0, 8.0, 9.0].map(|x| vec![x]);
    let equal = Sample::new(&inputs, &[0.0, 1.0, 2.0, 3.0].map(Some)).unwrap();
    assert!((equal.spearman()[0] - 4.5 / (4.5 * 5.0_f64).sqrt()).abs() < 1e-14);
}

/// The partial correlation is that of the residuals of input and result after regression on the other inputs.
#[test]
fn partial_correlations_are_those_of_residuals() {
    let inputs = inputs(40, 3);
    let f = |row: &Vec<f64>| row[0] * row[0] + 2.0 * row[1] - row[2] + (20.0 * row[2]).sin();
    let results: Vec<f64> = inputs.iter().map(f).collect();
    let values: Vec<Option<f64>> = results.iter().copied().map(Some).collect();
    let regression = Sample::new(&inputs, &values).unwrap().regression().unwrap();
    for i in 0..3 {
        let others: Vec<Vec<f64>> =
            (inputs.iter()).map(|row| (0..3).filter(|j| *j != i).map(|j| row[j]).collect()).collect();
        let column: Vec<f64> = inputs.iter().map(|row| row[i]).collect();
        let x = residuals(&others, &column);
        let y: Vec<Option<f64>> = residuals(&others, &results).into_iter().map(Some).collect();
        let pair: Vec<Vec<f64>> = x.into_iter().map(|x| vec![x]).collect();
        let exact = Sample::new(&pair, &y).unwrap().pearson()[0];
        assert!((regression.partial[i] - exact).abs() < 1e-12);
    }
    let fitted = residuals(&inputs, &results);
    let left = spread(fitted.into_iter()) / spread(results.into_iter());
    assert!((regression.determination - (1.0 - left * left)).abs() < 1e-12);
}

/// Residuals of a fit with a constant, by Gram-Schmidt applied twice.
fn residuals(inputs: &[Vec<f64>], results: &[f64]) -> Vec<f64> {
    let mut basis: Vec<Vec<f64>> = vec![vec![1.0; results.len()]];
    basis.extend((0..inputs[0].len()).map(|j| inputs.iter().map(|row| row[j]).collect()));
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    let clean = |mut vector: Vec<f64>, basis: &[Vec<f64>]| {
        for direction in basis.iter().chain(basis) {
            let part = dot(&vector, direction) / dot(direction, direction);
            vector.iter_mut().zip(direction).for_each(|(x, d)| *x -= part * d);
        }
        vector
    };
    for k in 1..basis.len() {
        basis[k] = clean(basis[k].clone(), &basis[..k]);
    }
    clean(results.to_vec(), &basis)
}

#[test]
fn rows_without_a_result_are_dropped_and_counted() {
    let inputs = inputs(20, 3);
    let mut results: Vec<Option<f64>> = inputs.iter().map(|row| Some(row[0] * row[1])).collect();
    let rest: Vec<Option<f64>> = results[2..].to_vec();
    results[..2].fill(None);
    let sample = Sample::new(&inputs, &results).unwrap();
    let expected = Sample::new(&inputs[2..], &rest).unwrap();
    assert_eq!((sample.rows(), sample.dropped(), expected.dropped()), (18, 2, 0));
    assert_eq!(sample.pearson(), expected.pearson());
    assert_eq!(sample.ranked().dropped(), 2);
}

#[test]
fn wrong_samples_are_refused() {
    let rows = inputs(9, 2);
    let results: Vec<Option<f64>> = rows.iter().map(|row| Some(row[1])).collect();
    let new = |rows: &[Vec<f64>]| Sample::new(rows, &results);
    assert!(matches!(new(&rows[1..]), Err(Error::WrongLength { .. })));
    let mut other = rows.clone();
    other[3].push(0.0);
    assert!(matches!(new(&other), Err(Error::WrongLength { .. })));
    other = rows.clone();
    other.iter_mut().for_each(|row| row[1] = 0.1);
    assert!(matches!(new(&other), Err(Error::Constant { what }) if what == "input 1"));
    other = rows.clone();
    other[0][0] = f64::INFINITY;
    assert!(matches!(new(&other), Err(Error::NotFinite { .. })));
    other = rows.clone();
    other.iter_mut().for_each(|row| row.push(3.0 * row[0] - row[1]));
    let dependent = new(&other).unwrap().regression();
    assert_eq!(dependent, Err(Error::Dependent { input: 2 }));
    let few = Sample::new(&rows[..3], &results[..3]).unwrap().regression();
    assert!(matches!(few, Err(Error::TooFew { found: 3, needed: 4, .. })));
}
