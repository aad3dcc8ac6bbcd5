//! The text of reports: numbers match the results, names stay names, and nothing is dropped silently.

use eigentol::{InDeclaredUnit, Study, mechanism};
use eigentol_interpreter::Interpreted;
use eigentol_report::{Error, Report, Style};
use serde_json::Value;

mechanism! {
    mechanism Pendulum {
        input  omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin:  revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        output angle = theta;
    }
}

fn swinging() -> Study<Pendulum> {
    Study::new(Pendulum).input(Pendulum::omega, 5.0).start(Pendulum::theta, 1.0).samples(500).seed(3)
}

/// The data blocks of one kind, in order.
fn data(html: &str, kind: &str) -> Vec<Value> {
    let start = format!("<script type=\"application/json\" data-kind=\"{kind}\">");
    let pieces = html.split(&start).skip(1);
    pieces
        .map(|rest| {
            let (json, _) = rest.split_once("</script>").expect("a script ends");
            serde_json::from_str(json).expect("JSON")
        })
        .collect()
}

fn table(html: &str, name: &str) -> Value {
    let mut all = data(html, "table").into_iter();
    all.find(|x| x["name"] == name).unwrap_or_else(|| panic!("no table `{name}`"))
}

fn column(table: &Value, name: &str) -> Vec<Option<f64>> {
    let columns = table["columns"].as_array().expect("columns");
    let column = columns.iter().find(|column| column["name"] == name);
    let own = column.unwrap_or_else(|| panic!("no column `{name}` in {table}"));
    let values = own["values"].as_array().expect("values");
    values.iter().map(Value::as_f64).collect()
}

/// The visible text of a page.
fn words(html: &str) -> String {
    let page = html.split("<main>").nth(1).expect("a page");
    let mut text = String::new();
    for piece in page.split("<script").map(|values| values.split_once("</script>").map_or(values, |pair| pair.1)) {
        for part in piece.split('<').filter_map(|values| values.split_once('>')) {
            text += part.1;
            text.push(' ');
        }
    }
    text
}

#[test]
fn tables_have_the_numbers_of_the_results_bit_by_bit() {
    let study = swinging();
    let html = Report::new(&study).html().unwrap();
    let state = study.equilibrium().unwrap();
    let solution = study.modes().unwrap();
    let modes = table(&html, "modes");
    assert_eq!(column(&modes, "frequency"), [solution.modes[0].frequency()]);
    let equilibrium = table(&html, "equilibrium");
    let coordinates: Vec<_> = state.coordinates.iter().copied().map(Some).collect();
    assert_eq!(column(&equilibrium, "value"), coordinates);
    let first = study.first_order().unwrap();
    let sigma = first.modes[0].frequency().map(|x| x.sigma);
    assert_eq!(column(&table(&html, "summary"), "sigma, first order"), [sigma]);
    assert_eq!(column(&table(&html, "shares"), "mode 1"), [Some(0.0), Some(100.0)]);
    let sampled = study.monte_carlo().unwrap();
    let mean = sampled.modes[0].as_ref().map(|mode| mode.mean);
    assert_eq!(column(&table(&html, "Monte Carlo"), "mean of frequency"), [mean]);
    let spread = study.output_tolerances().unwrap();
    assert_eq!(column(&table(&html, "output tolerances"), "mean"), [Some(spread.values[0])]);
}

#[test]
fn the_table_of_variables_has_values_and_tolerances_in_their_units() {
    let study = swinging().design(Pendulum::l, 1.2).tolerance(Pendulum::omega, 0.1);
    let variables = table(&Report::new(&study).html().unwrap(), "variables");
    assert_eq!(column(&variables, "value"), [Some(5.0), Some(3.0), Some(1.2)]);
    let half: Vec<Option<f64>> = column(&variables, "half-width");
    assert!((half[0].unwrap() - 0.1).abs() < 1e-15 && half[1].is_none());
    assert!((half[2].unwrap() - 0.03).abs() < 1e-15, "{half:?}");
}

