//! Meshes as masses: volume, centre and second moments of what their triangles enclose.
//!
//! As MuJoCo does where nothing else is said ("legacy"), the tetrahedra from the centre of the surface to its triangles count with their sizes,
//! which gives a centre, and those from there give mass and moments; with `inertia="exact"` those seen from behind count negatively. For
//! what has no hollows both are the same. Vertices have single precision.

use std::collections::BTreeMap;

use super::Include;
use super::attributes::{exactly, numbers, of_quaternion, required};
use super::element::Element;
use crate::error::{ImportError, Reason};
use crate::geometry::{Inertial, Pose, Vector, cross, matrix, norm};

type Result<T> = std::result::Result<T, ImportError>;
type Triangle = [Vector; 3];

/// Bytes of a triangle in an STL file, and of what stands before the first.
const STL: (usize, usize) = (50, 84);

/// A mesh for a mass of one, in its own frame, with its volume.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub(super) volume: f64,
    pub(super) unit: Inertial,
}

/// The meshes that a file declares, by name.
pub(super) struct Meshes<'a> {
    all: BTreeMap<String, &'a Element>,
    /// Where their files are.
    folder: String,
    include: Include<'a>,
}

impl<'a> Meshes<'a> {
    pub(super) fn new(root: &'a Element, folder: &str, include: Include<'a>) -> Self {
        Self { all: declared(root), folder: folder.to_owned(), include }
    }

    /// Reads the mesh that a geom names.
    pub(super) fn get(&self, geom: &Element) -> Result<Mesh> {
        let name = required(geom, "mesh")?;
        match self.all.get(name) {
            Some(own) => mesh(own, &self.folder, self.include),
            None => Err(geom.mistake(Reason::Unknown { what: "mesh", name: name.to_owned(), near: None })),
        }
    }
}

fn declared(root: &Element) -> BTreeMap<String, &Element> {
    let all = root.named("asset").flat_map(|asset| asset.named("mesh"));
    let named = all.filter_map(|own| {
        let file = own.get("file").unwrap_or_default();
        let stem = file.rsplit(['/', '\\']).next().unwrap_or_default();
        let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem);
        let name = own.get("name").unwrap_or(stem);
        (!name.is_empty()).then(|| (name.to_owned(), own))
    });
    named.collect()
}

fn mesh(own: &Element, folder: &str, include: Include<'_>) -> Result<Mesh> {
    let scale = exactly::<3>(own, "scale")?.unwrap_or([1.0; 3]);
    let origin = exactly::<3>(own, "refpos")?.unwrap_or([0.0; 3]);
    let turned = exactly::<4>(own, "refquat")?.map(of_quaternion).unwrap_or_default();
    let back = Pose { offset: origin, rotations: turned }.inverse();
    let place = |v: Vector| {
        let scaled = [0, 1, 2].map(|k| scale[k] * v[k]);
        back.then(&Pose { offset: scaled, rotations: Vec::new() }).offset
    };
    let triangles: Vec<Triangle> = triangles(own, folder, include)?.into_iter().map(|three| three.map(place)).collect();
    let exact = match own.get("inertia") {
        None | Some("legacy") => false,
        Some("exact") => true,
        Some(other) => {
            let help = "give the body an `inertial`";
            return Err(own.wrong(format!("the inertia of a mesh by `{other}` is not known here"), help));
        }
    };
    enclosed(&triangles, exact).ok_or_else(|| own.wrong("a mesh encloses no volume", "give the body an `inertial`"))
}

fn triangles(own: &Element, folder: &str, include: Include<'_>) -> Result<Vec<Triangle>> {
    let points = numbers(own, "vertex")?;
    if !points.is_empty() {
        let faces = numbers(own, "face")?;
        let faces: Vec<usize> = faces.into_iter().map(|x| x as usize).collect();
        let points: Vec<Vector> =
            points.chunks_exact(3).map(|v| [v[0], v[1], v[2]].map(|x| f64::from(x as f32))).collect();
        let found = of_faces(&points, faces.chunks_exact(3).map(<[usize]>::to_vec));
        return found
            .ok_or_else(|| own.wrong("the faces of a mesh are not those of its vertices", "write `face` as triples"));
    }
    let file = required(own, "file")?;
    let path = if folder.is_empty() { file.to_owned() } else { format!("{}/{file}", folder.trim_end_matches('/')) };
    let bytes = include(&path).map_err(|error| {
        own.wrong(
            format!("`{path}` cannot be read: {error}"),
            "it gives a body its mass, which an `inertial` can do too",
        )
    })?;
    let read = if file.to_ascii_lowercase().ends_with(".obj") {
        of_obj(&String::from_utf8_lossy(&bytes))
    } else {
        of_stl(&bytes)
    };
    read.ok_or_else(|| own.wrong(format!("`{path}` is no mesh that is read here"), "binary STL and OBJ are"))
}

