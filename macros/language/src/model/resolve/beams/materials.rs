//! Materials: density and moduli.

use proc_macro2::Ident;

use super::super::arguments::{Arguments, Signature};
use super::super::expected::Expected;
use super::super::resolver::Resolver;
use super::table::Properties;
use crate::base::dimension::Dimension;
use crate::base::nearest::nearest;
use crate::model::expression::Expr;
use crate::model::simplify::{add, divide, multiply};
use crate::syntax::ast::{Material, Value, ValueKind};

static MATERIAL: Signature<()> = Signature::new(
    "material",
    &["density", "modulus"],
    "material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;",
    (),
)
.optional(&["poisson", "shear_modulus"]);

impl Resolver<'_> {
    /// Every material is checked, used or not.
    pub(in crate::model::resolve) fn materials(&mut self) {
        for material in self.ast.all::<Material>() {
            let properties = self.declared_material(material);
            self.materials.push((material.name.to_string(), properties));
        }
    }

    fn declared_material(&mut self, material: &Material) -> Option<Properties> {
        let arguments = self.arguments(&material.call, &MATERIAL);
        self.properties(&material.name, &arguments)
    }

    /// The properties among some arguments.
    fn properties(&mut self, name: &Ident, given: &Arguments<'_>) -> Option<Properties> {
        let density = self.property(name, given, "density", Dimension::DENSITY);
        let modulus = self.property(name, given, "modulus", Dimension::PRESSURE);
        let shear = self.property(name, given, "shear_modulus", Dimension::PRESSURE);
        let poisson = match given.get("poisson") {
            Some(value) => self.poisson(value).map(Some),
            None => Some(None),
        };
        let (density, modulus, shear, poisson) = (density?, modulus?, shear?, poisson?);
        if let (Some(_), Some(_), Some(value)) = (&shear, &poisson, given.get("poisson")) {
            let message = "`shear_modulus` and `poisson` say the same: give one of them";
            return self.refuse(value.extent, message);
        }
        let shear_modulus = match (shear, &modulus, poisson) {
            (Some(shear), ..) => Some(shear),
            (None, Some(modulus), Some(poisson)) => {
                let twice = multiply(Expr::Number(2.0), add(Expr::Number(1.0), poisson));
                Some(divide(modulus.clone(), twice))
            }
            _ => None,
        };
        Some(Properties { density, modulus, shear_modulus })
    }

    /// `None` if wrong, with an inner `None` if not given.
    fn property(
        &mut self,
        name: &Ident,
        given: &Arguments<'_>,
        property: &str,
        dimension: Dimension,
    ) -> Option<Option<Expr>> {
        let Some(value) = given.get(property) else {
            return Some(None);
        };
        let expr = self.scalar_of(value, dimension, &format!("`{property}`"))?;
        let what = property.replace('_', " ");
        self.require_of_beam(name, &what, &expr, dimension, value);
        Some(Some(expr))
    }

    fn poisson(&mut self, value: &Value) -> Option<Expr> {
        let poisson = self.scalar_of(value, Expected::ratio(), "`poisson`")?;
        if let Expr::Number(number) = poisson
            && !(-1.0 < number && number <= 0.5)
        {
            let message = format!("Poisson's ratio is {number}; it lies between -1 and 0.5");
            return self.refuse(value.extent, message);
        }
        Some(poisson)
    }

    /// The material of a beam: one that is declared, or properties of its own.
    pub(in crate::model::resolve) fn material_of(&mut self, name: &Ident, given: &Arguments<'_>) -> Option<Properties> {
        let properties = self.properties(name, given);
        let Some(value) = given.get("material") else {
            return properties;
        };
        let ValueKind::Name(wanted) = &value.kind else {
            let message = "`material` is the name of a declared material";
            return self.refuse(value.extent, message);
        };
        let own_names = ["density", "modulus", "shear_modulus", "poisson"];
        let other = own_names.into_iter().find_map(|name| Some((name, given.get(name)?)));
        if let Some((other, value)) = other {
            let message = format!("a beam takes `material` or `{other}`, not both");
            let help = format!("leave out `{other}`, or declare another material");
            return self.refuse_with_help(value.extent, message, help);
        }
        let text = wanted.to_string();
        if let Some((_, material)) = self.materials.iter().find(|(name, _)| *name == text) {
            return material.clone();
        }
        self.unknown_material(wanted);
        None
    }

    pub(in crate::model::resolve) fn unknown_material(&mut self, wanted: &Ident) {
        let text = wanted.to_string();
        let known = self.materials.iter().map(|(name, _)| name.as_str());
        let help = match nearest(&text, known) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("declare it: `material {text}: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;`"),
        };
        let message = format!("unknown material `{text}`");
        self.diagnostics.error_with_help(wanted, message, help);
    }
}