/// The charts are the figures of the crate eigentol-figures, which has its own tests for their numbers.
#[test]
fn charts_are_the_figures_of_the_results() {
    let study = swinging();
    let values = [3.0, 4.0, 5.0, 6.0];
    let html = Report::new(&study).sweep(Pendulum::omega, &values).orders(&[1.0]).html().unwrap();
    let figures = data(&html, "figure");
    let titles: Vec<&str> = figures.iter().filter_map(|figure| figure["title"].as_str()).collect();
    for wanted in ["Branches of equilibria", "Campbell diagram"] {
        assert!(titles.contains(&wanted), "{titles:?}");
    }
    let campbell = study.campbell(Pendulum::omega, &values, &[1.0]).unwrap();
    let expected =
        eigentol_figures::campbell(&campbell, &eigentol_figures::Style::of(&study).title("Campbell diagram"));
    let expected = serde_json::to_value(expected.unwrap()).unwrap();
    assert!(figures.contains(&expected));
}

#[test]
fn modes_are_called_and_measured_as_the_user_says() {
    let study = swinging();
    let omega = study.modes().unwrap().modes[0].frequency().unwrap();
    let page = |style: Style| {
        let report = Report::new(&study).style(style);
        report.sweep(Pendulum::omega, &[4.5, 5.0, 5.5]).html().unwrap()
    };
    let named = page(Style::default().name_mode(0, "swing").hertz());
    let hertz = format!("{:.4}", omega / std::f64::consts::TAU);
    assert!(words(&named).contains(&format!("Swing at {hertz}")), "{hertz}");
    let scene = &data(&named, "scene")[0];
    let title = scene["motions"][0]["title"].as_str().unwrap();
    assert!(title.starts_with(&format!("Swing: {hertz}")) && title.ends_with(" Hz"), "{title}");
    for figure in data(&named, "figure") {
        let text = figure.to_string();
        assert!(!text.contains("mode 1") && !text.contains("rad/s]"), "{text}");
    }
    let plain = page(Style::default());
    assert!(words(&plain).contains(&format!("Mode 1 at {omega:.5}")));
    // Tables keep plain numbers and rad/s.
    assert_eq!(column(&table(&named, "modes"), "frequency"), [Some(omega)]);
}

