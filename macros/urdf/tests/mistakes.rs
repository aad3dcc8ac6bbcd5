//! Every mistake in a file is reported with its place, a message and a remedy; several are reported together.

use eigentol_urdf::{Options, Reason, import};

const LINK: &str =
    r#"<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"#;

/// A robot with two links and the given additional elements.
fn robot(more: &str) -> String {
    format!(
        "<robot name=\"r\">\n<link name=\"base\"/>\n<link name=\"arm\">{LINK}</link>\n\
         <joint name=\"j\" type=\"revolute\"><parent link=\"base\"/><child link=\"arm\"/></joint>\n{more}</robot>"
    )
}

/// Line, column and message of each mistake.
fn mistakes(text: &str) -> Vec<String> {
    let error = import(text, &Options::default()).expect_err("a mistake");
    assert!(!error.mistakes.is_empty());
    for mistake in &error.mistakes {
        assert!(!mistake.reason.help().is_empty());
    }
    let texts = error.mistakes.iter().map(|one| format!("{}:{} {}", one.line, one.column, one.reason));
    texts.collect()
}

fn only(text: &str) -> String {
    let all = mistakes(text);
    assert_eq!(all.len(), 1, "{all:?}");
    all[0].clone()
}

#[test]
fn what_is_no_robot() {
    assert!(only("<robot name=").starts_with("1:"));
    assert!(only("").contains("this is not XML"));
    assert_eq!(only("<sdf/>"), "1:1 this is `sdf`, not a `robot`");
    assert_eq!(only("<robot name=\"r\"/>"), "1:1 the robot has no link");
    let template = "<robot xmlns:xacro=\"http://ros.org/wiki/xacro\">\n <xacro:include filename=\"a\"/></robot>";
    assert_eq!(only(template), "2:2 this is a xacro template, not a robot");
}

#[test]
fn elements_and_attributes() {
    let all = mistakes(&robot(
        "<link/>\n<link name=\"a\"><inertial><mass/></inertial></link>\n\
         <link name=\"b\"><inertial><mass value=\"x\"/><inertia ixx=\"nan\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\"/></inertial></link>\n\
         <joint name=\"k\"><parent link=\"bas\"/><origin xyz=\"0 0\"/></joint>\n\
         <joint name=\"l\" type=\"revolut\"><parent link=\"arm\"/><child link=\"a\"/></joint>\n",
    ));
    let expected = [
        "5:1 `link` has no `name`",
        "6:16 the `inertial` of `a` has no `inertia`",
        "6:26 `mass` has no `value`",
        "7:26 `mass value` is `x`; a number is expected",
        "7:43 `inertia ixx` is `nan`; a number is expected",
        "7:43 `inertia` has no `iyz`",
        "8:1 `joint` has no `type`",
        "8:1 the `joint` of `k` has no `child`",
        "8:17 there is no link `bas`",
        "8:37 `origin xyz` is `0 0`; three numbers is expected",
        "9:1 `revolut` is not a type of joint",
    ];
    assert_eq!(all, expected);
    let error = import(&robot("<joint name=\"l\" type=\"revolut\"/>"), &Options::default());
    assert!(error.expect_err("a mistake").to_string().contains("help: did you mean `revolute`?"));
}

#[test]
fn names_that_are_there_twice() {
    assert_eq!(only(&robot("<link name=\"arm\"/>")), "5:1 the link `arm` is there twice");
    let again = "<link name=\"c\"/><joint name=\"j\" type=\"fixed\"><parent link=\"arm\"/><child link=\"c\"/></joint>";
    assert_eq!(only(&robot(again)), "5:17 the joint `j` is there twice");
}

#[test]
fn trees() {
    let two = "<joint name=\"k\" type=\"fixed\"><parent link=\"base\"/><child link=\"arm\"/></joint>";
    assert_eq!(only(&robot(two)), "5:1 the link `arm` is the child of both `j` and `k`");
    assert_eq!(only(&robot("<link name=\"c\"/>")), "5:1 nothing leads from the root `base` to the link `c`");
    let back = "<joint name=\"k\" type=\"fixed\"><parent link=\"arm\"/><child link=\"base\"/></joint>";
    assert_eq!(only(&robot(back)), "2:1 the link `base` hangs on itself, through others");
    let circle = "<link name=\"c\"/><link name=\"d\"/>\n\
         <joint name=\"k\" type=\"fixed\"><parent link=\"c\"/><child link=\"d\"/></joint>\n\
         <joint name=\"l\" type=\"fixed\"><parent link=\"d\"/><child link=\"c\"/></joint>";
    assert_eq!(only(&robot(circle)), "5:1 the link `c` hangs on itself, through others");
}

