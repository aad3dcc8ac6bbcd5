//! The chain of bars in the language of the macro; shared by the build script and the suite.

/// `bars` uniform bars in series on a spinning shaft; design variables are the lengths, then the masses.
pub(crate) fn declaration(name: &str, bars: usize) -> String {
    let mut text = format!("/// Bars in series.\npub(crate) mechanism {name} {{ input omega: rad/s;");
    for k in 1..=bars {
        text += &format!("design l{k} = 1 m +/- 1%;");
    }
    for k in 1..=bars {
        text += &format!("design m{k} = 3 kg +/- 1%;");
    }
    text += "gravity 9.81 m/s^2 along -z; body shaft: massless;";
    for k in 1..=bars {
        text += &format!("body bar{k}: rod(mass: m{k}, length: l{k}, along: -z);");
    }
    text += "joint spin: revolute(z) from ground to shaft, driven at omega;";
    text += "joint q1: revolute(y) from shaft to bar1;";
    for k in 2..=bars {
        let before = k - 1;
        text += &format!("joint q{k}: revolute(y) from bar{before} to bar{k} at [0, 0, -l{before}];");
    }
    text + "}"
}
