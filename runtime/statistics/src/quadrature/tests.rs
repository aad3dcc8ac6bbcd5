//! Checks rules against reference values, and grids against moments of the normal distribution.

use super::*;

/// The mean of `z^exponent`: `(exponent - 1)!!` or zero.
pub(super) fn moment(exponent: u32) -> f64 {
    if exponent % 2 == 1 {
        return 0.0;
    }
    (1..exponent).step_by(2).map(f64::from).product()
}

/// Number of nodes, node and weight, computed with 50 digits from the three-term recurrence (mpmath). Scaled by
/// `sqrt(1/2)` and `sqrt(pi)`, those of 10 nodes are in Abramowitz and Stegun, table 25.10.
const REFERENCE: [(usize, f64, f64); 17] = [
    (10, 0.48493570751549764, 0.34464233493201907),
    (10, 1.4659890943911582, 0.13548370298026774),
    (10, 2.4843258416389546, 0.019111580500770286),
    (10, 3.581823483551927, 0.0007580709343122177),
    (10, 4.859462828332312, 4.310652630718287e-06),
    (63, 0.39427621554318115, 0.14556029162597162),
    (63, 0.7887941101952671, 0.11536940911860985),
    (63, 6.492041508554625, 1.2134983535332409e-10),
    (63, 13.122773251777115, 1.1169151003963276e-38),
    (63, 13.863360177154519, 5.868010955496014e-43),
    (63, 14.758025457404141, 2.0930985828460167e-48),
    (64, 0.19558891056727554, 0.15310831636189678),
    (64, 0.5868828233052925, 0.1314532313175009),
    (64, 6.64937145634172, 4.296426248985252e-11),
    (64, 13.255649357397285, 1.9301704298297755e-39),
    (64, 13.99404990887647, 9.47696319004303e-44),
    (64, 14.886186143339453, 3.123187965107721e-49),
];

#[test]
fn rules_agree_with_reference_values() {
    for (nodes, node, weight) in REFERENCE {
        let rule = gauss_hermite(nodes).unwrap();
        for sign in [-1.0, 1.0] {
            let near = |z: &&f64| (**z - sign * node).abs() < 1e-14 * node;
            let index = rule.nodes.iter().position(|z| near(&z));
            let computed = rule.weights[index.expect("a node there")];
            assert!((computed / weight - 1.0).abs() < 2e-14, "{nodes} {node} {computed:e}");
        }
    }
}

/// Moments up to the degree of exactness are exact; the next one differs by `n!` (the norm of the Hermite polynomial).
#[test]
fn rules_are_exact_up_to_their_degree() {
    for nodes in (1..=40).chain([64, 128, 256]) {
        let rule = gauss_hermite(nodes).unwrap();
        assert!(rule.nodes.is_sorted());
        let mean = |exponent: u32| {
            let terms = rule.nodes.iter().zip(&rule.weights);
            terms.map(|(z, w)| w * z.powi(exponent as i32)).sum::<f64>()
        };
        for exponent in 0..(2 * nodes as u32).min(120) {
            let scale = moment(exponent + exponent % 2);
            assert!((mean(exponent) - moment(exponent)).abs() < 2e-13 * scale, "{nodes} {exponent}");
        }
        if nodes < 15 {
            let factorial: f64 = (1..=nodes as u32).map(f64::from).product();
            let next = 2 * nodes as u32;
            let missing = moment(next) - mean(next);
            assert!((missing / factorial - 1.0).abs() < 1e-8, "{nodes}");
        }
    }
}

#[test]
fn tensor_grids_are_exact_up_to_their_degrees() {
    let nodes = [2, 1, 4];
    let grid = TensorGrid::new(&nodes).unwrap();
    assert_eq!((grid.points(), grid.dimensions()), (8, 3));
    let monomial = |z: &[f64], e: [u32; 3]| {
        let powers = z.iter().zip(e).map(|(z, e)| z.powi(e as i32));
        powers.product::<f64>()
    };
    for (a, b, c) in (0..5).flat_map(|a| (0..3).flat_map(move |b| (0..9).map(move |c| (a, b, c)))) {
        let mean = grid.integrate(|z| monomial(z, [a, b, c])).unwrap();
        let exact = moment(a) * moment(b) * moment(c);
        let within = a < 4 && b < 2 && c < 8;
        let odd = a % 2 + b % 2 + c % 2 > 0;
        assert_eq!((mean - exact).abs() < 1e-12, within || odd, "{a} {b} {c}");
    }
    assert_eq!(grid.from(8).next_point(), None);
}

#[test]
fn tensor_grids_can_be_entered_anywhere() {
    let grid = TensorGrid::new(&[3, 2, 4]).unwrap();
    let mut all = Vec::new();
    let mut walk = grid.from(0);
    while let Some(node) = walk.next_point() {
        all.push((node.point.to_vec(), node.weight));
    }
    assert_eq!(all.len(), 24);
    for (k, (point, weight)) in all.iter().enumerate() {
        let mut walk = grid.from(k as u64);
        let node = walk.next_point().unwrap();
        assert_eq!((node.point, node.weight), (&point[..], *weight));
    }
}

#[test]
fn settings_are_checked() {
    assert!(gauss_hermite(0).is_err() && gauss_hermite(257).is_err());
    assert!(TensorGrid::new(&[]).is_err() && TensorGrid::new(&[2; 64]).is_err());
    assert!(TensorGrid::new(&[2, 0]).is_err());
    assert!(SparseGrid::new(0, 1).is_err());
    assert!(SparseGrid::new(2000, 12).is_err());
    let grid = SparseGrid::new(2, 1).unwrap();
    assert!(matches!(grid.integrate(|_| f64::NAN), Err(Error::NotFinite { .. })));
}
