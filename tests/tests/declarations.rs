//! From tokens to topology: what is read is what was written, values arrive in SI, and no input whatever panics.

use eigentol_compiler::base::diagnostics::Diagnostics;
use eigentol_compiler::base::ids::{BodyId, CoordinateId, JointId};
use eigentol_compiler::model::evaluate::evaluate;
use eigentol_compiler::model::expression::Expr;
use eigentol_compiler::model::mechanism::{Frame, Mechanism, Motion, Shape};
use eigentol_compiler::model::resolve::resolve;
use eigentol_compiler::syntax::ast::Ast;
use eigentol_compiler::syntax::parse::parse;
use eigentol_compiler::syntax::print::print;
use eigentol_compiler::topology::build::build;
use proc_macro2::{TokenStream, TokenTree};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

const DOUBLE_PENDULUM: &str = "
    /// Two uniform bars hinged in series on a shaft that spins at a constant rate.
    #[allow(dead_code)]
    pub mechanism RotatingDoublePendulum {
        /// Speed of the shaft.
        input omega: rpm;
        design m1 = 3.0 kg;
        design m2 = 3.0 kg;
        design l1 = 1.0 m +/- 3%;
        /// Length of the outer bar.
        design l2 = 1000 mm +/- 30 mm;
        let total = m1 + m2;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        point tip: bar2 at [0, 0, -l2];
        output tip_height = position(tip).z;
        output tip_radius = distance_from_axis(tip, z);
        output bend = theta2 - theta1;
    }";

/// Every item, every operator, every kind of argument; declared in an unusual order.
const EVERYTHING: &str = "
    pub(crate) mechanism Everything {
        input n: 1; input v: km/h; input f: 1/s; input g: kg/(m*s^2);
        design a = -(2 + 3) * 4 mm +/- 0.5 mm;
        design b = 3kg*m/s^2;
        design c = 5 1/s +/- 2.5%;
        design angle = 30 deg;
        design r = 0.2m;
        let late = early ^ 2 + [1, 2, 3].x * r^2;
        let early = 2 * r - 1 cm;
        let v1 = [r, 0, -r] / 2;
        let w1 = cross(v1, [1, 0, 0]) + v1 * 2;
        let s1 = -r^-2^2 * 1 m^4 + -(1 / (2 m)^2 ^ 2) * r^4;
        let t1 = atan2(r, 1 m) + atan(0.5) + norm(v1) / r + dot(v1, v1) / (r * r) + exp(ln(2));
        gravity [0, 0, -9.81] m/s^2;
        body p: point(mass: 1 kg);
        body d: disk(mass: 1 kg, radius: r, axis: [1, 0, 1], center: [0, r, 0]);
        body c1: cylinder(mass: 500 g, radius: r, length: 2 * r, axis: -y);
        body q: box(mass: 1 lb, size: [1, 2, 3] inch,);
        body s: sphere(mass: 1 t, radius: 1 ft);
        body i3: rigid(mass: 1 kg, inertia: [1, 1, 1] kg*m^2);
        body i6: rigid(mass: 1 kg, inertia: [1 kg*m^2, 1 kg*m^2, 1 kg*m^2, 0, 0.1 kg*m^2, 0], center: v1);
        joint j1: prismatic([1, 0, 1]) from ground to p
            at [0, 0, r] rotated(z, 30 deg) rotated(x, angle), at [0, 0, 1 mm] rotated(y, 5 deg) on p;
        joint j2: fixed from p to d rotated(w1, pi / 2);
        joint j3: revolute(-x) from c1 to p, at v1 on p, driven at 2 * c;
        joint j4: revolute(v1) from p to q, driven at n * f;
        joint j5: revolute(z) from q to s;
        joint j6: revolute(z) from s to i3;
        joint j7: revolute(z) from i3 to i6;
        point o: ground;
        point e: i6 at [r, 0, 0];
        force k: spring(on: j5, stiffness: 10 N*m/rad, rest: 5 deg);
        force l: damper(on: j1, damping: 0.1 N*s/m);
        force m: spring_damper(from: o, to: e, stiffness: 100 N/m, damping: 1 N*s/m, length: 0.2 m);
        output reach = distance(e, o) + 2 * r * cos(j5);
        output ratio = sin(j5) / max_ratio;
        let max_ratio = sqrt(2);
    }";

const WITHOUT_BODIES: &str = "mechanism Empty { }";

fn read(source: &str) -> Ast {
    let tokens = source.parse().expect("the source consists of Rust tokens");
    parse(tokens).unwrap_or_else(|errors| panic!("{errors}"))
}

