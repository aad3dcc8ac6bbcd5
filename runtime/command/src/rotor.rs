//! Rotors that ROSS has saved, as TOML or JSON, translated into declarations.
//!
//! ROSS has its axis along z and moves across along x and y; in a declaration the shaft lies along x and moves along y and z.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde_json::{Map, Value};

use crate::mistake::Mistake;

/// A declaration and what it lacks of the file.
pub(crate) struct Rotor {
    pub(crate) declaration: String,
    pub(crate) notes: Vec<String>,
}

/// Whether a text is a rotor that ROSS has saved.
pub(crate) fn is_rotor(text: &str) -> bool {
    text.contains("ShaftElement")
}

/// Translates a rotor, or says what is wrong and where.
pub(crate) fn import(text: &str, name: Option<&str>) -> Result<Rotor, Mistake> {
    translated(&read(text)?, name).map_err(|message| {
        // Most begin with the key of an element.
        let is_key = |at: usize, key: &str| text[at + key.len()..].starts_with(['"', ']']);
        let place = |key| text.match_indices(key).find(|(at, key)| is_key(*at, key)).map(|(at, _)| at);
        let at = message.split('`').nth(1).and_then(place).unwrap_or(0);
        mistake(text, at, message)
    })
}

fn read(text: &str) -> Result<Map<String, Value>, Mistake> {
    if text.trim_start().starts_with('{') {
        return serde_json::from_str(text).map_err(|error| {
            let before: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
            mistake(text, before + error.column().saturating_sub(1), error.to_string())
        });
    }
    toml::from_str(text).map_err(|error: toml::de::Error| {
        mistake(text, error.span().unwrap_or_default().start, error.message().to_owned())
    })
}

fn mistake(text: &str, at: usize, message: String) -> Mistake {
    let help = Some("a rotor is what `Rotor.save` of ROSS writes, in TOML or JSON".to_owned());
    Mistake { help, ..Mistake::at(text, at, message) }
}