fn of_stl(bytes: &[u8]) -> Option<Vec<Triangle>> {
    let count = u32::from_le_bytes(bytes.get(80..84)?.try_into().ok()?) as usize;
    let all = bytes.get(STL.1..)?;
    if all.len() < count.checked_mul(STL.0)? {
        return None;
    }
    let number = |own: &[u8], k: usize| {
        let four = own.get(4 * k..4 * k + 4)?.try_into().ok()?;
        Some(f64::from(f32::from_le_bytes(four))).filter(|x| x.is_finite())
    };
    let vertex = |own: &[u8], v: usize| Some([number(own, 3 * v)?, number(own, 3 * v + 1)?, number(own, 3 * v + 2)?]);
    // The normal comes first.
    all.chunks_exact(STL.0).take(count).map(|own| Some([vertex(own, 1)?, vertex(own, 2)?, vertex(own, 3)?])).collect()
}

fn of_obj(text: &str) -> Option<Vec<Triangle>> {
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let all: Vec<f64> = words.map_while(|word| word.parse::<f32>().ok().map(f64::from)).collect();
                points.push([*all.first()?, *all.get(1)?, *all.get(2)?]);
            }
            Some("f") => {
                let place = |word: &str| {
                    let number: i64 = word.split('/').next()?.parse().ok()?;
                    let place = if number < 0 { points.len() as i64 + number } else { number - 1 };
                    usize::try_from(place).ok()
                };
                faces.push(words.map(place).collect::<Option<Vec<usize>>>()?);
            }
            _ => {}
        }
    }
    of_faces(&points, faces.into_iter())
}

/// Each face is a fan of triangles.
fn of_faces(points: &[Vector], faces: impl Iterator<Item = Vec<usize>>) -> Option<Vec<Triangle>> {
    let mut all = Vec::new();
    for face in faces {
        let corners: Vec<Vector> = face.into_iter().map(|place| points.get(place).copied()).collect::<Option<_>>()?;
        for k in 1..corners.len().saturating_sub(1) {
            all.push([corners[0], corners[k], corners[k + 1]]);
        }
    }
    Some(all)
}

fn enclosed(triangles: &[Triangle], exact: bool) -> Option<Mesh> {
    let minus = |a: Vector, b: Vector| [0, 1, 2].map(|k| a[k] - b[k]);
    let dot = |a: Vector, b: Vector| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    let middle = |[a, b, c]: Triangle| [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
    let area = |[a, b, c]: Triangle| norm(cross(minus(b, a), minus(c, a))) / 2.0;
    let surface: f64 = triangles.iter().map(|own| area(*own)).sum();
    let sum = |of: &dyn Fn(Triangle) -> Vector| {
        triangles.iter().fold([0.0; 3], |sum, own| {
            let more = of(*own);
            [0, 1, 2].map(|k| sum[k] + more[k])
        })
    };
    let apex = sum(&|own| middle(own).map(|x| area(own) * x / surface));
    let volume_from = |apex: Vector, own: Triangle| {
        let [a, b, c] = own.map(|v| minus(v, apex));
        let signed = dot(cross(a, b), c) / 6.0;
        if exact { signed } else { signed.abs() }
    };
    let volume: f64 = triangles.iter().map(|own| volume_from(apex, *own)).sum();
    if !(volume > 0.0 && volume.is_finite()) {
        return None;
    }
    let center = sum(&|own| {
        let share = volume_from(apex, own) / volume;
        [0, 1, 2].map(|k| share * (0.75 * middle(own)[k] + 0.25 * apex[k]))
    });
    // From there, the tetrahedra are others where they count with their sizes.
    let volume: f64 = triangles.iter().map(|own| volume_from(center, *own)).sum();
    let mut second = [[0.0; 3]; 3];
    for own in triangles {
        let share = volume_from(center, *own) / (20.0 * volume);
        let corners = own.map(|v| minus(v, center));
        let total = [0, 1, 2].map(|k| corners.iter().map(|v| v[k]).sum::<f64>());
        for i in 0..3 {
            for j in 0..3 {
                second[i][j] += share * (corners.iter().map(|v| v[i] * v[j]).sum::<f64>() + total[i] * total[j]);
            }
        }
    }
    let trace: f64 = (0..3).map(|k| second[k][k]).sum();
    let inertia = matrix(|i, j| if i == j { trace - second[i][j] } else { -second[i][j] });
    Some(Mesh { volume, unit: Inertial { pose: Pose { offset: center, rotations: Vec::new() }, mass: 1.0, inertia } })
}