fn resolved(source: &str) -> Mechanism {
    resolve(&read(source)).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn printing_and_parsing_gives_the_same_tree() {
    for source in [DOUBLE_PENDULUM, EVERYTHING, WITHOUT_BODIES] {
        let ast = read(source);
        let text = print(&ast);
        assert_eq!(read(&text), ast, "{text}");
        assert_eq!(print(&read(&text)), text);
    }
}

#[test]
fn the_double_pendulum_arrives_in_si() {
    let mechanism = resolved(DOUBLE_PENDULUM);
    assert_eq!(mechanism.name, "RotatingDoublePendulum");
    assert_eq!(mechanism.attributes.len(), 2);
    let input = &mechanism.inputs[0];
    assert_eq!(input.unit.symbol, "rpm");
    assert_eq!(input.unit.scale, std::f64::consts::TAU / 60.0);
    assert_eq!(input.docs, [" Speed of the shaft."]);
    let outer = &mechanism.design[3];
    assert_eq!((outer.nominal, outer.tolerance), (1.0, 0.03));
    assert_eq!((outer.unit.symbol.as_str(), outer.unit.scale), ("mm", 1e-3));
    assert_eq!(mechanism.design[2].tolerance, 0.03);
    assert_eq!(mechanism.gravity, [0.0, 0.0, -9.81].map(Expr::Number));
    assert_eq!(mechanism.coordinates.len(), 3);
    assert!(matches!(mechanism.coordinates[0].motion, Motion::Driven(_)));
    let units: Vec<&str> = mechanism
        .outputs
        .iter()
        .map(|output| output.unit.symbol.as_str())
        .collect();
    assert_eq!(units, ["m", "m", "rad"]);
    let b: Vec<f64> = mechanism
        .design
        .iter()
        .map(|design| design.nominal)
        .collect();
    let Shape::Rod { center, .. } = &mechanism.bodies[1].shape else {
        panic!("a rod");
    };
    assert_eq!(evaluate(&mechanism, &center[2], &[0.0], &b), -0.5);
    assert_eq!(
        evaluate(&mechanism, &mechanism.constants[0].value, &[0.0], &b),
        6.0
    );
}

#[test]
fn values_of_a_full_declaration() {
    let mechanism = resolved(EVERYTHING);
    let b: Vec<f64> = mechanism
        .design
        .iter()
        .map(|design| design.nominal)
        .collect();
    let u = [0.0; 4];
    assert_eq!(b[0], -0.02);
    assert_eq!(mechanism.design[0].tolerance, 5e-4);
    assert_eq!(mechanism.design[2].tolerance, 0.125);
    assert_eq!(mechanism.inputs[3].unit.symbol, "kg/(m*s^2)");
    let constant = |name: &str| {
        let constant = mechanism
            .constants
            .iter()
            .find(|constant| constant.name == name);
        evaluate(&mechanism, &constant.unwrap().value, &u, &b)
    };
    let r = 0.2;
    assert_eq!(constant("early"), 2.0 * r - 0.01);
    assert_eq!(constant("late"), constant("early").powi(2) + r * r);
    let t1 = r.atan2(1.0) + 0.5f64.atan() + 0.5f64.sqrt() + 0.5 + 2.0;
    assert!((constant("t1") - t1).abs() < 1e-14);
    let s1 = -r.powi(-4) - r.powi(4) / 16.0;
    assert!((constant("s1") - s1).abs() < 1e-9, "{}", constant("s1"));
    // Earlier ones first, whatever the order of declaration.
    let order: Vec<String> = mechanism
        .constants
        .iter()
        .map(|c| c.name.to_string())
        .collect();
    let place = |name: &str| order.iter().position(|other| other == name).unwrap();
    assert!(place("early") < place("late"));
    let joint = &mechanism.joints[0];
    assert_eq!(joint.from_placement.rotations.len(), 2);
    assert_eq!(joint.to_placement.offset[2], Expr::Number(1e-3));
}

#[test]
fn the_forest_visits_parents_first() {
    let mechanism = resolved(EVERYTHING);
    let topology = build(&mechanism).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(topology.branches.len(), mechanism.bodies.len());
    let mut seen = vec![Frame::Ground];
    for branch in &topology.branches {
        assert!(seen.contains(&branch.parent));
        seen.push(Frame::Body(branch.body));
    }
    let reversed: Vec<JointId> = topology
        .branches
        .iter()
        .filter(|branch| branch.reversed)
        .map(|branch| branch.joint)
        .collect();
    assert_eq!(reversed, [JointId(2)]);
    assert_eq!(topology.driven, [CoordinateId(1), CoordinateId(2)]);
    assert_eq!(topology.free.len(), 4);
    assert_eq!(topology.branches[0].body, BodyId(0));
}

/// Runs the front half; counts what got how far.
fn survive(tokens: TokenStream, stages: &mut [usize; 3]) {
    let report = |errors: Diagnostics| assert!(!errors.into_compile_errors().is_empty());
    let ast = match parse(tokens) {
        Ok(ast) => ast,
        Err(errors) => return report(errors),
    };
    stages[0] += 1;
    let text = print(&ast);
    assert_eq!(read(&text), ast, "{text}");
    let mechanism = match resolve(&ast) {
        Ok(mechanism) => mechanism,
        Err(errors) => return survived(errors),
    };
    stages[1] += 1;
    match build(&mechanism) {
        Ok(_) => stages[2] += 1,
        Err(errors) => survived(errors),
    }
}

fn survived(errors: Diagnostics) {
    for diagnostic in errors.iter() {
        assert!(
            !diagnostic.message.contains("bug of eigentol"),
            "{diagnostic:?}"
        );
        assert!(
            !diagnostic.text().contains("does not know why"),
            "{diagnostic:?}"
        );
    }
    assert!(!errors.into_compile_errors().is_empty());
}

/// Deletes, repeats and exchanges single tokens at any depth.
fn mutate(tokens: TokenStream, random: &mut ChaCha8Rng, pool: &[TokenTree]) -> TokenStream {
    let mut result = Vec::new();
    for token in tokens {
        let token = match token {
            TokenTree::Group(group) => {
                let mut inner = proc_macro2::Group::new(
                    group.delimiter(),
                    mutate(group.stream(), random, pool),
                );
                inner.set_span(group.span());
                TokenTree::Group(inner)
            }
            other => other,
        };
        match random.next_u32() % 400 {
            0 => {}
            1 => result.extend([token.clone(), token]),
            2 | 3 => result.push(pool[random.next_u32() as usize % pool.len()].clone()),
            _ => result.push(token),
        }
    }
    result.into_iter().collect()
}

fn flat(tokens: TokenStream, pool: &mut Vec<TokenTree>) {
    for token in tokens {
        if let TokenTree::Group(group) = &token {
            flat(group.stream(), pool);
        }
        pool.push(token);
    }
}

#[test]
fn mutated_declarations_are_refused_or_compiled_but_never_panic() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut pool = Vec::new();
    for source in [DOUBLE_PENDULUM, EVERYTHING] {
        flat(source.parse().unwrap(), &mut pool);
    }
    let mut stages = [0; 3];
    for round in 0..1500 {
        let source = [DOUBLE_PENDULUM, EVERYTHING][round % 2];
        let tokens = mutate(source.parse().unwrap(), &mut random, &pool);
        survive(tokens, &mut stages);
    }
    // Mutations that are all caught by the parser would test nothing behind it.
    assert!(stages.iter().all(|&count| count > 20), "{stages:?}");
}

