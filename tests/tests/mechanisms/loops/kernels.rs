//! The equations alone, without the runtime: at the file's equilibria they are satisfied with one set of reactions, the
//! bordered pencil is singular at the file's eigenvalues, and its derivatives match the file's.

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_compiler::program::Program;
use eigentol_consistency::interpreter::interpret_along;
use nalgebra::{Complex, DMatrix, DVector};

use super::common::{Case, LOOPS, Point, assert_close, assert_near, complex};

/// `Mhat`, `Chat`, `Khat` or a derivative of them.
struct Linear([DMatrix<f64>; 3]);

impl Linear {
    fn at(&self, s: Complex<f64>) -> DMatrix<Complex<f64>> {
        let [mass, damping, stiffness] = &self.0;
        let part = |matrix: &DMatrix<f64>, factor| matrix.map(|x| factor * x);
        part(mass, s * s) + part(damping, s) + part(stiffness, Complex::ONE)
    }
}

struct Loop {
    program: Program,
    /// Names of the unknowns, and whether each is a reaction.
    unknowns: Vec<(String, bool)>,
    outputs: Vec<String>,
    design: Vec<(String, f64)>,
}

impl Loop {
    fn new(declaration: &str) -> Self {
        let tokens = declaration.parse().expect("tokens");
        let found = compile(tokens, Limits::default()).unwrap_or_else(|mistakes| {
            panic!("{mistakes}\n{declaration}");
        });
        let unknowns = found.functions.unknowns.iter().map(|unknown| {
            let is_reaction = !matches!(unknown.role, Role::Position(_) | Role::Speed(_));
            (unknown.name.clone(), is_reaction)
        });
        let design = found.mechanism.design.iter();
        Self {
            unknowns: unknowns.collect(),
            outputs: found.mechanism.outputs.iter().map(|output| output.name.to_string()).collect(),
            design: design.map(|one| (one.name.to_string(), one.nominal)).collect(),
            program: found.program,
        }
    }

    fn evaluate(&self, kernel: &str, arguments: &[&[f64]]) -> Vec<Vec<f64>> {
        self.program.evaluate(kernel, arguments).unwrap_or_else(|| panic!("there is a kernel {kernel}"))
    }

    fn linear(&self, at: &[&[f64]; 3]) -> Linear {
        self.matrices(&self.evaluate("linear", at))
    }

    fn linear_along(&self, at: &[&[f64]; 3], direction: &[&[f64]; 3]) -> Linear {
        let kernel = self.program.kernel("linear").expect("in the contract");
        self.matrices(&interpret_along(kernel, at, direction))
    }

    fn matrices(&self, arrays: &[Vec<f64>]) -> Linear {
        let n = self.unknowns.len();
        Linear(std::array::from_fn(|k| DMatrix::from_row_slice(n, n, &arrays[k])))
    }

    /// The file's coordinates, and the reactions that hold them: the rest of the residual must vanish.
    fn unknowns_at(&self, point: &Point, u: &[f64], b: &[f64]) -> DVector<f64> {
        let coordinates = point.truth.get("coordinates");
        let mut x = DVector::from_fn(self.unknowns.len(), |i, _| match &self.unknowns[i] {
            (name, false) => coordinates.get(name).number(),
            _ => 0.0,
        });
        let arrays = self.evaluate("residual_and_stiffness", &[x.as_slice(), u, b]);
        let residual = DVector::from_column_slice(&arrays[0]);
        let n = x.len();
        let stiffness = DMatrix::from_row_slice(n, n, &arrays[1]);
        let reactions: Vec<usize> = (0..n).filter(|&i| self.unknowns[i].1).collect();
        let columns = stiffness.select_columns(&reactions);
        let size = columns.amax();
        let held = columns.svd(true, true).solve(&-&residual, 1e-12 * size).expect("vectors were asked for");
        for (&reaction, value) in reactions.iter().zip(held.iter()) {
            x[reaction] = *value;
        }
        let arrays = self.evaluate("residual", &[x.as_slice(), u, b]);
        let terms = residual.amax().max(1.0);
        for (i, rest) in arrays[0].iter().enumerate() {
            let (what, name) = (&point.what, &self.unknowns[i].0);
            assert!(rest.abs() <= 1e-12 * terms, "{what}: the equation of {name} is off by {rest:e}");
        }
        x
    }
}

/// The right and left vectors of the smallest singular value.
fn null(matrix: &DMatrix<Complex<f64>>) -> [DVector<Complex<f64>>; 2] {
    let svd = matrix.clone().svd(true, true);
    let place = svd.singular_values.imin();
    let right = svd.v_t.expect("right vectors").row(place).adjoint();
    let left = svd.u.expect("left vectors").column(place).conjugate();
    [right, left]
}

/// `Khat^-1` applied to a vector, also where rows may depend on each other.
fn solve(matrix: &DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let size = matrix.amax();
    let svd = matrix.clone().svd(true, true);
    svd.solve(right, 1e-13 * size).expect("vectors were asked for")
}