#[test]
fn the_view_in_3d_has_every_body_and_the_poses_of_every_mode() {
    let study = swinging();
    let scenes = data(&Report::new(&study).html().unwrap(), "scene");
    let [view] = &scenes[..] else { panic!("{} views", scenes.len()) };
    let bodies = view["scene"]["bodies"].as_array().unwrap();
    let names: Vec<_> = bodies.iter().map(|body| body["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["shaft", "bar"]);
    let frames = view["motions"][0]["frames"].as_array().unwrap();
    let expected = study.mode_pictures(0, frames.len(), 0.12).unwrap();
    for (frame, poses) in frames.iter().zip(&expected.frames) {
        let numbers: Vec<f64> = frame.as_array().unwrap().iter().filter_map(Value::as_f64).collect();
        let all = poses.iter().flat_map(|pose| pose.position.into_iter().chain(pose.rotation.into_iter().flatten()));
        let all: Vec<f64> = all.collect();
        assert_eq!(numbers.len(), all.len());
        assert!(numbers.iter().zip(&all).all(|(a, b)| (a - b).abs() <= 1e-4), "{numbers:?}\n{all:?}");
    }
}

/// A text that tries to break out of its surroundings.
const ATTACK: &str = "</script></title><script>alert('x')</script><img src=x onerror=alert(1)>\" ' & <!--";

#[test]
fn words_from_outside_never_become_markup() {
    let study = swinging();
    let plain = Report::new(&study).title("t").declaration("d").html().unwrap();
    let attacked = Report::new(&study).title(ATTACK).declaration(ATTACK).html().unwrap();
    for mark in ["<script", "</script", "<img", "<title", "</title", "<!--", "onerror=alert(1)>"] {
        let count = |html: &str| html.matches(mark).count();
        assert_eq!(count(&plain), count(&attacked), "{mark}");
    }
    assert!(attacked.contains("&lt;/script&gt;&lt;/title&gt;"));
}

#[test]
fn nothing_is_loaded_from_anywhere() {
    let html = Report::new(&swinging()).html().unwrap();
    for mark in ["src=", "@import", "url(http", "<link", "fetch(", "import("] {
        assert!(!html.contains(mark), "{mark}");
    }
    // Names of XML namespaces are not addresses.
    let addresses = html.matches("http").count();
    let known = html.matches("http://www.w3.org/2000/svg").count() + html.matches("http-equiv").count();
    assert_eq!(addresses, known);
}

#[test]
fn what_there_is_not_is_said_in_its_place() {
    let study = swinging().relative_tolerance(Pendulum::l, 0.0);
    let text = words(&Report::new(&study).html().unwrap());
    assert_eq!(text.matches("No variable has a tolerance").count(), 4, "{text}");
    assert!(text.contains("No sweep was asked for."));
}

#[test]
fn an_unstable_equilibrium_is_said_and_shown() {
    let declaration = "mechanism UpsideDown { design m = 1 kg +/- 1%; gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: m, length: 1 m, along: z);
        joint theta: revolute(y) from ground to bar; }";
    let study = Study::new(Interpreted::from_text(declaration).unwrap()).policy(eigentol::Policy::Nearest).samples(64);
    let html = Report::new(&study).html().unwrap();
    let text = words(&html);
    assert!(text.contains("The equilibrium is unstable in one direction (divergence)"), "{text}");
    assert!(text.contains("Mode 1 does not oscillate"), "{text}");
    assert_eq!(data(&html, "scene").len(), 1);
}

#[test]
fn no_equilibrium_is_said_in_every_section() {
    // Gravity holds at most 4.9 N*m.
    let declaration = "mechanism Overloaded { design m = 1 kg +/- 1%; gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: m, length: 1 m, along: -z);
        joint theta: revolute(y) from ground to bar;
        force motor: generalized(on: theta, value: 10 N*m); }";
    let study = Study::new(Interpreted::from_text(declaration).unwrap());
    let html = Report::new(&study).html().unwrap();
    let text = words(&html);
    assert!(text.contains("There is no equilibrium"), "{text}");
    assert!(text.contains("There are no modes"), "{text}");
}

#[test]
fn mistakes_of_the_caller_are_errors() {
    let study = swinging();
    let wrong = Report::new(&study).sweep(Pendulum::omega, &[f64::NAN]).html();
    assert!(matches!(wrong, Err(Error::Study(_))), "{wrong:?}");
    let wrong = Report::new(&study.clone().tolerance(Pendulum::l, -1.0)).html();
    assert!(matches!(wrong, Err(Error::Study(_))), "{wrong:?}");
    let nowhere = Report::new(&study).save("no/such/folder/report.html");
    let message = nowhere.unwrap_err().to_string();
    assert!(message.starts_with("cannot write `no/such/folder/report.html`"), "{message}");
}

#[test]
fn a_sweep_of_one_value_has_no_branches_and_says_so() {
    let study = swinging();
    let html = Report::new(&study).sweep(Pendulum::omega, &[InDeclaredUnit(5.0)]).html().unwrap();
    assert!(words(&html).contains("Branches of equilibria were not followed"));
}

#[test]
fn the_same_study_gives_the_same_report() {
    let html = || Report::new(&swinging()).html().unwrap();
    assert!(html() == html());
}