#[test]
fn axes_and_masses() {
    let axis = robot("").replace("<child link=\"arm\"/>", "<child link=\"arm\"/><axis xyz=\"0 0 0\"/>");
    assert_eq!(only(&axis), "4:73 the axis of the joint `j` has no length");
    let negative = robot("").replace("mass value=\"1\"", "mass value=\"-1\"");
    assert_eq!(only(&negative), "3:18 the mass of the link `arm` is -1 kg");
    let weightless = robot("").replace("mass value=\"1\"", "mass value=\"0\"");
    assert_eq!(only(&weightless), "3:1 the link `arm` has an inertia but no mass, and no link welded to it has one");
    let fixed = robot("").replace("revolute", "fixed");
    assert_eq!(only(&fixed), "1:1 nothing moves: every joint is fixed");
    let massless = robot("").replace(LINK, "");
    assert_eq!(only(&massless), "1:1 nothing moves: no joint carries a link with a mass");
}

#[test]
fn mimics() {
    let with = |mimic: &str| robot("").replace("<child link=\"arm\"/>", &format!("<child link=\"arm\"/>{mimic}"));
    assert_eq!(only(&with("<mimic joint=\"j\"/>")), "4:1 the joint `j` cannot mimic `j`: it would follow itself");
    assert_eq!(only(&with("<mimic joint=\"k\"/>")), "4:73 there is no joint `k`");
    assert_eq!(only(&with("<mimic/>")), "4:73 `mimic` has no `joint`");
    let floating = robot(
        "<link name=\"c\"/><joint name=\"k\" type=\"floating\"><parent link=\"arm\"/><child link=\"c\"/><mimic joint=\"j\"/></joint>",
    );
    assert_eq!(only(&floating), "5:17 the joint `k` cannot mimic `j`: one of them has several coordinates");
}

/// `diag(1, 1, 3)`: in the nearest valid tensor one moment is the sum of the others.
#[test]
fn inertias() {
    let text = robot("").replace("izz=\"1\"", "izz=\"3\"");
    let error = import(&text, &Options::default()).expect_err("no body");
    let Reason::Inertia { links, principal, nearest, replacement } = &error.mistakes[0].reason else {
        panic!("{error}");
    };
    assert_eq!(links, &["arm"]);
    assert_eq!(*principal, [1.0, 1.0, 3.0]);
    let third = 1.0 / 3.0;
    for (found, exact) in nearest.iter().zip([1.0 + third, 1.0 + third, 3.0 - third]) {
        assert!((found - exact).abs() < 1e-14);
    }
    assert!((replacement[2] - (3.0 - third)).abs() < 1e-14);
    let text = error.to_string();
    assert!(text.starts_with("3:1: error: the inertia of the link `arm` is that of no body"), "{text}");
    assert!(text.contains("1.00000e0, 1.00000e0, 3.00000e0 kg*m^2"), "{text}");
}

/// Two links that are each impossible but, welded together, are two halves of a rod.
#[test]
fn welded_links_are_judged_together() {
    let flat = r#"<inertial><mass value="1"/><inertia ixx="0" iyy="2" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"#;
    let steep = r#"<inertial><mass value="1"/><inertia ixx="0" iyy="1" izz="2" ixy="0" ixz="0" iyz="0"/></inertial>"#;
    let alone = robot("").replace(LINK, flat);
    assert!(only(&alone).contains("is that of no body"));
    let weld = "<joint name=\"w\" type=\"fixed\"><parent link=\"arm\"/><child link=\"c\"/></joint>";
    let together = robot(&format!("<link name=\"c\">{steep}</link>{weld}")).replace(LINK, flat);
    let import = import(&together, &Options::default()).expect("a body");
    let body = "body arm: rigid(mass: 2.0 kg, inertia: [0.0, 3.0, 3.0] kg*m^2);";
    assert!(import.declaration.contains(body), "{}", import.declaration);
    assert!(import.declaration.contains("point c: arm;"));
}
