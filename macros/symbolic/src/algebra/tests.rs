//! Compares the graph with plain numbers: rules, derivatives in both directions, substitution.

use super::regroup::share_reciprocals;
use super::rules::TableOperator;
use super::*;
use crate::base::ids::{ExprId, SymbolId};

/// A small deterministic generator, so that the tests of this crate need no library.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn symbols(g: &mut Graph, n: usize) -> (Vec<SymbolId>, Vec<ExprId>) {
    (0..n).map(|i| g.symbol(format!("s{i}"), Stage::Design)).unzip()
}

/// A random expression that is positive and of moderate size if its symbols are.
fn expression(g: &mut Graph, random: &mut Random, leaves: &[ExprId], depth: usize) -> ExprId {
    if depth == 0 || random.below(4) == 0 {
        return if random.below(4) == 0 {
            let value = [0.0, 1.0, -1.0, 2.0, 0.5, -3.0][random.below(6)];
            g.constant(value)
        } else {
            leaves[random.below(leaves.len())]
        };
    }
    let a = expression(g, random, leaves, depth - 1);
    match random.below(12) {
        0 => g.neg(a),
        1 => g.unary(Unary::Sin, a),
        2 => g.unary(Unary::Cos, a),
        3 => {
            let square = g.mul(a, a);
            g.unary(Unary::Sqrt, square)
        }
        4 => g.mul(a, a),
        n => {
            let b = expression(g, random, leaves, depth - 1);
            match n {
                5 | 6 => g.add(a, b),
                7 | 8 => g.sub(a, b),
                9 | 10 => g.mul(a, b),
                _ => {
                    let (square, two) = (g.mul(b, b), g.constant(2.0));
                    let denominator = g.add(square, two);
                    g.div(a, denominator)
                }
            }
        }
    }
}

#[test]
fn every_rule_fires_and_keeps_the_value() {
    for table in TABLES {
        for rule in table.rules {
            let mut random = Random(0x9e37_79b9_7f4a_7c15);
            let mut fired = 0;
            for _ in 0..20_000 {
                let mut g = Graph::new();
                let (ids, leaves) = symbols(&mut g, 2);
                let values = [0.3 + random.unit(), 0.3 + random.unit()];
                let value = |g: &Graph, id| evaluate(g, &[id], |s| values[usize::from(s != ids[0])])[0];
                let depth = 1 + random.below(2);
                let (mut a, mut b) =
                    (expression(&mut g, &mut random, &leaves, depth), expression(&mut g, &mut random, &leaves, depth));
                match random.below(7) {
                    0 => a = g.unary(Unary::Sqrt, b),
                    1 => b = g.unary(Unary::Sqrt, a),
                    2 => a = g.div(leaves[0], b),
                    3 => _ = g.sub(b, a),
                    // of the same angle or of two
                    4 => {
                        let angles = [0, 1].map(|_| leaves[random.below(2)]);
                        a = g.unary(Unary::Sin, angles[0]);
                        a = g.mul(a, a);
                        b = g.unary(Unary::Cos, angles[1]);
                        b = g.mul(b, b);
                    }
                    _ => {}
                }
                if !matches!(table.operator, TableOperator::Binary(_)) {
                    b = a;
                }
                let nodes = cost(&g, &[a, b]).operations + 1;
                let functions = cost(&g, &[a, b]).functions + 1;
                let Some(simple) = (rule.apply)(&mut g, a, b) else {
                    continue;
                };
                let (x, y) = (value(&g, a), value(&g, b));
                let expected = match table.operator {
                    TableOperator::Binary(Operator::Add) => x + y,
                    TableOperator::Binary(Operator::Subtract) => x - y,
                    TableOperator::Binary(Operator::Multiply) => x * y,
                    TableOperator::Binary(Operator::Divide) => x / y,
                    TableOperator::Binary(_) => unreachable!("no such table"),
                    TableOperator::Negate => -x,
                    TableOperator::Sin => x.sin(),
                    TableOperator::Cos => x.cos(),
                };
                if !expected.is_finite() || (x == 0.0 && y == 0.0) {
                    continue;
                }
                fired += 1;
                let got = value(&g, simple);
                let scale = 1.0 + x.abs() + y.abs() + expected.abs();
                assert!((got - expected).abs() < 1e-12 * scale, "{}: {got} {expected}", rule.name);
                let after = cost(&g, &[simple]);
                assert!(after.operations <= nodes + 1, "{} costs more", rule.name);
                assert!(after.functions <= functions, "{} costs more", rule.name);
            }
            assert!(fired > 0, "rule `{}` never fired", rule.name);
        }
    }
}