/// The sentences of the verdicts are those of the library, each once, in its order.
#[test]
fn verdicts_are_the_sentences_of_the_summary() {
    let near = swinging().input(Pendulum::omega, 3.9);
    for study in [swinging(), near] {
        let text = words(&Report::new(&study).html().unwrap());
        let sentences = study.summary().unwrap().sentences();
        assert!(!sentences.is_empty());
        let mut rest = &*text;
        for sentence in &sentences {
            let found = rest.split_once(&*sentence.text);
            let (_, after) = found.unwrap_or_else(|| panic!("no `{sentence}` in {rest}"));
            rest = after;
            assert_eq!(text.matches(&*sentence.text).count(), 1, "{sentence}");
        }
        let printed = study.summary().unwrap().to_string();
        for sentence in &sentences {
            assert!(printed.contains(&sentence.text), "{printed}");
        }
    }
}

const CARRIAGE: &str = "mechanism Carriage {
    input torque: N*m;
    input speed: rad/s;
    design k = 200 N/m +/- 4 N/m;
    design m = 2 kg +/- 6% uniform;
    design c = 1 N*s/m;
    curve motor: [-60, 90, 240] rpm -> [4, 2, 0] N*m;
    gravity 9.81 m/s^2 along x;
    body turntable: massless;
    body cart: box(mass: m, size: [0.2, 0.1, 0.1] m);
    body arm: rod(mass: 1 kg, length: 1 m, along: x);
    joint turn: revolute(x) from ground to turntable, driven at speed;
    joint slide: prismatic(x) from turntable to cart;
    joint theta: revolute(y) from cart to arm;
    point seat: turntable;
    point tip: cart;
    point hand: arm at [1 m, 0, 0];
    force mount: bushing(from: seat, to: tip, stiffness: [k, k, k], damping: [c, c, c]);
    force coil: spring(on: theta, stiffness: 8 N*m/rad);
    force rubbing: damper(on: theta, damping: 0.1 N*m*s/rad);
    force drive: generalized(on: theta, value: torque + 0.1 * motor(speed));
    force push: load(at: hand, force: [1, 0, 0] N);
    output tilt = theta;
}";

