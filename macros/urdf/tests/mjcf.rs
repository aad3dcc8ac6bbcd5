//! Models of MuJoCo: numbers of MuJoCo itself for random models, and what is refused.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_compiler::{Compilation, compile};
use eigentol_urdf::{ImportError, Options, Reason, Resistance, import_mjcf, is_mjcf};
use serde_json::Value;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/mjcf")
}

fn nothing(_: &str) -> io::Result<String> {
    Err(io::ErrorKind::NotFound.into())
}

fn declaration(text: &str) -> Result<String, ImportError> {
    let options = Options::default().resistance(Resistance::KernelsOnly);
    Ok(import_mjcf(text, &options, &nothing)?.declaration)
}

fn compiled(text: &str) -> Compilation {
    let declaration = declaration(text).unwrap_or_else(|error| panic!("{error}"));
    compile(declaration.parse().unwrap(), Limits::default()).unwrap_or_else(|error| panic!("{declaration}\n{error}"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

#[test]
fn random_models_have_the_numbers_of_mujoco() {
    let all: Value = serde_json::from_str(&fs::read_to_string(folder().join("numbers.json")).unwrap()).unwrap();
    let models = all["models"].as_array().unwrap();
    assert!(models.len() >= 10);
    for model in models {
        let name = model["file"].as_str().unwrap();
        let text = fs::read_to_string(folder().join(name)).unwrap();
        assert!(is_mjcf(&text));
        let compilation = compiled(&text);
        let n = compilation.functions.unknowns.len();
        assert!(compilation.functions.unknowns.iter().all(|unknown| matches!(unknown.role, Role::Position(_))));
        let (x, v) = (numbers(&model["x"]), numbers(&model["v"]));
        assert_eq!(n, x.len(), "{name}");
        let arrays = compilation.program.evaluate("motion", &[&v, &x, &[], &[]]).unwrap();
        let theirs: Vec<f64> = model["mass"].as_array().unwrap().iter().flat_map(numbers).collect();
        close(name, &arrays[0], &theirs);
        let held: Vec<f64> = arrays[1].iter().map(|force| -force).collect();
        close(name, &held, &numbers(&model["force"]));
    }
}

fn close(name: &str, ours: &[f64], theirs: &[f64]) {
    let most = theirs.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (a, b) in ours.iter().zip(theirs) {
        assert!((a - b).abs() <= 1e-10 * most, "{name}: {a} {b}");
    }
}

fn refused(text: &str) -> ImportError {
    match declaration(text) {
        Err(error) => error,
        Ok(text) => panic!("it is translated: {text}"),
    }
}

fn world(inside: &str) -> String {
    format!("<mujoco>\n<worldbody>\n{inside}\n</worldbody></mujoco>")
}

#[test]
fn what_cannot_be_read_is_said_with_its_place() {
    let body = |inside: &str| world(&format!("<body name='b'>{inside}</body>"));
    let ball = "<geom size='0.1'/>";
    for (text, line, words) in [
        ("<mujoco>".to_owned(), 1, "not XML"),
        ("<sdf/>".to_owned(), 1, "not a `robot`"),
        (world(ball), 1, "nothing moves"),
        (body("<joint type='hing'/><geom size='0.1'/>"), 3, "`hing` is not a type of joint"),
        (body("<joint axis='0 0 0'/><geom size='0.1'/>"), 3, "has no length"),
        (body("<joint axis='0 1'/><geom size='0.1'/>"), 3, "`axis` has 2 numbers"),
        (body("<joint pos='0 x 1'/><geom size='0.1'/>"), 3, "`pos` is `0 x 1`"),
        (body("<joint class='stiff'/><geom size='0.1'/>"), 3, "there is no class `stiff`"),
        (body("<joint/><geom type='box' size='0.1'/>"), 3, "the size of this box"),
        (body("<joint/><geom type='mesh' mesh='leg'/>"), 3, "the mass of a mesh"),
        (body("<joint/><geom size='0.1' shellinertia='true'/>"), 3, "shell"),
        (body("<joint/><inertial mass='1'/>"), 3, "has no inertia"),
        (body("<joint/><geom size='0.1'/><replicate count='3'/>"), 3, "`replicate` is not read"),
        (world("<include file='arm.xml'/>"), 3, "`arm.xml` cannot be read"),
        (
            world("<body name='b'><joint/><geom size='1'/></body><body name='b'><joint/><geom size='1'/></body>"),
            3,
            "twice",
        ),
    ] {
        let error = refused(&text);
        let own = &error.mistakes[0];
        assert!(own.line == line && own.reason.to_string().contains(words), "{text}: {error}");
        assert!(!own.reason.help().is_empty());
    }
    let equal = |inside: &str| {
        format!(
            "<mujoco><worldbody><body name='b'><joint name='j'/>{ball}</body></worldbody><equality>{inside}</equality></mujoco>"
        )
    };
    for inside in ["<joint joint1='k'/>", "<connect body1='c' anchor='0 0 0'/>", "<weld site1='s' site2='t'/>"] {
        assert!(matches!(refused(&equal(inside)).mistakes[0].reason, Reason::Unknown { .. }), "{inside}");
    }
    assert!(matches!(refused(&equal("<connect body1='b'/>")).mistakes[0].reason, Reason::MissingAttribute { .. }));
}

#[test]
fn files_include_files_but_not_themselves() {
    let text = "<mujoco><include file='world.xml'/></mujoco>";
    let options = Options::default().resistance(Resistance::File);
    let read = |name: &str| match name {
        "world.xml" => Ok("<mujoco><worldbody><include file='b.xml'/></worldbody></mujoco>".to_owned()),
        "b.xml" => Ok("<any><body name='b'><joint name='j' stiffness='2'/><geom size='0.1'/></body></any>".to_owned()),
        _ => nothing(name),
    };
    let found = import_mjcf(text, &options, &read).unwrap();
    assert!(found.declaration.contains("spring(on: j, stiffness: 2.0 N*m/rad)"), "{}", found.declaration);
    let circle = |_: &str| Ok(text.to_owned());
    let error = import_mjcf(text, &options, &circle).unwrap_err();
    assert!(error.to_string().contains("included too deeply"), "{error}");
}

/// Wherever a file ends or whatever byte is wrong, there is an answer.
#[test]
fn damaged_files_are_answered() {
    for name in ["random_0.xml", "random_5.xml"] {
        let text = fs::read_to_string(folder().join(name)).unwrap();
        for end in (0..text.len()).step_by(37) {
            let _ = declaration(&text[..end]);
            let damaged = format!("{}{}{}", &text[..end], ["9", "\"", "<", " "][end % 4], &text[end + 1..]);
            if let Ok(found) = declaration(&damaged) {
                assert!(found.starts_with("/// The model"), "{found}");
            }
        }
    }
}

#[test]
fn notes_say_what_is_left_out() {
    let text = "<mujoco><option density='1.2'/><worldbody><body name='b' gravcomp='1'>
        <joint name='j' range='-1 1' frictionloss='0.1'/><geom size='0.1'/></body></worldbody>
        <tendon><spatial name='rope'/></tendon><actuator><motor joint='j'/></actuator></mujoco>";
    let found = import_mjcf(text, &Options::default().resistance(Resistance::File), &nothing).unwrap();
    let notes: Vec<String> = found.notes.iter().map(ToString::to_string).collect();
    for words in ["medium", "gravcomp", "range", "frictionloss", "rope", "actuator"] {
        assert!(notes.iter().any(|note| note.contains(words)), "{words}: {notes:?}");
    }
}
