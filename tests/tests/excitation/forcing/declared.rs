//! A machine declared twice: with excitations, and explicitly, with every running and shaken coordinate free, every
//! unbalance a displaced or turned shape, and every harmonic force a load that an input scales.

use std::fmt::Write;

use nalgebra::{Rotation3, Unit, Vector3};

pub(crate) type V = Vector3<f64>;

pub(crate) fn v(x: f64, y: f64, z: f64) -> V {
    V::new(x, y, z)
}

/// A vector in the language.
pub(crate) fn text(value: V) -> String {
    format!("[{:?}, {:?}, {:?}]", value.x, value.y, value.z)
}

/// What a coordinate does.
#[derive(Clone, Debug)]
pub(crate) enum Motion {
    Free,
    /// Its speed.
    Driven(f64),
    Coasting,
    /// The quantity (`amplitude`, `velocity`, `acceleration`), its amplitude, its frequency and its phase.
    Shaken(&'static str, f64, Frequency, f64),
}

#[derive(Clone, Debug)]
pub(crate) enum Frequency {
    /// rad/s.
    Own(f64),
    /// Of a running coordinate.
    Order(f64, String),
}

#[derive(Clone, Debug)]
pub(crate) struct Coordinate {
    pub(crate) name: String,
    /// Whether it is a length.
    pub(crate) slides: bool,
    pub(crate) motion: Motion,
}

#[derive(Clone, Debug)]
pub(crate) struct Joint {
    /// `joint NAME: KIND(..) from A to B PLACEMENT`, without its drives.
    pub(crate) declaration: String,
    pub(crate) coordinates: Vec<Coordinate>,
    /// The same with more freedom, where the explicit machine measures a reaction.
    pub(crate) released: Option<String>,
}

#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) name: String,
    /// A shape with its centre of mass at its origin.
    pub(crate) shape: String,
    pub(crate) center: V,
    /// The axis about which the nearest running coordinate turns it, in its own axes, in the positive sense.
    pub(crate) axis: Option<V>,
}

#[derive(Clone, Debug)]
pub(crate) enum Law {
    /// On a body: quantity, size, angle.
    Unbalance(String, Deviation, f64, f64),
    /// At a point: force, moment.
    Load(String, V, V),
    /// On a coordinate.
    On(String, f64),
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Deviation {
    Amount(V),
    Eccentricity,
    Tilt,
}

#[derive(Clone, Debug)]
pub(crate) struct Excitation {
    pub(crate) name: String,
    pub(crate) law: Law,
    /// Of a load.
    pub(crate) frequency: Frequency,
    pub(crate) phase: f64,
}

#[derive(Clone, Debug)]
pub(crate) enum Check {
    /// The output is one of the explicit machine too.
    Output,
    /// It is the force that this coordinate of the explicit machine needs.
    Row(String),
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Machine {
    pub(crate) bodies: Vec<Body>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) excitations: Vec<Excitation>,
    /// Name, expression.
    pub(crate) outputs: Vec<(String, String, Check)>,
    /// Other items of both.
    pub(crate) others: String,
    /// Coordinates that a constraint between rates couples: the explicit machine has it between positions.
    pub(crate) rates_coupled: Vec<String>,
    pub(crate) kernels_only: bool,
}

/// Directions across an axis: of angle zero, and a quarter of a turn ahead.
pub(crate) fn across(axis: V) -> [V; 2] {
    let axis = axis.normalize();
    let reference = [V::y(), V::z(), V::x()][axis.iamax()];
    let first = (reference - axis * axis.dot(&reference)).normalize();
    let quarter = Rotation3::from_axis_angle(&Unit::new_normalize(axis), 90_f64.to_radians());
    [first, quarter * first]
}

impl Machine {
    pub(crate) fn body(&mut self, name: &str, shape: &str, center: V) -> &mut Self {
        self.bodies.push(Body { name: name.into(), shape: shape.into(), center, axis: None });
        self
    }

    /// A body that turns about an axis.
    pub(crate) fn rotor(&mut self, name: &str, shape: &str, center: V, axis: V) -> &mut Self {
        self.body(name, shape, center);
        self.bodies.last_mut().expect("pushed").axis = Some(axis);
        self
    }