fn translated(file: &Map<String, Value>, name: Option<&str>) -> Result<Rotor, String> {
    let mut notes = Vec::new();
    let mut others = Vec::new();
    let mut elements: BTreeMap<&str, Vec<Element<'_>>> = BTreeMap::new();
    for (key, value) in file {
        let Some((kind, _)) = key.split_once("Element_").or_else(|| key.split_once('_')) else { continue };
        let Value::Object(fields) = value else { continue };
        match kind {
            "Shaft" | "Disk" | "PointMass" => elements.entry(kind).or_default().push(Element { key, fields }),
            _ if fields.contains_key("kxx") => elements.entry("Bearing").or_default().push(Element { key, fields }),
            _ if fields.contains_key("n") => others.push(Element { key, fields }),
            _ => {}
        }
    }
    let of = |kind: &str| elements.get(kind).map_or(&[][..], Vec::as_slice);
    let rows = rows(of("Shaft"))?;
    let first = *rows.keys().next().ok_or("there is no shaft element")?;
    let mut materials = Materials::default();
    let (mut table, mut places) = (String::new(), vec![0.0]);
    for (k, (node, layers)) in rows.iter().enumerate() {
        if *node != first + k {
            let missing = first + k;
            let between = others.iter().find(|other| other.node() == Ok(missing));
            let why = match between {
                Some(other) => format!("`{}` stands between node {missing} and the next", other.key),
                None => format!("`{}` begins at node {node}, but no shaft element at node {missing}", layers[0].key),
            };
            return Err(why + ": one shaft is translated, its nodes in order");
        }
        let length = layers[0].number("L")?;
        places.push(places[k] + length);
        write!(table, "\n        [{length} m").map_err(|error| error.to_string())?;
        for layer in layers {
            if layer.number("L")? != length {
                return Err(format!("`{}` is not as long as the other element from node {node}", layer.key));
            }
            table += &layer.sizes(&mut materials)?;
            notes.extend(layer.left_out()?);
        }
        table += "],";
    }
    // Layers from one node share one motion: their forces and torques add.
    let mut loads = String::new();
    for (field, word, unit) in [("axial_force", "tension", "N"), ("torque", "torque", "N*m")] {
        let of_row = |layers: &Vec<Element<'_>>| -> Result<f64, String> {
            layers.iter().try_fold(0.0, |sum, layer| Ok(sum + layer.list(field)?.iter().sum::<f64>()))
        };
        let all = rows.values().map(of_row).collect::<Result<Vec<f64>, String>>()?;
        if all.iter().any(|other| *other != all[0]) {
            notes.push(format!("`{field}` that differs from element to element is left out"));
        } else if all[0] != 0.0 {
            loads += &format!(", {word}: {} {unit}", all[0]);
        }
    }
    let slender = of("Shaft").iter().all(|layer| layer.fields.get("shear_effects") == Some(&Value::Bool(false)));
    let on_shaft = |node: usize| node.checked_sub(first).filter(|station| *station < places.len());
    let mut supports: BTreeMap<usize, Support> = BTreeMap::new();
    for bearing in of("Bearing") {
        let Some(link) = bearing.link()? else { continue };
        let key = bearing.key;
        let station = on_shaft(bearing.node()?).filter(|_| on_shaft(link).is_none());
        let station = station.ok_or_else(|| format!("`{key}` does not link the shaft to a support beside it"))?;
        supports.insert(link, Support { place: places[station], masses: [0.0; 2] });
    }
    for mass in of("PointMass") {
        if let Some(support) = supports.get_mut(&mass.node()?) {
            support.masses[0] += mass.number("mx")?;
            support.masses[1] += mass.number("my")?;
        }
    }
    let standing = |element: &Element<'_>| -> Result<Standing, String> {
        let node = element.node()?;
        match (on_shaft(node), supports.get(&node)) {
            (Some(station), _) => Ok(Standing { on: format!("rotor at station {station}"), place: places[station] }),
            (None, Some(own)) => Ok(Standing { on: format!("support_{node} at [0, 0, 0]"), place: own.place }),
            (None, None) => Err(format!("`{}` is at node {node}, which is off the shaft", element.key)),
        }
    };
    let mut rest = String::new();
    for (k, disk) in of("Disk").iter().enumerate() {
        let [mass, across, about] = [disk.number("m")?, disk.number("Id")?, disk.number("Ip")?];
        rest += &format!(
            "\n    body disk_{k}: rigid(mass: {mass} kg, inertia: [{about}, {across}, {across}] kg*m^2);
    joint turns_{k}: revolute(x) from {} to disk_{k}, driven at speed;\n",
            standing(disk)?.on
        );
    }
    for (k, mass) in of("PointMass").iter().enumerate() {
        let [across, up] = [mass.number("mx")?, mass.number("my")?];
        if supports.contains_key(&mass.node()?) {
            continue;
        }
        if across != up {
            return Err(format!("`{}` has different masses along x and y, where the shaft has one", mass.key));
        }
        rest += &format!(
            "\n    body mass_{k}: point(mass: {across} kg);\n    joint carries_{k}: fixed from {} to mass_{k};\n",
            standing(mass)?.on
        );
    }
    for (node, support) in &supports {
        rest += &support.declared(*node)?;
    }
    for (k, bearing) in of("Bearing").iter().enumerate() {
        let own = standing(bearing)?;
        let seat = match bearing.link()? {
            Some(node) => format!("support_{node} at [0, 0, 0]"),
            None => format!("ground at [{} m, 0, 0]", own.place),
        };
        rest += &bearing.film(k, [&seat, &own.on])?;
        for (fields, what) in [
            (&["mxx", "myy", "mxy", "myx", "mzz"][..], "masses"),
            (&["kzz", "czz"], "stiffness and damping along the axis"),
        ] {
            if bearing.any(fields)? {
                notes.push(format!("the {what} of `{}` are left out", bearing.key));
            }
        }
    }
    if rest.contains("curve ") {
        notes.push("between the speeds of a table ROSS interpolates in another way".to_owned());
    }
    let slender = if slender { ", shear: 0" } else { "" };
    let name = name.unwrap_or("Rotor");
    let declaration = format!(
        "/// A rotor that ROSS has saved.\nmechanism {name} {{
    input speed: rad/s;

{}    gravity 9.81 m/s^2 along -z;

    body rotor: shaft(along: x, up: z, sections: [{table}
    ]{slender}{loads}) spinning at speed;
{rest}}}\n",
        materials.declared()
    );
    notes.push("the shaft bends only: add `lines: [bending, torsion, stretch]` for the rest".to_owned());
    notes.push(
        "the file has no unbalance: declare one, as in `unbalance u: on disk_0, amount: 100 g*mm, angle: 0 deg;`"
            .to_owned(),
    );
    notes.extend(
        others
            .iter()
            .map(|other| format!("`{}` is left out: shafts, disks, bearings and seals are translated", other.key)),
    );
    notes.sort();
    notes.dedup();
    Ok(Rotor { declaration, notes })
}

