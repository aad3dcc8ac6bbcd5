//! Bodies: shapes with their masses, sizes and places in the body frame.

use super::Resolver;
use super::arguments::{Arguments, Signature};
use super::typed::Place;
use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{Body, Shape};
use crate::model::rules::physical::{Demand, Requirement};
use crate::model::simplify;
use crate::syntax::ast::{self, ItemKind, Value, ValueKind};

const SHAPES: &[Signature] = &[
    Signature {
        word: "massless",
        required: &[],
        optional: &[],
        example: "massless",
    },
    Signature {
        word: "point",
        required: &["mass"],
        optional: &["center"],
        example: "point(mass: 1 kg)",
    },
    Signature {
        word: "rod",
        required: &["mass", "length", "along"],
        optional: &["center"],
        example: "rod(mass: 1 kg, length: 1 m, along: -z)",
    },
    Signature {
        word: "disk",
        required: &["mass", "radius", "axis"],
        optional: &["center"],
        example: "disk(mass: 1 kg, radius: 0.1 m, axis: z)",
    },
    Signature {
        word: "cylinder",
        required: &["mass", "radius", "length", "axis"],
        optional: &["center"],
        example: "cylinder(mass: 1 kg, radius: 0.1 m, length: 1 m, axis: z)",
    },
    Signature {
        word: "box",
        required: &["mass", "size"],
        optional: &["center"],
        example: "box(mass: 1 kg, size: [1 m, 2 m, 3 m])",
    },
    Signature {
        word: "sphere",
        required: &["mass", "radius"],
        optional: &["center"],
        example: "sphere(mass: 1 kg, radius: 0.1 m)",
    },
    Signature {
        word: "rigid",
        required: &["mass", "inertia"],
        optional: &["center"],
        example: "rigid(mass: 1 kg, inertia: [1, 1, 1] kg*m^2)",
    },
];

impl Resolver<'_> {
    pub(super) fn bodies(&mut self) -> Vec<Body> {
        let mut bodies = Vec::new();
        for item in &self.ast.items {
            if let ItemKind::Body(body) = &item.kind
                && let Some(shape) = self.shape(body)
            {
                bodies.push(Body {
                    name: body.name.clone(),
                    shape,
                });
            }
        }
        bodies
    }

    fn shape(&mut self, body: &ast::Body) -> Option<Shape> {
        let signature = self.signature(&body.shape, "shape", SHAPES)?;
        let arguments = self.arguments(&body.shape, signature);
        let mut part = Part {
            resolver: self,
            arguments,
            body: body.name.to_string(),
        };
        // Every argument is looked at before any is found missing.
        let mass = part.positive("mass", Dimension::MASS);
        let length = part.positive("length", Dimension::LENGTH);
        let radius = part.positive("radius", Dimension::LENGTH);
        let along = part.direction("along");
        let axis = part.direction("axis");
        let size = part.size();
        let inertia = part.inertia();
        let center = part.center();
        let default = || Some([0.0; 3].map(Expr::Number));
        Some(match signature.word {
            "massless" => Shape::Massless,
            "point" => Shape::Point {
                mass: mass?,
                center: center.unwrap_or_else(default)?,
            },
            "rod" => {
                let (length, along) = (length?, along?);
                let middle = || {
                    let half = simplify::multiply(Expr::Number(0.5), length.clone());
                    along
                        .clone()
                        .map(|component| simplify::multiply(half.clone(), component))
                };
                let center = center.unwrap_or_else(|| Some(middle()))?;
                Shape::Rod {
                    mass: mass?,
                    length,
                    along,
                    center,
                }
            }
            "disk" => Shape::Disk {
                mass: mass?,
                radius: radius?,
                axis: axis?,
                center: center.unwrap_or_else(default)?,
            },
            "cylinder" => Shape::Cylinder {
                mass: mass?,
                radius: radius?,
                length: length?,
                axis: axis?,
                center: center.unwrap_or_else(default)?,
            },
            "box" => Shape::Cuboid {
                mass: mass?,
                size: size?,
                center: center.unwrap_or_else(default)?,
            },
            "sphere" => Shape::Sphere {
                mass: mass?,
                radius: radius?,
                center: center.unwrap_or_else(default)?,
            },
            _ => Shape::Rigid {
                mass: mass?,
                center: center.unwrap_or_else(default)?,
                inertia: inertia?,
            },
        })
    }
}