    /// A joint; `/` before the name of a coordinate says that it is a length.
    pub(crate) fn joint(&mut self, declaration: &str, coordinates: &[(&str, Motion)]) -> &mut Self {
        let coordinate = |(name, motion): &(&str, Motion)| Coordinate {
            name: name.trim_start_matches('/').into(),
            slides: name.starts_with('/'),
            motion: motion.clone(),
        };
        self.joints.push(Joint {
            declaration: declaration.into(),
            coordinates: coordinates.iter().map(coordinate).collect(),
            released: None,
        });
        self
    }

    /// The explicit machine has this joint instead of the last one.
    pub(crate) fn released(&mut self, declaration: &str) -> &mut Self {
        self.joints.last_mut().expect("a joint").released = Some(declaration.into());
        self
    }

    pub(crate) fn unbalance(&mut self, body: &str, deviation: Deviation, size: f64, angle: f64) -> &mut Self {
        let law = Law::Unbalance(body.into(), deviation, size, angle);
        self.excite(law, Frequency::Own(0.0), 0.0)
    }

    pub(crate) fn excite(&mut self, law: Law, frequency: Frequency, phase: f64) -> &mut Self {
        let name = format!("shake{}", self.excitations.len());
        self.excitations.push(Excitation { name, law, frequency, phase });
        self
    }

    pub(crate) fn other(&mut self, item: &str) -> &mut Self {
        let _ = writeln!(self.others, "    {item}");
        self
    }

    /// An output that both machines have.
    pub(crate) fn output(&mut self, expression: &str) -> &mut Self {
        self.outputs.push((format!("out{}", self.outputs.len()), expression.into(), Check::Output));
        self
    }

    /// A reaction, which is the force along a coordinate of the explicit machine.
    pub(crate) fn reaction(&mut self, expression: &str, coordinate: &str) -> &mut Self {
        self.outputs.push((format!("out{}", self.outputs.len()), expression.into(), Check::Row(coordinate.into())));
        self
    }

    pub(crate) fn coordinate(&self, name: &str) -> Option<&Coordinate> {
        let mut all = self.joints.iter().flat_map(|joint| &joint.coordinates);
        all.find(|x| x.name == name)
    }

    fn frequency(frequency: &Frequency) -> String {
        match frequency {
            Frequency::Own(value) => format!("frequency: {value:?} rad/s"),
            Frequency::Order(order, of) => format!("order: {order:?} of {of}"),
        }
    }

    fn clause(coordinate: &Coordinate, several: bool) -> String {
        let name = if several { &coordinate.name } else { "" };
        let unit = if coordinate.slides { "m" } else { "rad" };
        match &coordinate.motion {
            Motion::Free => String::new(),
            Motion::Driven(speed) => format!(", {name} driven at {speed:?} {unit}/s"),
            Motion::Coasting => format!(", {name} coasting"),
            Motion::Shaken(quantity, amplitude, frequency, phase) => {
                let time = match *quantity {
                    "amplitude" => "",
                    "velocity" => "/s",
                    _ => "/s^2",
                };
                let frequency = Self::frequency(frequency);
                format!(", {name} shaken({quantity}: {amplitude:?} {unit}{time}, {frequency}, phase: {phase:?} rad)")
            }
        }
    }

    /// With excitations.
    pub(crate) fn excited(&self) -> String {
        let mut text = String::from("mechanism Excited {\n");
        if self.kernels_only {
            text.push_str("    kernels only;\n");
        }
        for body in &self.bodies {
            let place = match body.shape.as_str() {
                "massless" => String::new(),
                _ => format!(" at {} m", self::text(body.center)),
            };
            let _ = writeln!(text, "    body {}: {}{place};", body.name, body.shape);
        }
        for joint in &self.joints {
            let several = joint.coordinates.len() > 1;
            let clauses = joint.coordinates.iter();
            let clauses: String = clauses.map(|clause| Self::clause(clause, several)).collect();
            let _ = writeln!(text, "    {}{clauses};", joint.declaration);
        }
        text.push_str(&self.others);
        for excitation in &self.excitations {
            let _ = writeln!(text, "    {};", self.excitation(excitation));
        }
        for (name, expression, _) in &self.outputs {
            let _ = writeln!(text, "    output {name} = {expression};");
        }
        text + "}\n"
    }

