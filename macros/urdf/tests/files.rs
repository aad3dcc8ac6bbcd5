//! Checks the declarations generated from files, and that they compile.

use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::{Compilation, compile};
use eigentol_urdf::{Base, Import, Note, Options, Resistance, import};

const MASS: &str = r#"<inertial><origin xyz="0.1 0.2 0.3"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"#;

/// A chain of links `l0`, `l1` and so on, with `l0` massless, given the joints between them: name, type, more elements.
fn chain(joints: &[(&str, &str, &str)]) -> String {
    let mut text = "<robot name=\"chain\">\n<link name=\"l0\"/>\n".to_owned();
    for (index, (name, kind, more)) in joints.iter().enumerate() {
        let child = index + 1;
        text += &format!(
            "<link name=\"l{child}\">{MASS}</link>\n\
             <joint name=\"{name}\" type=\"{kind}\"><parent link=\"l{index}\"/><child link=\"l{child}\"/>{more}</joint>\n"
        );
    }
    text + "</robot>"
}

fn compiled(import: &Import) -> Compilation {
    let tokens = import.declaration.parse().expect("tokens");
    compile(tokens, Limits::default()).unwrap_or_else(|mistakes| panic!("{}\n{mistakes}", import.declaration))
}

fn unknowns(import: &Import) -> Vec<String> {
    let compilation = compiled(import);
    compilation.functions.unknowns.iter().map(|one| one.name.clone()).collect()
}

fn lines<'a>(import: &'a Import, word: &str) -> Vec<&'a str> {
    let lines = import.declaration.lines().map(str::trim);
    lines.filter(|line| line.starts_with(word)).collect()
}