/// An element of the file.
#[derive(Clone, Copy)]
struct Element<'a> {
    key: &'a str,
    fields: &'a Map<String, Value>,
}

/// The layers that begin at each node.
fn rows<'a>(elements: &[Element<'a>]) -> Result<BTreeMap<usize, Vec<Element<'a>>>, String> {
    let mut rows: BTreeMap<usize, Vec<Element<'a>>> = BTreeMap::new();
    for element in elements {
        rows.entry(element.node()?).or_default().push(*element);
    }
    for layers in rows.values_mut() {
        let inner = |element: &Element<'_>| element.number("idl").unwrap_or(0.0);
        layers.sort_by(|a, b| inner(a).total_cmp(&inner(b)));
    }
    Ok(rows)
}

impl Element<'_> {
    fn number(&self, field: &str) -> Result<f64, String> {
        let number = self.fields.get(field).and_then(Value::as_f64);
        number.ok_or_else(|| format!("`{}` has no number `{field}`", self.key))
    }

    fn node(&self) -> Result<usize, String> {
        let node = self.fields.get("n").and_then(Value::as_u64);
        node.map(|node| node as usize).ok_or_else(|| format!("`{}` has no node `n`", self.key))
    }

    /// Numbers that may be one for all speeds.
    fn list(&self, field: &str) -> Result<Vec<f64>, String> {
        let values = match self.fields.get(field) {
            Some(Value::Array(list)) => list,
            Some(value) => std::slice::from_ref(value),
            None => &[],
        };
        let wrong = || format!("`{}` must have finite numbers as its `{field}`", self.key);
        values.iter().map(|value| value.as_f64().ok_or_else(wrong)).collect()
    }

    /// Whether one of the numbers is not zero.
    fn any(&self, fields: &[&str]) -> Result<bool, String> {
        fields.iter().try_fold(false, |any, field| Ok(any || self.list(field)?.iter().any(|value| *value != 0.0)))
    }

    /// A field that ROSS may have left empty.
    fn given(&self, field: &str) -> Option<&Value> {
        self.fields.get(field).filter(|value| !value.is_null())
    }

    /// The diameters and the material of a layer.
    fn sizes(&self, materials: &mut Materials) -> Result<String, String> {
        let size = |left: &str, right: &str| -> Result<String, String> {
            let [left, right] = [self.number(left)?, self.number(right)?];
            Ok(if left == right { format!("{left} m") } else { format!("taper({left} m, {right} m)") })
        };
        let material = self.fields.get("material").and_then(Value::as_object);
        let material =
            Element { key: self.key, fields: material.ok_or_else(|| format!("`{}` has no `material`", self.key))? };
        let numbers = [material.number("rho")?, material.number("E")?, material.number("G_s")?];
        let wanted = material.fields.get("name").and_then(Value::as_str).unwrap_or("material");
        let name = materials.name(wanted, numbers);
        Ok(format!(", {}, {}, {name}", size("odl", "odr")?, size("idl", "idr")?))
    }

    fn left_out(&self) -> Result<Vec<String>, String> {
        let is_false = |field: &str| self.fields.get(field) == Some(&Value::Bool(false));
        let mut all = Vec::new();
        if self.any(&["alpha", "beta"])? {
            all.push("proportional damping of the shaft is left out: give `lag` or `drag`".to_owned());
        }
        if is_false("rotary_inertia") || is_false("gyroscopic") {
            all.push("sections have rotary inertia and gyroscopic moments, which the file leaves out".to_owned());
        }
        Ok(all)
    }

    /// The node beside the shaft that it stands on.
    fn link(&self) -> Result<Option<usize>, String> {
        let Some(link) = self.given("n_link") else { return Ok(None) };
        let node = link.as_u64().ok_or_else(|| format!("`{}` must have a node as its `n_link`", self.key))?;
        Ok(Some(node as usize))
    }

    /// The force of a bearing between two places, with curves against speed.
    fn film(&self, k: usize, [seat, journal]: [&str; 2]) -> Result<String, String> {
        // A `CylindricalBearing` has its speeds under another name.
        let speeds = if self.given("frequency").is_some() { "frequency" } else { "speed" };
        let speeds = if self.given(speeds).is_some() { self.list(speeds)? } else { Vec::new() };
        let mut curves = String::new();
        let mut coefficient = |field: &str, unit: &str| -> Result<String, String> {
            let values = self.list(field)?;
            match values[..] {
                [] => Ok("0".to_owned()),
                [only] => Ok(format!("{only} {unit}")),
                _ if values.iter().all(|value| *value == values[0]) => Ok(format!("{} {unit}", values[0])),
                _ if values.len() == speeds.len() => {
                    curves += &format!("    curve {field}_{k}: {speeds:?} rad/s -> {values:?} {unit};\n");
                    Ok(format!("{field}_{k}(speed)"))
                }
                _ => {
                    Err(format!("`{}` has {} values of `{field}` for {} speeds", self.key, values.len(), speeds.len()))
                }
            }
        };
        let mut matrix = |letter: &str, unit: &str| -> Result<String, String> {
            let [xx, xy, yx, yy] = ["xx", "xy", "yx", "yy"].map(|pair| coefficient(&format!("{letter}{pair}"), unit));
            Ok(format!("[[0, 0, 0], [0, {}, {}], [0, {}, {}]]", xx?, xy?, yx?, yy?))
        };
        let (stiffness, damping) = (matrix("k", "N/m")?, matrix("c", "N*s/m")?);
        Ok(format!(
            "\n{curves}    point seat_{k}: {seat};
    point journal_{k}: {journal};
    force bearing_{k}: bushing(from: seat_{k}, to: journal_{k},
        stiffness: {stiffness},
        damping: {damping});
    output across_{k} = position(journal_{k}).y;
    output up_{k} = position(journal_{k}).z;\n"
        ))
    }
}