fn carriage() -> Study<Interpreted> {
    Study::new(Interpreted::from_text(CARRIAGE).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

fn texts(table: &Value, name: &str) -> Vec<String> {
    let columns = table["columns"].as_array().expect("columns");
    let column = columns.iter().find(|column| column["name"] == name);
    let values = column.and_then(|x| x["values"].as_array());
    let values = values.unwrap_or_else(|| panic!("no column `{name}` in {table}"));
    values.iter().map(|value| value.as_str().unwrap_or_default().to_owned()).collect()
}

const UNBALANCED: &str = "mechanism Unbalanced {
    input speed: rpm;
    design kx = 40 kN/m +/- 5%;
    body across: massless;
    body plate: massless;
    body disk: cylinder(mass: 4 kg, radius: 0.1 m, length: 0.02 m, axis: z);
    joint x: prismatic(x) from ground to across;
    joint y: prismatic(y) from across to plate;
    joint spin: revolute(z) from plate to disk, driven at speed;
    force sideways: spring(on: x, stiffness: kx);
    force upwards: spring(on: y, stiffness: 70 kN/m);
    force damp_x: damper(on: x, damping: 30 N*s/m);
    force damp_y: damper(on: y, damping: 30 N*s/m);
    unbalance residual: on disk, amount: 20 g*mm;
    output right = x;
    output up = y;
    output still = 0 * x;
}";

#[test]
fn forced_vibration_is_listed_drawn_and_moved() {
    let input = eigentol::Input::new(0);
    let study =
        Study::new(Interpreted::from_text(UNBALANCED).unwrap()).input(input, InDeclaredUnit(1100.0)).samples(200);
    let speeds = [800.0, 900.0, 950.0, 1000.0, 1100.0].map(InDeclaredUnit);
    let [right, up, still] = ["right", "up", "still"].map(|x| study.find_output(x).unwrap());
    let report = Report::new(&study).sweep(input, &speeds);
    let html = (report.orbit(right, up).orbit(still, still)).html().unwrap();
    let found = study.forced_response().unwrap();
    let y = found.harmonics[0].outputs.iter().map(|output| output.expect("an amplitude").norm());
    let response = table(&html, "forced response");
    let y: Vec<_> = y.map(Some).collect();
    assert_eq!(column(&response, "amplitude"), y);
    let spreads: Vec<_> = data(&html, "table").into_iter().map(|value| value["name"].to_string()).collect();
    for name in ["\"spreads\"", "\"bands\"", "\"forced vibration\""] {
        assert!(spreads.iter().any(|own| own == name), "{spreads:?}");
    }
    let figures = data(&html, "figure");
    let titled = |title: &str| figures.iter().find(|figure| figure["title"] == title).unwrap();
    let panels = titled("Bode plot of right under residual")["panels"].as_array().unwrap();
    assert_eq!(panels.len(), 2);
    assert_eq!(panels[0]["bands"][0]["edges"].as_array().unwrap().len(), 5);
    assert_eq!(panels[0]["error_bars"][0]["label"], "peak");
    assert_eq!(titled("Polar plot of right under residual")["panels"][0]["equal_scales"], true);
    let orbits = figures.iter().filter(|figure| {
        let title = figure["title"].as_str().unwrap_or_default();
        title.contains("orbit")
    });
    let orbits: Vec<_> = orbits.collect();
    let caption = orbits[0]["caption"].to_string();
    assert!(orbits.len() == 1 && caption.contains("Semi-axes"), "{caption}");
    let motions = &data(&html, "scene")[0]["motions"];
    let last = motions.as_array().unwrap().last().unwrap();
    assert_eq!(last["title"], "Under residual: 18.3333 Hz");
    assert!(last["about"].as_str().unwrap().contains("enlarged"), "{last}");
    assert!(last["frames"].as_array().unwrap().len() >= 8);
    assert!(words(&html).contains("from 0 to peak"));
    // What nothing excites has no such section.
    let html = Report::new(&swinging()).html().unwrap();
    assert!(!html.contains("Forced vibration"));
}

/// Gravity, drives, springs and torques on coordinates, bushings, loads and curves: everything that exerts a force.
#[test]
fn everything_that_acts_is_listed() {
    let elements = table(&Report::new(&carriage()).html().unwrap(), "elements");
    let columns = ["name", "kind", "law"].map(|name| texts(&elements, name));
    let texts: Vec<String> =
        (0..columns[0].len()).map(|row| columns.each_ref().map(|column| &*column[row]).join(": ")).collect();
    let expected = [
        "gravity: gravity: [9.81, 0, 0]",
        "turn: drive: at speed",
        "mount: bushing: from seat to tip stiffness [k, k, k] damping [c, c, c]",
        "coil: spring: on theta stiffness 8",
        "rubbing: damper: on theta damping 0.1",
        "drive: generalized: on theta value (torque + (0.1 * motor(speed)))",
        "push: load: at hand force [1, 0, 0]",
        "motor: curve: through 3 points from -60 to 240 rpm",
    ];
    assert_eq!(texts, expected);
}

#[test]
fn up_is_against_gravity_or_along_the_first_drive() {
    let up = |declaration: &str| {
        let study = Study::new(Interpreted::from_text(declaration).unwrap());
        let html = Report::new(&study).html().unwrap();
        let scene = data(&html, "scene").remove(0);
        let up: Vec<f64> = scene["up"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
        (up, words(&html))
    };
    let (against, said) = up(CARRIAGE);
    assert_eq!(against, [-1.0, 0.0, 0.0]);
    assert!(said.contains("Up is against gravity: [-1, 0, 0]"), "{said}");
    let oblique = "mechanism Oblique { gravity [0, 3, -4] m/s^2; body bar: rod(mass: 1 kg, length: 1 m, along: -z);
        joint theta: revolute(x) from ground to bar; }";
    let (against, _) = up(oblique);
    assert!((against[1] + 0.6).abs() < 1e-15 && (against[2] - 0.8).abs() < 1e-15, "{against:?}");
    let turning = "mechanism Turning { input speed: rad/s; body hub: massless; body blade: rod(mass: 1 kg, length: 1 m, along: y);
        joint spin: revolute(-x) from ground to hub, driven at speed;
        joint flap: revolute(z) from hub to blade; force root: spring(on: flap, stiffness: 5 N*m/rad); }";
    let (along, said) = up(turning);
    assert_eq!(along, [1.0, 0.0, 0.0]);
    assert!(said.contains("No gravity is declared. Up is [1, 0, 0]"), "{said}");
    let still = turning.replace(", driven at speed", ", driven at 0");
    assert_eq!(up(&still).0, [0.0, 0.0, 1.0]);
}