/// The arguments of one body while they are resolved.
struct Part<'a, 'b, 'c> {
    resolver: &'a mut Resolver<'b>,
    arguments: Arguments<'c>,
    body: String,
}

impl Part<'_, '_, '_> {
    fn require(&mut self, what: &str, values: Vec<Expr>, demand: Demand, value: &Value) {
        self.resolver.requirements.push(Requirement {
            what: format!("the {what} of `{}`", self.body),
            values,
            demand,
            extent: value.extent,
        });
    }

    fn positive(&mut self, name: &str, dimension: Dimension) -> Option<Expr> {
        let value = self.arguments.get(name)?;
        let what = format!("`{name}`");
        let expr = self.resolver.scalar_of(value, dimension, &what)?;
        self.require(name, vec![expr.clone()], Demand::Positive(dimension), value);
        Some(expr)
    }

    fn direction(&mut self, name: &str) -> Option<Vector> {
        let value = self.arguments.get(name)?;
        self.resolver.direction(value, Place::Parameter)
    }

    fn size(&mut self) -> Option<Vector> {
        let value = self.arguments.get("size")?;
        let (size, quantity) = self.resolver.vector(value, Place::Parameter)?;
        self.resolver
            .expect(quantity, Dimension::LENGTH, "`size`", value)?;
        for edge in &size {
            let demand = Demand::Positive(Dimension::LENGTH);
            self.require("size", vec![edge.clone()], demand, value);
        }
        Some(size)
    }

    /// Nothing when not given, nothing inside when wrong.
    fn center(&mut self) -> Option<Option<Vector>> {
        let value = self.arguments.get("center")?;
        Some(self.resolver.position(value, "`center`"))
    }

    /// Three moments, or the six entries of the tensor.
    fn inertia(&mut self) -> Option<[Expr; 6]> {
        let value = self.arguments.get("inertia")?;
        let ValueKind::Vector(entries, unit) = &value.bare().kind else {
            return self.wrong_inertia(value);
        };
        if entries.len() != 3 && entries.len() != 6 {
            return self.wrong_inertia(value);
        }
        let scale = match unit {
            Some(unit) => self.resolver.unit(unit).map(Some),
            None => Some(None),
        };
        let scalars: Vec<_> = entries
            .iter()
            .map(|entry| (entry, self.resolver.scalar(entry, Place::Parameter)))
            .collect();
        let scale = scale?;
        let mut tensor = Vec::new();
        for (entry, scalar) in scalars {
            let resolved = scalar.and_then(|(expr, quantity)| match scale {
                // The unit behind the bracket belongs to every entry.
                Some((dimension, scale)) => {
                    let product = quantity.dimension().times(dimension);
                    let quantity = self.resolver.in_range(product, value.extent)?;
                    self.resolver
                        .expect(quantity, Dimension::INERTIA, "`inertia`", value)?;
                    Some(simplify::multiply(Expr::Number(scale), expr))
                }
                None => {
                    self.resolver.expect(
                        quantity,
                        Dimension::INERTIA,
                        "an entry of `inertia`",
                        entry,
                    )?;
                    Some(expr)
                }
            });
            match resolved {
                Some(expr) => tensor.push(expr),
                // One wrong unit behind the bracket is one mistake.
                None if scale.is_some() => return None,
                None => {}
            }
        }
        if tensor.len() != entries.len() {
            return None;
        }
        tensor.resize(6, Expr::Number(0.0));
        let tensor: [Expr; 6] = tensor.try_into().ok()?;
        self.require("inertia", tensor.to_vec(), Demand::Inertia, value);
        Some(tensor)
    }

    fn wrong_inertia(&mut self, value: &Value) -> Option<[Expr; 6]> {
        self.resolver.diagnostics.error_with_help(
            value.extent,
            "an inertia has 3 or 6 entries",
            "write `[Jxx, Jyy, Jzz] kg*m^2` or `[Jxx, Jyy, Jzz, Jxy, Jyz, Jxz] kg*m^2`",
        );
        None
    }
}