/// Where something stands.
struct Standing {
    on: String,
    place: f64,
}

/// A mass beside the shaft, between two bearings.
struct Support {
    place: f64,
    /// That it has along y and z.
    masses: [f64; 2],
}

impl Support {
    /// On two slides, the first along the direction with more mass.
    fn declared(&self, node: usize) -> Result<String, String> {
        let [y, z] = self.masses;
        if y.min(z) <= 0.0 {
            return Err(format!("node {node} is a support without mass: give it a `PointMass` in both directions"));
        }
        let (first, last) = if y < z { ("z", "y") } else { ("y", "z") };
        let more = if y == z { "massless".to_owned() } else { format!("point(mass: {} kg)", (y - z).abs()) };
        Ok(format!(
            "\n    body way_{node}: {more};\n    body support_{node}: point(mass: {} kg);
    joint support_{node}_{first}: prismatic({first}) from ground to way_{node} at [{} m, 0, 0];
    joint support_{node}_{last}: prismatic({last}) from way_{node} to support_{node};\n",
            y.min(z),
            self.place
        ))
    }
}

/// Materials by their numbers: density, modulus and shear modulus.
#[derive(Default)]
struct Materials {
    all: Vec<(String, [f64; 3])>,
}

impl Materials {
    fn name(&mut self, wanted: &str, numbers: [f64; 3]) -> String {
        if let Some((name, _)) = self.all.iter().find(|(_, known)| *known == numbers) {
            return name.clone();
        }
        let plain: String =
            wanted.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
        let plain = format!("of_{plain}");
        let taken = |name: &str| self.all.iter().any(|(other, _)| other == name);
        let free = (1..).map(|k| if k == 1 { plain.clone() } else { format!("{plain}_{k}") }).find(|name| !taken(name));
        let name = free.unwrap_or(plain);
        self.all.push((name.clone(), numbers));
        name
    }

    fn declared(&self) -> String {
        let one = |(name, [density, modulus, shear]): &(String, [f64; 3])| {
            format!("    material {name}: density {density} kg/m^3, modulus {modulus} Pa, shear_modulus {shear} Pa;\n")
        };
        self.all.iter().map(one).collect()
    }
}