/// The plots of the laws: a normal density is the textbook bell curve, a uniform one is flat.
#[test]
fn each_law_is_drawn_and_said() {
    let html = Report::new(&carriage()).html().unwrap();
    let text = words(&html);
    for said in ["normal, 200 \u{b1} 4 N/m", "uniform, 2 \u{b1} 0.208 kg"] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let laws = texts(&table(&html, "variables"), "law");
    assert_eq!(laws, ["", "", "normal", "uniform", ""]);
    let drawn = densities(&html);
    let [bell, level] = &drawn[..] else { panic!("{} drawings", drawn.len()) };
    // Two ends at zero, and 57 quantiles between them.
    assert_eq!((bell.len(), level.len()), (59, 59));
    let (base, top, middle) = (bell[0][1], bell[29][1], bell[29][0]);
    assert!((middle - 80.0).abs() < 0.11, "{middle}");
    let sigma = (bell[57][0] - bell[1][0]) / 7.0;
    for [x, y] in &bell[1..58] {
        let z = (x - middle) / sigma;
        let height = (base - y) / (base - top);
        assert!((height - (-0.5 * z * z).exp()).abs() < 0.01, "{x} {y}");
    }
    let heights = level[1..58].iter().map(|x| base - x[1]);
    assert!(heights.clone().all(|own| (own - (base - top)).abs() < 0.11), "{level:?}");
}

/// The points of the density curves, in pixels.
fn densities(html: &str) -> Vec<Vec<[f64; 2]>> {
    let curves = html.split("class=\"density\" d=\"M").skip(1);
    let curves = curves.map(|rest| rest.split('"').next().expect("an end"));
    let point = |text: &str| {
        let (x, y) = text.split_once(' ').expect("two numbers");
        [x, y].map(|x| x.parse().expect("a number"))
    };
    curves.map(|path| path.split('L').map(point).collect()).collect()
}

#[test]
fn samples_say_how_they_were_drawn() {
    let study = swinging().stream(2);
    let html = Report::new(&study).html().unwrap();
    let text = words(&html);
    assert!(text.contains("Monte Carlo (500 samples, seed 3, stream 2)"), "{text}");
    assert!(text.contains("Statistics of 500 samples, seed 3, stream 2"), "{text}");
    let histogram = data(&html, "figure").into_iter().find(|value| value["panels"][0]["y"]["name"] == "density");
    let caption = histogram.unwrap()["caption"].to_string();
    assert!(caption.contains("500 samples, seed 3, stream 2"), "{caption}");
    let sampled = table(&html, "Monte Carlo");
    assert_eq!(column(&sampled, "seed"), [Some(3.0)]);
    assert_eq!(column(&sampled, "stream"), [Some(2.0)]);
}

mechanism! {
    mechanism Bars {
        input omega: rpm;
        design l1 = 1.0 m +/- 3%;
        design l2 = 0.8 m +/- 30 mm;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: 3 kg, length: l1, along: -z);
        body bar2: rod(mass: 2 kg, length: l2, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
    }
}

fn two_bars() -> Study<Bars> {
    Study::new(Bars).input(Bars::omega, InDeclaredUnit(20.0)).sigma_level(2.0).samples(300).seed(5)
}