#[test]
fn derivatives_agree_with_complex_free_differences_and_each_other() {
    let mut random = Random(42);
    for _ in 0..300 {
        let mut g = Graph::new();
        let (ids, leaves) = symbols(&mut g, 3);
        let root = expression(&mut g, &mut random, &leaves, 5);
        let at: Vec<f64> = (0..3).map(|_| 0.4 + random.unit()).collect();
        let eval = |g: &Graph, id, at: &[f64]| evaluate(g, &[id], |s| at[s.index()])[0];
        let gradient = gradient(&mut g, root, &ids);
        for (k, &symbol) in ids.iter().enumerate() {
            let direction = Direction::unit(&mut g, symbol);
            let tangent = derivatives_along(&mut g, &[root], &direction)[0];
            let (forward, reverse) = (eval(&g, tangent, &at), eval(&g, gradient[k], &at));
            if !forward.is_finite() {
                continue;
            }
            assert!((forward - reverse).abs() <= 1e-9 * (1.0 + forward.abs()));
            let step = 1e-5;
            let shifted = |by: f64| {
                let mut at = at.clone();
                at[k] += by;
                eval(&g, root, &at)
            };
            let difference = (shifted(step) - shifted(-step)) / (2.0 * step);
            assert!((forward - difference).abs() <= 1e-4 * (1.0 + forward.abs()), "{forward} {difference}");
        }
    }
}

#[test]
fn elementary_functions_differentiate() {
    let cases: [(Unary, f64, f64); 8] = [
        (Unary::Sqrt, 0.7, 0.5 / 0.7f64.sqrt()),
        (Unary::Tan, 0.7, 1.0 / (0.7f64.cos() * 0.7f64.cos())),
        (Unary::Asin, 0.3, 1.0 / (1.0 - 0.09f64).sqrt()),
        (Unary::Acos, 0.3, -1.0 / (1.0 - 0.09f64).sqrt()),
        (Unary::Exp, 0.7, 0.7f64.exp()),
        (Unary::Ln, 0.7, 1.0 / 0.7),
        (Unary::PowerInteger(-2), 0.7, -2.0 / 0.343),
        (Unary::PowerInteger(7), 0.7, 7.0 * 0.7f64.powi(6)),
    ];
    for (operator, at, expected) in cases {
        let mut g = Graph::new();
        let (ids, leaves) = symbols(&mut g, 1);
        let root = g.unary(operator, leaves[0]);
        let slope = gradient(&mut g, root, &ids)[0];
        let got = evaluate(&g, &[slope], |_| at)[0];
        assert!((got - expected).abs() < 1e-13 * expected.abs(), "{operator:?}");
    }
    let mut g = Graph::new();
    let (ids, leaves) = symbols(&mut g, 2);
    for (operator, expected) in [
        (Operator::Power, [1.3 * 0.7f64.powf(0.3), 0.7f64.powf(1.3) * 0.7f64.ln()]),
        (Operator::Atan2, [1.3 / (0.49 + 1.69), -0.7 / (0.49 + 1.69)]),
    ] {
        let root = g.binary(operator, leaves[0], leaves[1]);
        let slopes = gradient(&mut g, root, &ids);
        let got = evaluate(&g, &slopes, |s| [0.7, 1.3][s.index()]);
        for (got, expected) in got.iter().zip(expected) {
            assert!((got - expected).abs() < 1e-13, "{operator:?}");
        }
    }
}

#[test]
fn substitution_simplifies() {
    let mut g = Graph::new();
    let (ids, leaves) = symbols(&mut g, 2);
    let product = g.mul(leaves[0], leaves[1]);
    let root = g.add(product, leaves[1]);
    let zero = g.zero();
    assert_eq!(substitute(&mut g, &[root], &[(ids[0], zero)]), vec![leaves[1]]);
}