#[test]
fn token_soup_is_refused() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let mut pool = Vec::new();
    flat(EVERYTHING.parse().unwrap(), &mut pool);
    for _ in 0..500 {
        let soup: TokenStream = (0..40)
            .map(|_| pool[random.next_u32() as usize % pool.len()].clone())
            .collect();
        let inside = quote_mechanism(soup.clone());
        survive(soup, &mut [0; 3]);
        survive(inside, &mut [0; 3]);
    }
}

fn quote_mechanism(items: TokenStream) -> TokenStream {
    let mut tokens: TokenStream = "mechanism Soup".parse().expect("two words");
    let braces = proc_macro2::Group::new(proc_macro2::Delimiter::Brace, items);
    tokens.extend([TokenTree::Group(braces)]);
    tokens
}

#[test]
fn huge_expressions_are_refused_not_overflowed() {
    let deep = format!("{}1{}", "(".repeat(300), ")".repeat(300));
    let long = vec!["1"; 100_000].join(" + ");
    let signs = format!("{}1", "-".repeat(5000));
    let powers = vec!["1"; 5000].join(" ^ ");
    let components = format!("a{}", ".x".repeat(5000));
    let mixed = (0..60).fold("1".to_string(), |inner, _| {
        format!("({inner}{})", " + 1".repeat(250))
    });
    for value in [deep, long, signs, powers, components, mixed] {
        let source = format!("mechanism M {{ let a = {value}; }}");
        let errors = parse(source.parse().unwrap()).expect_err("too large");
        assert!(
            errors
                .iter()
                .all(|error| error.message.contains("too large"))
        );
    }
    let chain: String = (0..20_000)
        .map(|index| format!("let a{index} = a{} + 1;", index + 1))
        .collect();
    let source = format!(
        "mechanism M {{ {chain} let a20000 = 1; body b: massless; joint j: revolute(z) from ground to b; }}"
    );
    assert_eq!(resolved(&source).constants.len(), 20_001);
}

/// The code blocks of a page, with the language of their fence.
fn code_blocks(page: &str) -> Vec<(&str, &str)> {
    let mut blocks = Vec::new();
    for (index, part) in page.split("```").enumerate() {
        if index % 2 == 1 {
            blocks.push(part.split_once('\n').expect("a fence ends its line"));
        }
    }
    blocks
}

#[test]
fn the_reference_page_is_right() {
    let page = include_str!("../../macros/REFERENCE.md");
    let mut declarations = 0;
    for (language, text) in code_blocks(page) {
        if language == "text" {
            read(&format!("mechanism Fragment {{ {text} }}"));
            continue;
        }
        let (_, inside) = text.split_once("mechanism! {").expect("a declaration");
        let (declaration, _) = inside.rsplit_once('}').expect("a closing brace");
        let mechanism = resolved(declaration);
        build(&mechanism).unwrap_or_else(|errors| panic!("{errors}"));
        declarations += 1;
    }
    assert_eq!(declarations, 2);
}