/// Numbers of a text, in order.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split([' ', ',', '(', ')', '%', ':']);
    words.filter_map(|word| word.trim_end_matches('.').parse().ok()).collect()
}

fn close(a: f64, b: f64, digits: i32) -> bool {
    (a / b - 1.0).abs() < 0.6 * 10_f64.powi(1 - digits)
}

/// The summary lines have the numbers of the results: frequencies with bands and causes, events with bands, in declared
/// units.
#[test]
fn the_lines_in_short_have_the_numbers_of_the_results() {
    let study = two_bars();
    let values = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0].map(InDeclaredUnit);
    let html = Report::new(&study).sweep(Bars::omega, &values).orders(&[4.0]).html().unwrap();
    let (_, brief) = html.split_once("<section id=\"brief\">").unwrap();
    let (brief, _) = brief.split_once("</ul>").unwrap();
    let lines: Vec<&str> = brief.split("<li class=\"").skip(1).collect();
    let first = study.first_order().unwrap();
    for (r, mode) in first.modes.iter().enumerate() {
        let line = lines.iter().find(|line| line.contains(&format!("Mode {} at", r + 1))).unwrap();
        let own = mode.frequency().unwrap();
        let (k, share) = own.variance_shares.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        let said = numbers(line);
        let [number, value, band, level, percent] = said[..] else { panic!("{line}") };
        assert_eq!((number, level), (r as f64 + 1.0, 2.0));
        let [mean, sigma] = [own.mean, own.sigma].map(|own| own / std::f64::consts::TAU);
        assert!(close(value, mean, 6) && close(band, 2.0 * sigma, 3), "{line} {own:?}");
        assert!(
            (percent - 100.0 * share).abs() < 0.51 && line.contains(["mostly from l1", "mostly from l2"][k]),
            "{line}"
        );
    }
    assert!(lines.iter().any(|line| line.starts_with("good\">All 300 samples are stable.")), "{brief}");
    assert!(lines[0].starts_with("good\">The equilibrium is stable"));
    let campbell =
        study.campbell(Bars::omega, &values.map(|value| value.0 * std::f64::consts::PI / 30.0), &[4.0]).unwrap();
    let rpm = 30.0 / std::f64::consts::PI;
    let told = |what: &str| -> Vec<Vec<f64>> {
        lines.iter().filter(|line| line.contains(what)).map(|line| numbers(line)).collect()
    };
    let crossings = told("crosses 4x omega at");
    assert!(!crossings.is_empty() && crossings.len() == campbell.crossings.len(), "{brief}");
    let critical = told("loses its stiffness");
    assert!(!critical.is_empty() && critical.len() == campbell.critical.len(), "{brief}");
    for (said, event) in crossings.iter().zip(&campbell.crossings).chain(critical.iter().zip(&campbell.critical)) {
        let [.., value, band, level] = said[..] else { panic!("{said:?}") };
        assert!(close(value, event.value * rpm, 6) && close(band, 2.0 * event.sigma().unwrap() * rpm, 3), "{said:?}");
        assert_eq!(level, 2.0);
    }
}