#[test]
fn rotation_about_an_axis_has_unit_columns() {
    let mut g = Graph::new();
    let (_, leaves) = symbols(&mut g, 1);
    let axis = Vector3([0.6, 0.0, 0.8].map(|x| g.constant(x)));
    let rotation = Matrix3::rotation(&mut g, axis, leaves[0]);
    let transposed = rotation.transpose();
    let product = transposed.multiply(&mut g, rotation);
    for (j, column) in product.0.iter().enumerate() {
        for (i, value) in evaluate(&g, &column.0, |_| 0.7).into_iter().enumerate() {
            assert!((value - f64::from(u8::from(i == j))).abs() < 1e-15);
        }
    }
}

/// `R S R^T` against the sum that defines it, for turns about axes between right angles, and for arbitrary rotations.
#[test]
fn rotations_turn_symmetric_matrices() {
    let mut random = Random(77);
    for case in 0..40 {
        let g = &mut Graph::new();
        let (_, leaves) = symbols(g, 8);
        let identity = Matrix3::identity(g).0;
        let quarter = g.constant(std::f64::consts::FRAC_PI_2);
        let mut rotation = Matrix3::rotation(g, identity[random.below(3)], leaves[0]);
        if case < 30 {
            for _ in 0..random.below(3) {
                let fixed = Matrix3::rotation(g, identity[random.below(3)], quarter);
                rotation = match random.below(2) {
                    0 => fixed.multiply(g, rotation),
                    _ => rotation.multiply(g, fixed),
                };
            }
        } else {
            let other = Matrix3::rotation(g, identity[random.below(3)], leaves[1]);
            rotation = rotation.multiply(g, other);
        }
        let s: [[ExprId; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| leaves[1 + (i + j) + i * j / 2]));
        let turned = rotation.turn_symmetric(g, s);
        let roots: Vec<ExprId> = rotation.0.iter().flat_map(|c| c.0).chain(s.concat()).chain(turned.concat()).collect();
        let values: Vec<f64> = leaves.iter().map(|_| random.unit() + 0.3).collect();
        let all = evaluate(g, &roots, |symbol| values[symbol.index()]);
        let r = |i: usize, j: usize| all[3 * j + i];
        for i in 0..3 {
            for j in 0..3 {
                let mut sum = 0.0;
                for k in 0..3 {
                    for l in 0..3 {
                        sum += r(i, k) * all[9 + 3 * k + l] * r(j, l);
                    }
                }
                let got = all[18 + 3 * i + j];
                assert!((got - sum).abs() < 1e-13, "case {case}, {i} {j}: {got} {sum}");
            }
        }
    }
}

/// Known savings, and random expressions: values are preserved and the cost does not grow.
#[test]
fn regrouping_keeps_values_and_saves_operations() {
    let g = &mut Graph::new();
    let (_, x) = symbols(g, 6);
    let size = |g: &Graph, roots: &[ExprId]| {
        let cost = cost(g, roots);
        cost.operations + cost.functions + cost.negations
    };
    // a b - a c
    let (ab, ac) = (g.mul(x[0], x[1]), g.mul(x[0], x[2]));
    let sum = g.sub(ab, ac);
    let regrouped = regroup(g, &[sum]);
    assert_eq!((size(g, &[sum]), size(g, &regrouped)), (3, 2));
    // (a b) c and (a d) b share a b
    let ad = g.mul(x[0], x[3]);
    let products = [g.mul(ab, x[2]), g.mul(ad, x[1])];
    let regrouped = regroup(g, &products);
    assert_eq!((size(g, &products), size(g, &regrouped)), (4, 3));

    let mut random = Random(4711);
    let mut saved = 0;
    for _ in 0..300 {
        let g = &mut Graph::new();
        let (_, leaves) = symbols(g, 5);
        let roots: Vec<ExprId> = (0..4).map(|_| expression(g, &mut random, &leaves, 6)).collect();
        let values: Vec<f64> = leaves.iter().map(|_| random.unit() + 0.5).collect();
        let regrouped = regroup(g, &roots);
        let at = |g: &Graph, roots: &[ExprId]| evaluate(g, roots, |s| values[s.index()]);
        for (one, other) in at(g, &roots).into_iter().zip(at(g, &regrouped)) {
            assert!((one - other).abs() <= 1e-9 * one.abs().max(1.0), "{one} {other}");
        }
        let (before, after) = (size(g, &roots), size(g, &regrouped));
        assert!(after <= before);
        saved += before - after;
    }
    assert!(saved > 20, "{saved}");
}

