//! The language accepts the snippets in the tables of the chapter "How to declare what".
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use eigentol_interpreter::Interpreted;

const CHAPTER: &str = include_str!("../src/declare.md");

/// Numbers and bodies that the snippets refer to.
const BEGIN: &str = "part Bearing(stiffness: N/m) { port seat; let half = stiffness / 2; }
mechanism Part {
    kernels only;
    design l = 1 m; design l0 = 1 m; design length = 3 m; design r = 0.1 m; design e = 10 mm;
    design k = 1 kN/m; design c = 1 N*s/m; design kxy = 1 kN/m; design r1 = 0.1 m; design r2 = 0.2 m;
    design kx = 1 kN/m; design ky = 1 kN/m; design cx = 1 N*s/m; design cy = 1 N*s/m;
    design za = 20; design zb = 40; design zs = 20; design zr = 60; design tilt = 0.001;
    design stall = 3 N*m; design drop = 0.1 N*m*s; design radius = 0.1 m;
    body fork: sphere(mass: 1 kg, radius: 0.1 m);
    body arm: sphere(mass: 1 kg, radius: 0.1 m);
    body cart: sphere(mass: 1 kg, radius: 0.1 m);
    body rotor: sphere(mass: 1 kg, radius: 0.1 m);
    point p: fork at [0.3, 0, 0] m; point q: arm; point d: cart;
    point tip: arm at [0.1, 0, 0] m; point nozzle: arm; point center: arm at [0.2, 0, 0] m;
    point rail: fork; point pin: arm; point road: ground; point seat: ground; point journal: rotor; point hub: rotor;";

/// Unconnected bodies.
fn free(bodies: &[&str]) -> String {
    let joint = |b: &&str| {
        format!(
            "joint {b}_flight: free({b}_x: x, {b}_y: y, {b}_z: z, {b}_a: x, {b}_b: y, {b}_c: z) from ground to {b};"
        )
    };
    bodies.iter().map(joint).collect()
}

/// Hinges and sliders with the names used in the snippets.
const HINGES: &str = "
    joint a: revolute(y) from ground to fork;
    joint b: revolute(y) from ground to arm;
    joint x: prismatic(x) from ground to cart;
    joint y: prismatic(y) from cart to rotor;";

/// Running joints.
const GEARS: &str = "
    joint sun: revolute(z) from ground to fork, coasting;
    joint ring: revolute(z) from ground to arm, coasting;
    joint carrier: revolute(z) from ground to cart, coasting;
    joint spin: revolute(z) from ground to rotor, coasting;";

/// A cam and its follower.
const CAM: &str = "
    joint turn: revolute(y) from ground to fork;
    joint lift: prismatic(z) from ground to arm;
    joint rest: fixed from ground to cart;
    joint rest2: fixed from ground to rotor;";

/// A complete declaration around a snippet.
fn declaration(snippet: &str) -> String {
    let all = free(&["fork", "arm", "cart", "rotor"]);
    let others = free(&["fork", "arm", "cart"]);
    let within = match snippet.split(['(', ' ']).next().unwrap_or_default() {
        "joint" => free(&["fork", "cart", "rotor"]) + snippet,
        "free" => format!("{others} joint own: {snippet};"),
        "revolute" | "prismatic" | "cylindrical" | "spherical" | "universal" | "screw" | "planar" => {
            format!("{others} joint own: {snippet} from ground to rotor;")
        }
        "use" => format!("{all} {snippet}"),
        "constraint" if snippet.contains("willis") => format!("{GEARS} {snippet}"),
        "constraint" if snippet.contains("cam:") => format!("{CAM} {snippet}"),
        "constraint" if !snippet.contains("coupling") => format!("{all} {snippet}"),
        "force" if snippet.contains("spin") => format!("{GEARS} {snippet}"),
        "constraint" | "force" | "every" | "curve" => format!("{HINGES} {snippet}"),
        _ if snippet.contains("on: ") => format!("{HINGES} force own: {snippet};"),
        _ => format!("{all} force own: {snippet};"),
    };
    format!("{BEGIN} {within} }}")
}

/// Snippets of declarations in the tables of the chapter.
fn snippets() -> Vec<&'static str> {
    let tables = CHAPTER.split("# Names of quantities").next().unwrap();
    let rows = tables.lines().filter(|line| line.starts_with("| "));
    let codes = rows.flat_map(|row| row.split('`').skip(1).step_by(2));
    let piece = |code: &&str| code.contains('(') || code.starts_with("curve ");
    codes.filter(|code| piece(code) && !code.contains("..")).collect()
}

#[test]
fn what_the_tables_say_can_be_declared() {
    let snippets = snippets();
    assert!(snippets.len() > 20, "{snippets:?}");
    for snippet in snippets {
        let text = declaration(snippet);
        if let Err(error) = Interpreted::from_text(&text) {
            panic!("`{snippet}`: {error}\n{text}");
        }
    }
}

#[test]
fn the_check_can_fail() {
    let text = declaration("spring(on: a, stifness: k)");
    let error = Interpreted::from_text(&text).unwrap_err();
    assert!(error.to_string().contains("stifness"), "{error}");
}
