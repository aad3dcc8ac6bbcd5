//! Checks the design against its definition.

use super::SaltelliDesign;
use crate::sequence::Sequence;

#[test]
fn designs_are_addressable_and_exchange_one_column() {
    let design = SaltelliDesign::new(Sequence::sobol(6, 4, 0).unwrap(), 9).unwrap();
    assert_eq!(design.evaluations(), 45);
    let mut walk = design.from(0);
    let mut rows: Vec<Vec<f64>> = Vec::new();
    while let Some(point) = walk.next_point() {
        rows.push(point.to_vec());
    }
    assert_eq!(rows.len(), 45);
    let mut alone = [0.0; 3];
    for (k, point) in rows.iter().enumerate() {
        design.point(k as u64, &mut alone).unwrap();
        assert_eq!(alone[..], point[..]);
    }
    let mut coordinates = [0.0; 6];
    for (row, points) in rows.chunks(5).enumerate() {
        Sequence::sobol(6, 4, 0).unwrap().point(row as u64, &mut coordinates).unwrap();
        let (a, b) = coordinates.split_at(3);
        assert_eq!((&points[0][..], &points[1][..]), (a, b));
        for i in 0..3 {
            let exchanged: Vec<f64> = (0..3).map(|j| if j == i { b[j] } else { a[j] }).collect();
            assert_eq!(points[2 + i], exchanged);
        }
    }
    assert!(design.point(45, &mut alone).is_err() && design.point(0, &mut [0.0; 2]).is_err());
    assert!(SaltelliDesign::new(Sequence::sobol(3, 0, 0).unwrap(), 9).is_err());
    let small = Sequence::latin_hypercube(4, 8, 0, 0).unwrap();
    assert!(SaltelliDesign::new(small, 9).is_err());
}