/// A value, and whether rounding alone can explain that it is not zero, with every symbol set to `x`.
fn disturbed(g: &Graph, id: ExprId, x: f64) -> (f64, bool) {
    let roots = [id];
    let evaluator = Evaluator::new(g, &roots);
    let disturbed_value = evaluator.at(1, |_| Disturbed::exact(x))[0];
    (disturbed_value.value(), disturbed_value.is_rounding(evaluator.operations()))
}

/// The rounding residue of constants that cancel cannot be recognised by its value alone.
#[test]
fn folded_constants_keep_their_rounding() {
    let g = &mut Graph::new();
    let (_, x) = symbols(g, 1);
    let [a, b, c] = [0.1, 0.2, -0.3].map(|value| g.constant(value));
    // as numbers, and as factors of the same
    let sum = g.sum([a, b, c]);
    let [p, q, r] = [a, b, c].map(|factor| g.mul(factor, x[0]));
    let product = g.sum([p, q, r]);
    let small = g.constant(5.0e-17);
    for (id, is_negligible) in [(sum, true), (product, true), (small, false), (a, false)] {
        let (value, is_rounding) = disturbed(g, id, 0.7);
        assert!(value != 0.0);
        assert_eq!(is_rounding, is_negligible, "{value}");
    }
    // the same number, but declared
    let declared = g.constant_value(sum).expect("a number");
    g.constant(declared);
    assert!(!disturbed(g, sum, 0.7).1);
}

#[test]
fn what_vanishes_by_underflow_proves_nothing() {
    let g = &mut Graph::new();
    let (_, x) = symbols(g, 1);
    let exp = g.unary(Unary::Exp, x[0]);
    let power = g.unary(Unary::PowerInteger(7), x[0]);
    assert!(!disturbed(g, exp, -1e3).1);
    assert!(!disturbed(g, power, 1e-60).1);
    assert!(disturbed(g, power, 0.0).1);
}

/// Given derivatives serve along single symbols, also after a substitution, and not along other directions.
#[test]
fn given_slopes_are_used_along_single_symbols() {
    let g = &mut Graph::new();
    let (ids, x) = symbols(g, 3);
    let square = g.mul(x[0], x[0]);
    let value = g.mul(square, x[1]);
    let marker = g.constant(7.0);
    g.set_slopes(value, vec![(x[0], marker), (x[1], square)]);
    let double = g.scale(2.0, value);
    let along = |g: &mut Graph, root, direction: &Direction| {
        let slope = derivatives_along(g, &[root], direction)[0];
        evaluate(g, &[slope], |_| 3.0)[0]
    };
    let unit = Direction::unit(g, ids[0]);
    assert_eq!(along(g, double, &unit), 14.0);
    let one = g.constant(1.0);
    let other = Direction::new("_along", vec![(ids[0], one)]);
    assert_eq!(along(g, double, &other), 36.0);
    let moved = substitute(g, &[double], &[(ids[1], x[2])])[0];
    assert_eq!(along(g, moved, &unit), 14.0);
    let unit = Direction::unit(g, ids[2]);
    assert_eq!(along(g, moved, &unit), 18.0);
    // a node that is not below the root
    let hidden = g.scale(3.0, x[0]);
    let root = g.scale(2.0, hidden);
    g.set_slopes(root, vec![(hidden, marker)]);
    let unit = Direction::unit(g, ids[0]);
    assert_eq!(along(g, root, &unit), 6.0);
}

#[test]
fn quotients_by_one_denominator_share_its_reciprocal() {
    let g = &mut Graph::new();
    let (_, x) = symbols(g, 4);
    let quotients = [0, 1, 2].map(|k| g.div(x[k], x[3]));
    let regrouped = share_reciprocals(g, &quotients);
    let cost = cost(g, &regrouped);
    assert_eq!((cost.operations, cost.functions), (3, 1));
    assert_eq!(evaluate(g, &regrouped, |_| 4.0), [1.0; 3]);
}