    fn excitation(&self, excitation: &Excitation) -> String {
        let Excitation { name, law, frequency, phase } = excitation;
        let when = format!("{}, phase: {phase:?} rad", Self::frequency(frequency));
        match law {
            Law::Unbalance(body, deviation, size, angle) => {
                let (what, at) = match deviation {
                    Deviation::Amount(at) => (format!("amount: {size:?} kg*m"), format!(", at {} m", text(*at))),
                    Deviation::Eccentricity => (format!("eccentricity: {size:?} m"), String::new()),
                    Deviation::Tilt => (format!("tilt: {size:?} rad"), String::new()),
                };
                format!("unbalance {name}: on {body}, {what}, angle: {angle:?} rad{at}")
            }
            Law::Load(point, force, moment) => format!(
                "force {name}: harmonic(at: {point}, force: {} N, moment: {} N*m, {when})",
                text(*force),
                text(*moment)
            ),
            Law::On(coordinate, value) => {
                let slides = self.coordinate(coordinate).is_some_and(|x| x.slides);
                let (word, unit) = if slides { ("force", "N") } else { ("moment", "N*m") };
                format!("force {name}: harmonic(on: {coordinate}, {word}: {value:?} {unit}, {when})")
            }
        }
    }

    /// Without excitations; `eps` scales the deviations, and an input of an excitation's name its force.
    pub(crate) fn explicit(&self) -> String {
        let mut text = String::from("mechanism Explicit {\n    kernels only;\n    input eps: 1;\n");
        for body in &self.bodies {
            let _ = writeln!(text, "    body {}: {};", body.name, self.deviating(body));
        }
        for joint in &self.joints {
            let declaration = joint.released.as_ref().unwrap_or(&joint.declaration);
            let _ = writeln!(text, "    {declaration};");
        }
        text.push_str(&self.others);
        for Excitation { name, law, .. } in &self.excitations {
            let _ = match law {
                Law::Unbalance(..) => Ok(()),
                Law::Load(point, force, moment) => writeln!(
                    text,
                    "    input {name}_now: 1;\n    force {name}: load(at: {point}, force: {name}_now * {} N, moment: {name}_now * {} N*m);",
                    self::text(*force),
                    self::text(*moment)
                ),
                Law::On(coordinate, value) => {
                    let slides = self.coordinate(coordinate).is_some_and(|x| x.slides);
                    let unit = if slides { "N" } else { "N*m" };
                    writeln!(
                        text,
                        "    input {name}_now: 1;\n    force {name}: generalized(on: {coordinate}, value: {name}_now * {value:?} {unit});"
                    )
                }
            };
        }
        for (name, expression, check) in &self.outputs {
            if matches!(check, Check::Output) {
                let _ = writeln!(text, "    output {name} = {expression};");
            }
        }
        text + "}\n"
    }

    /// The shape of a body with its unbalances.
    fn deviating(&self, body: &Body) -> String {
        if body.shape == "massless" {
            return body.shape.clone();
        }
        let (mut moved, mut turned, mut added) = (V::zeros(), String::new(), String::new());
        let place = |c: V, d: V| {
            let entry = |k: usize| format!("({:?} + eps * {:?}) * 1 m", c[k], d[k]);
            format!("[{}]", [0, 1, 2].map(entry).join(", "))
        };
        for Excitation { law, .. } in &self.excitations {
            let Law::Unbalance(on, deviation, size, angle) = law else {
                continue;
            };
            let (true, Some(axis)) = (*on == body.name, body.axis) else {
                continue;
            };
            let [first, second] = across(axis);
            let direction = first * angle.cos() + second * angle.sin();
            match deviation {
                Deviation::Eccentricity => moved += direction * *size,
                Deviation::Tilt => {
                    let direction = self::text(direction);
                    let _ = write!(turned, " rotated({direction}, eps * {size:?} rad)");
                }
                Deviation::Amount(at) => {
                    let (moved, at) = (place(*at, direction * *size), self::text(*at));
                    let _ = write!(added, " + point(mass: 1 kg) at {moved} - point(mass: 1 kg) at {at} m");
                }
            }
        }
        let center = place(body.center, moved);
        format!("{} at {center}{turned}{added}", body.shape)
    }
}
