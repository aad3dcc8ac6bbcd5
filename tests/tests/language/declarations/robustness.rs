//! No input causes a panic, and none is refused without a reason.

use eigentol_compiler::base::diagnostics::Diagnostics;
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::model::resolve::resolve;
use eigentol_compiler::syntax::parse::parse;
use eigentol_compiler::syntax::print::print;
use eigentol_compiler::topology::build::build;
use proc_macro2::{TokenStream, TokenTree};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::common::{CLOSED_MECHANISM, DOUBLE_PENDULUM, EVERYTHING, OPEN_MECHANISM, TOLERANCES, read, resolved};

const FUZZED: [&str; 5] = [DOUBLE_PENDULUM, EVERYTHING, OPEN_MECHANISM, CLOSED_MECHANISM, TOLERANCES];

/// Runs the front half of the compiler; counts how many inputs reach each stage.
fn survive(tokens: TokenStream, stages: &mut [usize; 3]) {
    let report = |errors: Diagnostics| assert!(!errors.into_compile_errors().is_empty());
    let ast = match parse(tokens.clone()) {
        Ok(ast) => ast,
        Err(errors) => {
            let syntax = errors.len();
            report(errors);
            // The later stages process whatever could be read.
            let all = compile(tokens, Limits::default()).expect_err("a syntax error");
            assert!(all.len() >= syntax);
            return survived(all);
        }
    };
    stages[0] += 1;
    let text = print(&ast);
    assert_eq!(read(&text), ast, "{text}");
    let mechanism = match resolve(&ast) {
        Ok(mechanism) => mechanism,
        Err(errors) => return survived(errors),
    };
    stages[1] += 1;
    assert!(format!("{mechanism:?}").starts_with("Mechanism"));
    match build(&mechanism) {
        Ok(topology) => {
            stages[2] += 1;
            assert!(topology.describe(&mechanism).starts_with("ground"));
        }
        Err(errors) => survived(errors),
    }
}

fn survived(errors: Diagnostics) {
    for diagnostic in errors.iter() {
        assert!(!diagnostic.message.contains("bug of eigentol"), "{diagnostic:?}");
        assert!(!diagnostic.text().contains("does not know why"), "{diagnostic:?}");
    }
    assert!(!errors.into_compile_errors().is_empty());
}

/// Deletes, repeats and exchanges single tokens at any depth.
fn mutate(tokens: TokenStream, random: &mut ChaCha8Rng, pool: &[TokenTree]) -> TokenStream {
    let mut result = Vec::new();
    for token in tokens {
        let token = match token {
            TokenTree::Group(group) => {
                let mut inner = proc_macro2::Group::new(group.delimiter(), mutate(group.stream(), random, pool));
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
    mutations_are_survived(300);
}

#[test]
#[ignore = "ten seconds"]
fn many_mutated_declarations_are_refused_or_compiled_but_never_panic() {
    mutations_are_survived(2000);
}

fn mutations_are_survived(rounds: usize) {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut pool = Vec::new();
    for source in FUZZED {
        flat(source.parse().expect("tokens"), &mut pool);
    }
    let mut stages = [0; 3];
    for round in 0..rounds {
        let source = FUZZED[round % FUZZED.len()];
        let tokens = mutate(source.parse().expect("tokens"), &mut random, &pool);
        survive(tokens, &mut stages);
    }
    // Mutations that are all caught by the parser would test nothing beyond it.
    assert!(stages.iter().all(|&count| 50 * count > rounds), "{stages:?}");
}

#[test]
fn token_soup_is_refused() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let mut pool = Vec::new();
    for source in FUZZED {
        flat(source.parse().unwrap(), &mut pool);
    }
    for _ in 0..500 {
        let soup: TokenStream = (0..40).map(|_| pool[random.next_u32() as usize % pool.len()].clone()).collect();
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
    let mixed = (0..60).fold("1".to_string(), |inner, _| format!("({inner}{})", " + 1".repeat(250)));
    for value in [deep, long, signs, powers, components, mixed] {
        let source = format!("mechanism M {{ let a = {value}; }}");
        let errors = parse(source.parse().unwrap()).expect_err("too large");
        assert!(errors.iter().all(|error| error.message.contains("too large")));
    }
    let chain: String = (0..20_000).map(|index| format!("let a{index} = a{} + 1;", index + 1)).collect();
    let source =
        format!("mechanism M {{ {chain} let a20000 = 1; body b: massless; joint j: revolute(z) from ground to b; }}");
    assert_eq!(resolved(&source).constants.len(), 20_001);
}