/// Each mode has its own histogram and shares, and captions state the number of standard deviations of a band.
#[test]
fn figures_and_tables_of_each_mode_are_its_own() {
    use eigentol_figures::{Histogram, Style, shares};
    let study = two_bars();
    let html = Report::new(&study).html().unwrap();
    let figures = data(&html, "figure");
    let modes = study.modes().unwrap();
    let summary = study.summary().unwrap();
    let (first, sampled) = (summary.first, study.monte_carlo().unwrap());
    for mode in 0..2 {
        let style = Style::default().title(format!("Mode {}", mode + 1));
        let histogram = Histogram::new(&sampled, mode).first_order(&first).figure(&style);
        for expected in [histogram, shares(&first, mode, &style)] {
            assert!(figures.contains(&serde_json::to_value(expected.unwrap()).unwrap()), "mode {mode}");
        }
        let derived: Vec<_> =
            first.modes[mode].variance_shares().iter().map(|variance_share| Some(100.0 * variance_share)).collect();
        assert_eq!(column(&table(&html, "shares"), &format!("mode {}", mode + 1)), derived);
    }
    let sigmas = study.tolerances().unwrap().sigmas().to_vec();
    let shown = column(&table(&html, "variables"), "sigma");
    assert_eq!(shown, [None, Some(sigmas[0]), Some(sigmas[1])]);
    let text = words(&html);
    for caption in [
        "a half-width holds 2 standard deviations",
        "a band holds 2 standard deviations of first order",
        "normal, 0.8 \u{b1} 0.03 m",
        "Law, mean and 2 standard deviations",
    ] {
        assert!(text.contains(caption), "{caption}: {text}");
    }
    assert!(html.contains("<p class=\"subject\">Bars at omega = 20 rpm</p>"));
    let scene = &data(&html, "scene")[0];
    for (shown, mode) in scene["motions"].as_array().unwrap().iter().zip(&modes.modes) {
        let omega = mode.frequency().unwrap();
        let title = numbers(shown["title"].as_str().unwrap());
        let about = numbers(shown["about"].as_str().unwrap());
        let hertz = omega / std::f64::consts::TAU;
        assert!(close(title[1], hertz, 6) && close(about[0], omega, 6), "{shown}");
    }
}

/// Captions are above their tables, and verdicts have the matching symbol.
#[test]
fn captions_and_signs_are_those_of_what_they_stand_at() {
    let values = [3.0, 4.0, 5.0];
    let html = Report::new(&swinging().input(Pendulum::omega, 3.9))
        .sweep(Pendulum::omega, &values)
        .orders(&[0.6])
        .html()
        .unwrap();
    for (caption, name) in [
        ("Where a frequency is a multiple of the input", "crossings"),
        ("Where the equilibrium loses its stiffness", "critical states"),
        ("All modes along the input", "Campbell diagram"),
        ("Folds and branch points", "special points"),
        ("Statistics of 500 samples, seed 3", "Monte Carlo"),
        ("Natural modes", "modes"),
    ] {
        let (_, after) = html.split_once(&format!("<caption>{caption}")).unwrap_or_else(|| panic!("{caption}"));
        let (_, json) = after.split_once("data-kind=\"table\">").unwrap();
        assert!(json.starts_with(&format!("{{\"name\":\"{name}\"")), "{caption}: {}", &json[..60]);
    }
    let summary = swinging().input(Pendulum::omega, 3.9).summary().unwrap();
    let bad = &summary.sentences()[0];
    assert!(html.contains(&format!("<li class=\"bad\">{}</li>", bad.text)), "{bad}");
    let html = Report::new(&swinging()).html().unwrap();
    let good = swinging().summary().unwrap().sentences().remove(0);
    assert!(html.contains(&format!("<li class=\"good\">{}</li>", good.text)), "{good}");
}

#[test]
fn bodies_and_joints_are_those_of_the_declaration() {
    let html = Report::new(&carriage()).html().unwrap();
    let bodies = table(&html, "bodies");
    assert_eq!(texts(&bodies, "body"), ["turntable", "cart", "arm"]);
    assert_eq!(texts(&bodies, "made of"), ["massless", "box, 0.2 x 0.1 x 0.1", "rod, length 1"]);
    let joints = table(&html, "joints");
    for (column, expected) in [
        ("joint", ["turn", "slide", "theta"]),
        ("kind", ["revolute", "prismatic", "revolute"]),
        ("from", ["ground", "turntable", "cart"]),
        ("to", ["turntable", "cart", "arm"]),
    ] {
        assert_eq!(texts(&joints, column), expected);
    }
    let unknowns = table(&html, "equilibrium");
    assert_eq!(texts(&unknowns, "unknown"), ["slide", "theta"]);
    assert_eq!(texts(&unknowns, "unit"), ["m", "rad"]);
}
