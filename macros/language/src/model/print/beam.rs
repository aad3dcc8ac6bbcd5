//! Beams as text.

use std::fmt::{self, Formatter};

use super::super::expression::Expr;
use super::super::mechanism::{Beam, Section};
use super::Names;

impl Names<'_> {
    /// The beam, its sections at the places of quadrature, and its stations.
    pub(super) fn beam(&self, f: &mut Formatter, beam: &Beam) -> fmt::Result {
        let body = &self.0.bodies[beam.body.index()].name;
        let [along, across, up] = beam.axes.each_ref().map(|axis| self.vector(axis));
        let [torsion, y, z] = beam.coordinates.each_ref().map(Vec::len);
        let [stretch, shear_y, shear_z] = beam.strains.each_ref().map(Vec::len);
        let shear = match beam.static_shear {
            true => "static".to_owned(),
            false => format!("{shear_y} {shear_z}"),
        };
        writeln!(
            f,
            "beam {}: on {body} length {} along {along} across {across} up {up} torsion {torsion} bending_y {y} bending_z {z} stretch {stretch} shear {shear} spin {} lag {}",
            beam.name,
            self.scalar(&beam.length),
            self.scalar(&beam.spin),
            self.scalar(&beam.lag)
        )?;
        for (fraction, weight, section) in &beam.sections {
            let Section { mass, inertia, center, stiffness, against_strain, coupling, twist, prebend, size } = section;
            let [twisting, about_y, about_z] = stiffness.each_ref().map(|stiffness| self.scalar(stiffness));
            let [axial, shear_y, shear_z] = against_strain.each_ref().map(|against_strain| self.scalar(against_strain));
            let [width, height] = size.each_ref().map(|size| self.scalar(size));
            let [inertia_y, inertia_z] = inertia.each_ref().map(|inertia| self.scalar(inertia));
            write!(
                f,
                "  at {fraction} of weight {weight}: mass {} inertia {inertia_y} {inertia_z} GJ {twisting} EIy {about_y} EIz {about_z} EA {axial} GAy {shear_y} GAz {shear_z} twist {} size {width} {height}",
                self.scalar(mass),
                self.scalar(twist)
            )?;
            if *center != [Expr::Number(0.0), Expr::Number(0.0)] {
                let [y, z] = center.each_ref().map(|center| self.scalar(center));
                write!(f, " center {y} {z}")?;
            }
            if *prebend != [Expr::Number(0.0), Expr::Number(0.0)] {
                let [y, z] = prebend.each_ref().map(|prebend| self.scalar(prebend));
                write!(f, " prebend {y} {z}")?;
            }
            for (i, j, coefficient) in coupling {
                write!(f, " couples {i} {j} by {}", self.scalar(coefficient))?;
            }
            writeln!(f)?;
        }
        for station in &beam.stations {
            let body = &self.0.bodies[station.body.index()].name;
            writeln!(f, "  station {body} at {}", station.place)?;
        }
        Ok(())
    }
}
