//! Every file of the package example-robot-data, if Python has it.

use std::env;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use super::files::{read, truth};
use super::reference::{Robot, options, texts};

/// The folder with the robots, and the interpreter.
pub(crate) fn package() -> Result<(PathBuf, PathBuf), String> {
    let python = env::var_os("EIGENTOL_PYTHON").map_or_else(|| PathBuf::from("python3"), PathBuf::from);
    let ask = "import sysconfig; print(sysconfig.get_paths()['purelib'])";
    let output = Command::new(&python).args(["-c", ask]).output();
    let output = output.map_err(|error| format!("no Python: {error}"))?;
    let site = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    let robots = Path::new(&site).join("cmeel.prefix/share/example-robot-data/robots");
    match robots.is_dir() {
        true => Ok((robots, python)),
        false => Err(format!("`{}` has no package example-robot-data", python.display())),
    }
}

/// The package, or `None` and a message.
pub(crate) fn package_or_skip(what: &str) -> Option<(PathBuf, PathBuf)> {
    let found = package();
    found.map_err(|why| println!("skipped: {what}: {why}")).ok()
}

/// All files, in order.
pub(crate) fn urdf_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in folder.read_dir().expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "urdf") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// Reference numbers from Pinocchio; `None` and a message if it is not available.
fn reference(python: &Path, request: &Value) -> Option<Value> {
    let script = truth("urdf/reference.py");
    let mut child = Command::new(python)
        .arg("-B")
        .arg(script)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("Python starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    stdin.write_all(request.to_string().as_bytes()).expect("Python reads");
    drop(stdin);
    let output = child.wait_with_output().expect("Python ends");
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    if complaint.contains("ModuleNotFoundError") {
        println!("skipped: numbers of Pinocchio: {}", complaint.trim().lines().last().unwrap_or_default());
        return None;
    }
    assert!(output.status.success(), "{complaint}");
    Some(serde_json::from_slice(&output.stdout).expect("JSON"))
}

/// The robots of `truth/robots` whose inertias are unchanged from their files.
#[test]
fn robots_of_the_truth_are_those_of_pinocchio() {
    const FILES: [&str; 9] = ["Baxter", "G1", "Icub", "Kinova", "Panda", "Solo12Free", "TalosArm", "Ur5", "Xarm7"];
    let Some((folder, _)) = package_or_skip("robots of the truth from URDF files") else {
        return;
    };
    for name in FILES {
        let truth: Value = serde_json::from_str(&read(&truth(&format!("robots/{name}.json")))).expect("JSON");
        let floating = truth["base"] == "free";
        let file = folder.join(truth["source"].as_str().expect("a file"));
        let options = options(floating).nearest_inertias(true);
        let robot = Robot::new(&read(&file), &options, &[]).unwrap_or_else(|error| panic!("{name}: {error}"));
        let states = truth["states"].as_array().expect("states");
        let worst = robot.assert_right(name, &texts(&truth["coordinates"]), states, &[]);
        println!("{name}: {worst:.1e}");
    }
}

/// Every importable file, with fixed and floating base, with the positions of a few links.
#[test]
fn every_file_gives_the_numbers_of_pinocchio() {
    let Some((folder, python)) = package_or_skip("all URDF files against Pinocchio") else {
        return;
    };
    let mut robots = Vec::new();
    let mut requests = Vec::new();
    for file in urdf_files(&folder) {
        let text = read(&file);
        for floating in [false, true] {
            let replacing = options(floating).nearest_inertias(true);
            let given = Robot::new(&text, &options(floating), &[]).map(|robot| (robot, options(floating)));
            let Ok((robot, options)) = given.or_else(|_| {
                let robot = Robot::new(&text, &replacing, &[]);
                robot.map(|x| (x, replacing))
            }) else {
                // A link that is not a body here makes it a different robot.
                continue;
            };
            let points = robot.points(4);
            let robot = Robot::new(&text, &options, &points).expect("a robot");
            let originals: Vec<&str> = points.iter().map(|point| robot.original(point)).collect();
            requests.push(json!({
                "file": file, "floating": floating, "coordinates": robot.coordinates(), "points": originals,
                "nearest": options.nearest_inertias,
            }));
            robots.push((robot, points));
        }
    }
    assert!(robots.len() > 110, "{}", robots.len());
    for name in ["icub_reduced", "romeo_small", "romeo_laas_small"] {
        let own = |request: &&Value| {
            let file = request["file"].as_str().unwrap_or_default();
            request["nearest"] == true && file.ends_with(&format!("/{name}.urdf"))
        };
        assert_eq!(requests.iter().filter(own).count(), 2, "{name}");
    }
    let Some(numbers) = reference(&python, &Value::Array(requests)) else {
        return;
    };
    let mut worst = 0.0_f64;
    for ((robot, points), one) in robots.iter().zip(numbers.as_array().expect("a list")) {
        let what = format!("{} floating {}", one["file"], one["floating"]);
        let states = one["states"].as_array().expect("states");
        assert_eq!(one["nearest"] == true, one["replaced"].as_array().is_some_and(|own| !own.is_empty()), "{what}");
        let error = robot.assert_right(&what, &texts(&one["coordinates"]), states, points);
        worst = worst.max(error);
    }
    println!("{} imports, the worst number off by {worst:.1e}", robots.len());
}