fn check_point(machine: &Loop, case: &Case, point: &Point) {
    let (u, b) = ([point.input], &case.design[..]);
    let x = machine.unknowns_at(point, &u, b);
    let n = x.len();
    let at = [x.as_slice(), &u, b];
    let linear = machine.linear(&at);
    let partials = machine.evaluate("residual_partials", &[x.as_slice(), &u, b]);

    // How the unknowns move with each variable.
    let variables = case.variables.len();
    let moved: Vec<DVector<f64>> = (0..variables)
        .map(|j| {
            let column = DVector::from_fn(n, |i, _| match j.checked_sub(b.len()) {
                None => partials[1][i * b.len() + j],
                Some(input) => partials[0][i * u.len() + input],
            });
            solve(&linear.0[2], &-column)
        })
        .collect();
    for (i, (name, is_reaction)) in machine.unknowns.iter().enumerate() {
        for (j, variable) in case.variables.iter().enumerate() {
            if *is_reaction {
                continue;
            }
            let what = format!("{}: {name} by {variable}", point.what);
            let slopes = point.truth.get("coordinates_by").get(name);
            let expected = slopes.get(variable).number();
            assert_close(moved[j][i], expected, point.scale(1.0, &[j]), &what);
        }
    }

    let units = |count: usize, index: Option<usize>| -> Vec<f64> {
        (0..count).map(|i| f64::from(u8::from(Some(i) == index))).collect()
    };
    let along: Vec<[Vec<f64>; 3]> = (0..variables)
        .map(|j| {
            let design = (j < b.len()).then_some(j);
            let input = j.checked_sub(b.len());
            let dx = moved[j].as_slice().to_vec();
            [dx, units(1, input), units(b.len(), design)]
        })
        .collect();

    for (r, mode) in point.modes().iter().enumerate() {
        let s = complex(&mode.get("s"));
        let what = format!("{}: mode {r}", point.what);
        let pencil = linear.at(s);
        let [right, left] = null(&pencil);
        // d/ds (s^2 M + s C + K)
        let [mass, damping, _] = &linear.0;
        let slope = mass.map(|x| 2.0 * s * x) + damping.map(Complex::from);
        let norm = left.dot(&(slope * &right));
        let off = left.dot(&(&pencil * &right)) / norm;
        assert_near(s - off, s, 0.0, &what);
        for (j, variable) in case.variables.iter().enumerate() {
            let [dx, du, db] = &along[j];
            let rate = machine.linear_along(&at, &[dx, du, db]);
            let found = -left.dot(&(rate.at(s) * &right)) / norm;
            let expected = complex(&mode.get("s_by").get(variable));
            let what = format!("{what} by {variable}");
            assert_near(found, expected, point.scale(s.norm(), &[j]), &what);
        }
    }
    check_outputs(machine, case, point, x.as_slice(), &along);
}

fn check_outputs(machine: &Loop, case: &Case, point: &Point, x: &[f64], along: &[[Vec<f64>; 3]]) {
    let (u, b) = ([point.input], &case.design[..]);
    let values = &machine.evaluate("outputs", &[x, &u, b])[0];
    let partials = machine.evaluate("output_partials", &[x, &u, b]);
    let truth = |field: &str| point.truth.get(field);
    let names = truth("outputs").fields();
    assert_eq!(names.len(), machine.outputs.len(), "{}", point.what);
    for (k, name) in machine.outputs.iter().enumerate() {
        let what = format!("{}: {name}", point.what);
        let expected = truth("outputs").get(name).number();
        assert_close(values[k], expected, 1e-2, &what);
        let size = expected.abs().max(1e-2);
        for (j, variable) in case.variables.iter().enumerate() {
            let value: f64 = (0..3)
                .map(|kind| {
                    let direction = &along[j][kind];
                    let row = &partials[kind][k * direction.len()..][..direction.len()];
                    row.iter().zip(direction).map(|(slope, step)| slope * step).sum::<f64>()
                })
                .sum();
            let expected = truth("outputs_by").get(name).get(variable).number();
            let what = format!("{what} by {variable}");
            assert_close(value, expected, point.scale(size, &[j]), &what);
        }
    }
}

#[test]
fn equations_hold_in_minimal_coordinates() {
    for (name, declaration) in LOOPS {
        let machine = Loop::new(declaration);
        let case = Case::new(name);
        let design: Vec<String> = machine.design.iter().map(|one| one.0.clone()).collect();
        assert_eq!(design, case.variables[..design.len()], "{name}");
        for (value, expected) in machine.design.iter().zip(&case.design) {
            assert!((value.1 - expected).abs() <= 1e-15 * expected.abs(), "{value:?}");
        }
        for point in case.points() {
            check_point(&machine, &case, &point);
        }
    }
}

/// One reaction per equation: unknowns other than reactions, minus equations, give the freedom in the file, plus one
/// per independent speed.
#[test]
fn freedom_is_that_of_the_minimal_coordinates() {
    for (name, declaration) in LOOPS {
        let machine = Loop::new(declaration);
        let case = Case::new(name);
        let reactions = machine.unknowns.iter().filter(|one| one.1).count();
        let independent = machine.unknowns.len() - 2 * reactions;
        let freedom = case.truth.get("freedom").number() as usize;
        let speeds = usize::from(name == "geared_motor");
        assert_eq!(independent, freedom + speeds, "{name}");
    }
}

/// A comparison that cannot fail proves nothing: another length must be noticed.
#[test]
fn another_length_is_another_mechanism() {
    let case = Case::new("four_bar_open");
    let machine = Loop::new(LOOPS[4].1);
    let point = &case.points()[1];
    let mut design = case.design.clone();
    design[1] *= 1.0 + 1e-6;
    let arguments: [&[f64]; 3] = [
        &machine
            .unknowns
            .iter()
            .map(|(name, is_reaction)| match is_reaction {
                true => 0.0,
                false => point.truth.get("coordinates").get(name).number(),
            })
            .collect::<Vec<_>>(),
        &[point.input],
        &design,
    ];
    let residual = &machine.evaluate("residual", &arguments)[0];
    let equations = machine.unknowns.iter().zip(residual);
    let gap = equations.filter(|(unknown, _)| unknown.1).fold(0.0_f64, |most, (_, gap)| most.max(gap.abs()));
    assert!(gap > 1e-8, "{gap:e}");
}
