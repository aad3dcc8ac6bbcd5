//! Constraints given by expressions: couplings of two coordinates, and the user's own equations.

use super::super::arguments::Arguments;
use super::super::coordinates;
use super::super::exerted::Exerted;
use super::super::expected::Expected;
use super::super::resolver::Resolver;
use super::super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::base::ids::CoordinateId;
use crate::base::span::Extent;
use crate::model::expression::Expr;
use crate::model::mechanism::{ConstraintLaw, CoordinateQuantity};
use crate::model::rules::physical::Demand;
use crate::model::simplify;
use crate::syntax::ast::Value;

type CoordinateReference = (CoordinateId, CoordinateQuantity);

impl Resolver<'_> {
    /// `of = ratio * with + offset`.
    pub(super) fn coupling(&mut self, arguments: &Arguments) -> Option<(ConstraintLaw, Exerted)> {
        let (of, with) = self.coupled(arguments);
        let ratio = self.ratio(arguments, of, with);
        let offset = of.map(|(_, quantity)| quantity.either(Expected::angle(), Dimension::LENGTH.into()));
        let offset = self.coefficient_or_zero(arguments, "offset", offset);
        let ((of, quantity), (with, _)) = (of?, with?);
        self.coupled_motions(arguments, of, with)?;
        let (of, with) = (Expr::Coordinate(of), Expr::Coordinate(with));
        let driving = simplify::multiply(ratio?, with);
        let zero = simplify::subtract(simplify::subtract(of, driving), offset?);
        let dimension = coordinates::dimension(quantity);
        self.equation_with_reaction(zero, dimension, arguments.get("of")?)
    }

    /// The two coordinates, which must be different.
    fn coupled(&mut self, arguments: &Arguments) -> (Option<CoordinateReference>, Option<CoordinateReference>) {
        let mut find = |name| {
            let name = self.name_of(arguments.get(name)?, "coordinate")?;
            self.coordinate(name)
        };
        let (of, with) = (find("of"), find("with"));
        if let (Some((first, _)), Some((second, _)), Some(value)) = (of, with, arguments.get("with"))
            && first == second
        {
            let message = "a coordinate cannot be coupled with itself";
            self.diagnostics.error(value.extent, message);
            return (None, None);
        }
        (of, with)
    }

    /// The displacement of `of` per unit displacement of `with`.
    fn ratio(
        &mut self,
        arguments: &Arguments,
        of: Option<CoordinateReference>,
        with: Option<CoordinateReference>,
    ) -> Option<Expr> {
        use CoordinateQuantity::{Angle, Displacement};
        let expected = of.zip(with).map(|((_, of), (_, with))| match (of, with) {
            (Angle, Angle) | (Displacement, Displacement) => Expected::ratio(),
            (Displacement, Angle) => Expected::travel_per_angle(),
            (Angle, Displacement) => Expected::angle_per_travel(),
        });
        let ratio = self.coefficient(arguments, "ratio", expected)?;
        let extent = arguments.get("ratio")?.extent;
        self.require("this ratio", [ratio.clone()], Demand::Ratio, extent);
        Some(ratio)
    }

    /// Coordinates that run can be coupled with each other, and so can those at rest; two drives would contradict each
    /// other.
    fn coupled_motions(&mut self, arguments: &Arguments, of: CoordinateId, with: CoordinateId) -> Option<()> {
        let extent = arguments.get("with")?.extent;
        let name = |id: CoordinateId| Some(self.coordinates.get(id.index())?.name.to_string());
        let (first, second) = (name(of)?, name(with)?);
        if self.is_driven(of) && self.is_driven(with) {
            return self.refuse_with_help(
                extent,
                format!("`{first}` and `{second}` are both driven: nothing is left to couple"),
                "leave out one of the drives, and let that coordinate be `coasting`",
            );
        }
        let (running, at_rest) = match (self.runs(of)?, self.runs(with)?) {
            (true, false) => (first, second),
            (false, true) => (second, first),
            _ => return Some(()),
        };
        self.refuse_with_help(
            extent,
            format!("`{running}` runs, but `{at_rest}` is at rest in steady motion"),
            format!("let `{at_rest}` be `coasting`"),
        )
    }

    /// An expression of coordinates and points.
    pub(super) fn equation(&mut self, arguments: &Arguments) -> Option<(ConstraintLaw, Exerted)> {
        let value = arguments.get("zero")?;
        let (zero, quantity) = self.scalar(value, ValueContext::Equation)?;
        let unknown = zero.leaves().into_iter().any(|leaf| match leaf {
            Expr::Coordinate(id) => !self.is_driven(*id),
            Expr::Position(point, _) => self.point_moves(*point),
            _ => false,
        });
        if !unknown {
            return self.refuse_with_help(
                value.extent,
                "this equation ties nothing: no free coordinate enters it",
                "write it with coordinates, or with positions of points",
            );
        }
        self.runs_without_points(&zero, value.extent)?;
        self.equation_with_reaction(zero, quantity.dimension(), value)
    }

    /// Rejects points in an equation with running coordinates: such an equation applies to rates, which points do not
    /// have.
    fn runs_without_points(&mut self, zero: &Expr, extent: Extent) -> Option<()> {
        let leaves = zero.leaves();
        let has_points = leaves.iter().any(|leaf| matches!(leaf, Expr::Position(..)));
        let mut running = leaves.into_iter().filter_map(|leaf| match leaf {
            Expr::Coordinate(id) if self.runs(*id) == Some(true) => Some(*id),
            _ => None,
        });
        let Some(id) = running.next().filter(|_| has_points) else {
            return Some(());
        };
        let name = self.coordinates.get(id.index())?.name;
        self.refuse_with_help(
            extent,
            format!("`{name}` runs, so it has no place that could be tied to a point"),
            "an equation of running coordinates holds no points",
        )
    }

    /// The equation, with its reaction: this does work on changes of the expression.
    fn equation_with_reaction(
        &mut self,
        zero: Expr,
        dimension: Dimension,
        value: &Value,
    ) -> Option<(ConstraintLaw, Exerted)> {
        let work = Dimension::MOMENT.over(dimension);
        let quantity = self.in_range(work, value.extent)?;
        let unit = self.unit_of(&zero, dimension);
        let exerted = Exerted::Number(quantity.dimension());
        Some((ConstraintLaw::Equation { zero, unit }, exerted))
    }

    fn is_driven(&self, id: CoordinateId) -> bool {
        let declared = self.coordinates.get(id.index());
        declared.is_some_and(|declared| declared.motion.is_given())
    }

    /// Whether a coordinate keeps moving in steady motion; `None` if its joint is wrong.
    pub(in crate::model::resolve) fn runs(&self, id: CoordinateId) -> Option<bool> {
        let declared = self.coordinates.get(id.index())?;
        let mut resolved = self.declared_coordinates.iter();
        let declaration = resolved.find(|resolved| resolved.joint == declared.joint && resolved.name == *declared.name);
        declaration.map(|x| x.motion.runs())
    }
}
