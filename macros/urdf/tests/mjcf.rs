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

fn nothing(_: &str) -> io::Result<Vec<u8>> {
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
        (body("<geom size='0.1'/>"), 1, "nothing moves"),
        (body("<joint name='j'/><joint name='j' type='slide'/><geom size='0.1'/>"), 3, "the joint `j` is there twice"),
        (body("<joint type='hing'/><geom size='0.1'/>"), 3, "`hing` is not a type of joint"),
        (body("<joint axis='0 0 0'/><geom size='0.1'/>"), 3, "has no length"),
        (body("<joint axis='0 1'/><geom size='0.1'/>"), 3, "`axis` has 2 numbers"),
        (body("<joint pos='0 x 1'/><geom size='0.1'/>"), 3, "`pos` is `0 x 1`"),
        (body("<joint class='stiff'/><geom size='0.1'/>"), 3, "there is no class `stiff`"),
        (body("<joint/><geom type='box' size='0.1'/>"), 3, "the size of this box"),
        (body("<joint/><geom type='mesh' mesh='leg'/>"), 3, "no mesh `leg`"),
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
    let ball_joint = equal("<joint joint1='j'/>").replace("<joint name='j'/>", "<joint name='j' type='ball'/>");
    assert!(refused(&ball_joint).to_string().contains("no joint with one coordinate `j`"));
    assert!(matches!(refused(&equal("<connect body1='b'/>")).mistakes[0].reason, Reason::MissingAttribute { .. }));
}

#[test]
fn files_include_files_but_not_themselves() {
    let text = "<mujoco><include file='world.xml'/></mujoco>";
    let options = Options::default().resistance(Resistance::File);
    let read = |name: &str| match name {
        "world.xml" => Ok("<mujoco><worldbody><include file='b.xml'/></worldbody></mujoco>".into()),
        "b.xml" => Ok("<any><body name='b'><joint name='j' stiffness='2'/><geom size='0.1'/></body></any>".into()),
        _ => nothing(name),
    };
    let found = import_mjcf(text, &options, &read).unwrap();
    assert!(found.declaration.contains("spring(on: j, stiffness: 2.0 N*m/rad)"), "{}", found.declaration);
    let circle = |_: &str| Ok(text.into());
    let error = import_mjcf(text, &options, &circle).unwrap_err();
    assert!(error.to_string().contains("included too deeply"), "{error}");
}

/// A box as a mesh, from vertices in the file, from OBJ and from STL.
#[test]
fn a_mesh_has_the_mass_of_what_it_encloses() {
    let corners: Vec<[f32; 3]> =
        (0..8).map(|k| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { [0.125, 0.25, 0.5][axis] } else { 0.0 })).collect();
    let faces = [
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
    ];
    let obj: String = corners.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
    let obj: String = obj + &faces.map(|[a, b, c]| format!("f {} {} -{}\n", a + 1, b + 1, 8 - c)).concat();
    let mut stl = vec![0; 80];
    stl.extend(12_u32.to_le_bytes());
    for face in faces {
        stl.extend([0; 12]);
        stl.extend(face.iter().flat_map(|&k| corners[k]).flat_map(f32::to_le_bytes));
        stl.extend([0; 2]);
    }
    let words = |numbers: Vec<String>| numbers.join(" ");
    let vertices = words(corners.iter().flatten().map(f32::to_string).collect());
    let triples = words(faces.iter().flatten().map(usize::to_string).collect());
    let inline = format!("name='box' vertex='{vertices}' face='{triples}'");
    let read = |name: &str| match name {
        "m/box.obj" => Ok(obj.clone().into_bytes()),
        "m/box.stl" => Ok(stl.clone()),
        "m/cut.stl" => Ok(stl[..300].to_vec()),
        _ => nothing(name),
    };
    let options = Options::default().resistance(Resistance::File);
    let model = |mesh: &str, geom: &str| {
        let text = format!(
            "<mujoco><compiler meshdir='m/'/><asset><mesh {mesh}/></asset><worldbody><body name='b'><joint name='j'/>{geom}</body></worldbody></mujoco>"
        );
        import_mjcf(&text, &options, &read)
    };
    let solid = "<geom type='box' size='0.0625 0.125 0.25' pos='0.0625 0.125 0.25'/>";
    let expected = model(&inline, solid).unwrap().declaration;
    let numbers = |text: &str| -> Vec<f64> {
        let body = text.lines().find(|line| line.contains("body b:")).unwrap();
        body.split(|c: char| !(c.is_ascii_digit() || ".e-".contains(c))).filter_map(|word| word.parse().ok()).collect()
    };
    for mesh in [&*inline, "file='box.obj'", "file='box.stl'", "file='box.stl' inertia='exact'"] {
        let found = model(mesh, "<geom type='mesh' mesh='box'/>").unwrap().declaration;
        let (ours, theirs) = (numbers(&found), numbers(&expected));
        let most = theirs.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let [mass, rest @ ..] = &ours[..] else { panic!("{found}") };
        assert!((mass - theirs[0]).abs() < 1e-12 * most, "{found}{expected}");
        // The moments about the axes first; products are zero.
        assert!(rest[..3].iter().zip(&theirs[1..]).all(|(a, b)| (a - b).abs() < 1e-12 * most), "{found}{expected}");
    }
    for (mesh, words) in [
        ("file='none.obj' name='box'", "cannot be read"),
        ("file='cut.stl' name='box'", "is no mesh"),
        ("file='box.stl' inertia='shell'", "is not known here"),
        ("name='box' vertex='0 0 0 1 0 0 0 1 0' face='0 1 5'", "not those of its vertices"),
        ("name='box' vertex='0 0 0 1 0 0 0 1 0' face='0 1 2'", "encloses no volume"),
    ] {
        let error = model(mesh, "<geom type='mesh' mesh='box'/>").unwrap_err();
        assert!(error.to_string().contains(words), "{mesh}: {error}");
        // Who does not need its mass does not open it.
        assert!(model(mesh, solid).is_ok());
    }
}

/// Springs of the option are on what moves, be it the angles of a ball.
#[test]
fn springs_are_on_what_moves() {
    for (joint, words) in [
        ("<joint type='ball'/>", vec!["every angle"]),
        ("<joint type='slide'/>", vec!["every displacement"]),
        ("<freejoint/>", vec!["every angle", "every displacement"]),
    ] {
        let text = world(&format!("<body name='b'>{joint}<geom size='0.1'/></body>"));
        let found = import_mjcf(&text, &Options::default(), &nothing).unwrap().declaration;
        for word in ["every angle", "every displacement"] {
            assert_eq!(found.contains(word), words.contains(&word), "{found}");
        }
        compile(found.parse().unwrap(), Limits::default()).unwrap_or_else(|error| panic!("{found}\n{error}"));
    }
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