fn with(text: &str, options: &Options) -> Import {
    import(text, options).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn every_type_of_joint() {
    let text = chain(&[
        ("turn", "revolute", "<axis xyz=\"0 -2 0\"/>"),
        ("spin", "continuous", "<origin xyz=\"1 2 3\" rpy=\"0.1 0.2 0.3\"/><axis xyz=\"1 1 0\"/>"),
        ("slide", "prismatic", ""),
        ("weld", "fixed", "<origin xyz=\"0 0 1\" rpy=\"0 0 0.5\"/>"),
        ("plane", "planar", "<origin xyz=\"1 0 0\"/><axis xyz=\"1 0 0\"/>"),
        ("fly", "floating", ""),
    ]);
    let import = with(&text, &Options::default());
    assert_eq!(
        lines(&import, "joint"),
        [
            "joint turn: revolute(-y) from ground to l1;",
            "joint spin: revolute([1.0, 1.0, 0.0]) from l1 to l2 at [1.0, 2.0, 3.0] m rotated(z, 0.3 rad) rotated(y, 0.2 rad) rotated(x, 0.1 rad);",
            "joint slide: prismatic(x) from l2 to l3;",
            "joint plane: planar(plane_px: y, plane_py: z, plane_yaw: x) from l3 to l5 at [0.8775825618903728, 0.479425538604203, 1.0] m rotated(z, 0.5 rad);",
            "joint fly: free(fly_px: x, fly_py: y, fly_pz: z, fly_yaw: z, fly_pitch: y, fly_roll: x) from l5 to l6;",
        ]
    );
    assert_eq!(
        lines(&import, "point"),
        ["point l0: ground;", "point l4: l3 at [0.0, 0.0, 1.0] m rotated(z, 0.5 rad);"]
    );
    assert_eq!(unknowns(&import).len(), 12);
    let skew = text.replace("<axis xyz=\"1 0 0\"/>", "<axis xyz=\"1 2 3\"/>");
    assert_eq!(unknowns(&with(&skew, &Options::default())).len(), 12);
}

#[test]
fn bases() {
    let root = format!("<link name=\"l0\">{MASS}</link>");
    let text = chain(&[("j", "revolute", "")]).replace("<link name=\"l0\"/>", &root);
    let unknowns_of = |base| unknowns(&with(&text, &Options::default().base(base)));
    assert_eq!(unknowns_of(Base::Fixed), ["j"]);
    // Upright, only the springs hold the heading.
    assert_eq!(unknowns_of(Base::Planar), ["base_px", "base_py", "base_yaw", "j"]);
    let all = ["base_px", "base_py", "base_pz", "base_yaw", "base_pitch", "base_roll", "j"];
    assert_eq!(unknowns_of(Base::Floating), all);
}

/// Of a joint about the vertical and one about a horizontal axis, gravity holds only the second.
#[test]
fn what_nothing_resists() {
    let text = chain(&[("pan", "revolute", "<axis xyz=\"0 0 1\"/>"), ("tilt", "revolute", "")]);
    let springs = with(&text, &Options::default());
    assert_eq!(lines(&springs, "every").len(), 1);
    assert_eq!(unknowns(&springs), ["pan", "tilt"]);
    let drives = with(&text, &Options::default().resistance(Resistance::Drives));
    assert_eq!(unknowns(&drives), ["tilt"]);
    assert!(drives.notes.contains(&Note::Driven { coordinate: "pan".to_owned(), why: "nothing resists it" }));
    let alone = with(&text, &Options::default().resistance(Resistance::KernelsOnly));
    assert_eq!(unknowns(&alone), ["pan", "tilt"]);
    assert_eq!(lines(&alone, "kernels"), ["kernels only;"]);
    // Nearly zero.
    let tilted = text.replace("0 0 1", "0 -1e-12 -1");
    let drives = with(&tilted, &Options::default().resistance(Resistance::Drives));
    assert_eq!(unknowns(&drives), ["tilt"]);
    let upright =
        chain(&[("pan", "revolute", "<axis xyz=\"0 0 1\"/>"), ("turn", "revolute", "<axis xyz=\"0 0 -1\"/>")]);
    let error = import(&upright, &Options::default().resistance(Resistance::Drives)).expect_err("nothing moves");
    assert!(error.to_string().contains("nothing resists any joint"), "{error}");
}

/// Joints that carry nothing, and a chain of such joints.
#[test]
fn what_moves_no_mass() {
    let text = chain(&[
        ("a", "revolute", ""),
        ("b", "revolute", ""),
        ("c", "revolute", "<mimic joint=\"b\" multiplier=\"2\"/>"),
    ]);
    let light = text.replacen(MASS, "HEAVY", 1).replace(MASS, "").replace("HEAVY", MASS);
    let import = with(&light, &Options::default());
    assert_eq!(lines(&import, "joint b"), ["joint b: revolute(x) from l1 to l2, driven at 0;"]);
    assert_eq!(lines(&import, "joint c"), ["joint c: revolute(x) from l2 to l3;"]);
    compiled(&import);
}

#[test]
fn joints_that_follow_others() {
    let text = chain(&[
        ("turn", "revolute", ""),
        ("same", "revolute", "<mimic joint=\"turn\"/>"),
        ("rack", "prismatic", "<mimic joint=\"turn\" multiplier=\"0.02\" offset=\"0.1\"/>"),
        ("back", "continuous", "<mimic joint=\"rack\" multiplier=\"-50\" offset=\"0.2\"/>"),
        ("still", "revolute", "<axis xyz=\"0 0 1\"/><mimic joint=\"turn\" multiplier=\"0\" offset=\"0.3\"/>"),
        ("stiller", "prismatic", "<mimic joint=\"still\" multiplier=\"2\" offset=\"0.4\"/>"),
        ("weld", "fixed", "<mimic joint=\"turn\"/>"),
    ]);
    let import = with(&text, &Options::default());
    assert_eq!(
        lines(&import, "constraint"),
        [
            "constraint coupling_of_same: coupling(of: same, with: turn, ratio: 1.0);",
            "constraint coupling_of_rack: coupling(of: rack, with: turn, ratio: 0.02 m/rad, offset: 0.1 m);",
            "constraint coupling_of_back: coupling(of: back, with: rack, ratio: -50.0 rad/m, offset: 0.2 rad);",
        ]
    );
    assert_eq!(
        lines(&import, "point"),
        [
            "point l0: ground;",
            "point l5: l4 rotated(z, 0.3 rad);",
            "point l6: l4 at [0.955336489125606, 0.29552020666133955, 0.0] m rotated(z, 0.3 rad);",
            "point l7: l4 at [0.955336489125606, 0.29552020666133955, 0.0] m rotated(z, 0.3 rad);",
        ]
    );
    assert_eq!(unknowns(&import).len(), 7);
    let held = |joint: &str| Note::Held { joint: joint.to_owned() };
    assert!(import.notes.contains(&held("still")) && import.notes.contains(&held("stiller")));
    assert!(import.notes.contains(&Note::FixedMimic { joint: "weld".to_owned() }));
}

#[test]
fn names_that_are_none_here() {
    let text = chain(&[("box", "revolute", ""), ("l1", "revolute", ""), ("every-3", "prismatic", "")])
        .replace("\"l3\"", "\"2 hands\"")
        .replace("\"chain\"", "\"a `b`\nc\"");
    let import = with(&text, &Options::default());
    assert_eq!(unknowns(&import), ["box_joint", "l1", "every_3"]);
    assert!(import.declaration.starts_with("/// The robot `a  b  c`"), "{}", import.declaration);
    assert!(import.declaration.contains("pub mechanism ABC {"));
    let names = [("box_joint", "box"), ("every_3", "every-3"), ("l1_link", "l1"), ("link_2_hands", "2 hands")];
    let renamed: Vec<(&str, &str)> = import.names.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    assert_eq!(renamed, names);
    assert!(lines(&import, "body link_2_hands")[0].ends_with("// `2 hands`"));
}

#[test]
fn dampers_of_the_file() {
    let text = chain(&[
        ("a", "revolute", "<dynamics damping=\"0.7\" friction=\"2\"/>"),
        ("b", "prismatic", "<dynamics damping=\"3\"/>"),
    ]);
    let import = with(&text, &Options::default());
    assert_eq!(
        lines(&import, "force"),
        [
            "force damping_of_a: damper(on: a, damping: 0.7 N*m*s/rad);",
            "force damping_of_b: damper(on: b, damping: 3.0 N*s/m);",
        ]
    );
    compiled(&import);
    let friction = "`dynamics friction` of `a` has no meaning in a mechanism";
    assert!(import.notes.iter().any(|note| note.to_string() == friction));
    let without = with(&text, &Options::default().damping(false));
    assert_eq!(lines(&without, "force").len(), 0);
}

/// Truncated or shuffled text gives a result or an error, but no panic.
#[test]
fn no_text_panics() {
    let text = chain(&[
        ("a", "revolute", "<mimic joint=\"b\"/>"),
        ("b", "planar", "<axis xyz=\"1 2 3\"/>"),
        ("c", "floating", ""),
    ]);
    let resistances = [Resistance::default(), Resistance::Drives, Resistance::KernelsOnly];
    for resistance in resistances {
        let options = Options::default().resistance(resistance).nearest_inertias(true);
        for end in (0..text.len()).step_by(7) {
            let _ = import(&text[..end], &options);
        }
        let words: Vec<&str> = text.split_inclusive('"').collect();
        for skipped in 0..words.len() {
            let rest = [&words[..skipped], &words[skipped + 1..]].concat().concat();
            let _ = import(&rest, &options);
        }
        for digit in ["-1", "0", "1e308", "1e-320", "nan"] {
            let _ = import(&text.replace("\"1\"", &format!("\"{digit}\"")), &options);
        }
    }
}
