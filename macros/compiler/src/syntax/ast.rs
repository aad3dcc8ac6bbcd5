//! The tree of a declaration, item by item in the user's order, every leaf with its position.

use proc_macro2::Ident;

use crate::base::span::Extent;

/// A declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct Ast {
    /// Doc comments and other attributes.
    pub attributes: Vec<syn::Attribute>,
    /// Visibility of the generated type.
    pub visibility: syn::Visibility,
    /// Name of the mechanism.
    pub name: Ident,
    /// Items in order.
    pub items: Vec<Item>,
    /// Items with a syntax error, in order.
    pub unread: Vec<Unread>,
}

/// The words that start an item without a name.
const NAMELESS: [&str; 3] = ["gravity", "kernels", "every"];

/// What is known of an item that could not be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Unread {
    /// The word it starts with.
    pub keyword: Option<Ident>,
    /// The names it would have declared, as far as they could be read.
    pub names: Vec<Ident>,
}

impl Unread {
    /// Unless its keyword says otherwise, it may be a body, a joint or a constraint.
    pub fn may_connect(&self) -> bool {
        const OTHERS: [&str; 10] = [
            "input", "design", "let", "curve", "gravity", "kernels", "point", "force", "every",
            "output",
        ];
        !self.starts_with(&OTHERS)
    }

    /// Its keyword says that it declares no name.
    pub fn is_nameless(&self) -> bool {
        self.starts_with(&NAMELESS)
    }

    fn starts_with(&self, words: &[&str]) -> bool {
        let keyword = self.keyword.as_ref();
        keyword.is_some_and(|keyword| words.iter().any(|word| keyword == word))
    }
}

/// An item with its documentation.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Lines of doc comments.
    pub docs: Vec<String>,
    /// What it declares.
    pub kind: ItemKind,
}

/// What an item declares.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemKind {
    /// `input NAME: UNIT [TOLERANCE];`
    Input(Input),
    /// `design NAME = VALUE [TOLERANCE];`
    Design(Design),
    /// `let NAME = VALUE;`
    Let(Named),
    /// `curve NAME: ARGUMENTS -> VALUES;`
    Curve(Curve),
    /// `gravity ...;`
    Gravity(Gravity),
    /// `kernels only;`
    KernelsOnly(Extent),
    /// `body NAME: SHAPE;`
    Body(Body),
    /// `joint NAME: KIND from FRAME to FRAME ...;`
    Joint(Joint),
    /// `point NAME: FRAME [at VECTOR];`
    Point(Point),
    /// `force NAME: LAW;`
    Force(Force),
    /// `every QUANTITY: LAW;`
    Every(Every),
    /// `constraint NAME: KIND(...);`
    Constraint(Constraint),
    /// `output NAME = VALUE;`
    Output(Named),
}

impl ItemKind {
    /// The declared name, where there is one.
    pub fn name(&self) -> Option<&Ident> {
        match self {
            ItemKind::Input(input) => Some(&input.name),
            ItemKind::Design(design) => Some(&design.name),
            ItemKind::Let(named) | ItemKind::Output(named) => Some(&named.name),
            ItemKind::Curve(curve) => Some(&curve.name),
            ItemKind::Gravity(_) | ItemKind::KernelsOnly(_) | ItemKind::Every(_) => None,
            ItemKind::Body(body) => Some(&body.name),
            ItemKind::Joint(joint) => Some(&joint.name),
            ItemKind::Point(point) => Some(&point.name),
            ItemKind::Force(force) => Some(&force.name),
            ItemKind::Constraint(constraint) => Some(&constraint.name),
        }
    }
}

/// An operating parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Name.
    pub name: Ident,
    /// Unit in which a user gives it.
    pub unit: Unit,
    /// How it varies about the value it is given.
    pub tolerance: Option<Tolerance>,
}

/// A design variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Name.
    pub name: Ident,
    /// Nominal value.
    pub nominal: Value,
    /// How it varies about the nominal value.
    pub tolerance: Option<Tolerance>,
}

/// Limits about a value, and the distribution between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    /// The limits.
    pub limits: Limits,
    /// The numbers of the limits with their units, not the `+/-`; or the whole list of values.
    pub extent: Extent,
    /// The distribution; normal when absent.
    pub law: Option<Law>,
}

/// Limits as they are written.
#[derive(Clone, Debug, PartialEq)]
pub enum Limits {
    /// `+/- 3%`: the same on either side, in percent of the value.
    Percent(f64),
    /// `+/- 1 mm`: the same on either side.
    HalfWidth(Value),
    /// `+0.1 -0.05 mm`: unequal ones.
    Deviations(Box<Deviations>),
    /// `one of [1.9, 2.0, 2.1] mm`: what it may be.
    Values(Box<Values>),
}

/// What a value may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    /// A list of values.
    pub values: Value,
    /// A list of how often each occurs, to some scale; all alike when absent.
    pub weights: Option<Value>,
}

/// The limits less the value.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviations {
    /// The first.
    pub upper: Deviation,
    /// The second.
    pub lower: Deviation,
}

impl Deviations {
    /// What the upper number is measured in: where nothing follows it, in what follows the lower one.
    pub fn upper_measure(&self) -> &Measure {
        if self.shares_measure() {
            &self.lower.measure
        } else {
            &self.upper.measure
        }
    }

    /// What the numbers are measured in stands once for both: `+0.1 -0.05 mm`.
    pub fn shares_measure(&self) -> bool {
        self.upper.measure == Measure::Bare && self.lower.measure != Measure::Bare
    }
}

/// A number with its sign; a zero may have none.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// The number.
    pub number: f64,
    /// What follows it.
    pub measure: Measure,
    /// From its sign to its last token.
    pub extent: Extent,
}

/// What a number is measured in.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// Nothing follows the number.
    Bare,
    /// In percent.
    Percent,
    /// In a unit.
    Unit(Unit),
}

/// A distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// What it is.
    pub kind: LawKind,
    /// From its first to its last token.
    pub extent: Extent,
}

/// Kinds of distribution.
#[derive(Clone, Debug, PartialEq)]
pub enum LawKind {
    /// `normal`.
    Normal,
    /// `truncated normal`.
    TruncatedNormal,
    /// `uniform`.
    Uniform,
    /// `triangular`.
    Triangular,
    /// `lognormal`.
    Lognormal,
    /// `weibull`.
    Weibull,
    /// `beta(ALPHA, BETA)`.
    Beta(Box<[Value; 2]>),
}

/// A name for a value: a `let` or an output.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Name.
    pub name: Ident,
    /// Value.
    pub value: Value,
}

/// A curve through points.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name.
    pub name: Ident,
    /// Arguments, growing.
    pub arguments: Value,
    /// The value at each.
    pub values: Value,
}

/// The acceleration of gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct Gravity {
    /// The item's keyword.
    pub keyword: Extent,
    /// Magnitude, or the whole vector when no direction is given.
    pub value: Value,
    /// Direction.
    pub along: Option<Value>,
}

/// A body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name.
    pub name: Ident,
    /// What it is made of, in order: `disk(...) + rod(...) at [0, 0, 10 cm] - cylinder(...)`.
    pub terms: Vec<Term>,
}

/// A shape that adds to a body, or that is missing from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// It follows a minus.
    pub hole: bool,
    /// `massless`, or a shape with its arguments.
    pub shape: NamedCall,
    /// Where its frame is in the body frame.
    pub placement: Option<Placement>,
}

/// A word with named arguments: `rod(mass: m1, length: l1, along: -z)`.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCall {
    /// The word.
    pub word: Ident,
    /// The arguments; nothing when there are no parentheses.
    pub arguments: Option<Vec<Argument>>,
}

/// A named argument.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// Name of the argument.
    pub name: Ident,
    /// Its value.
    pub value: Value,
}

/// A joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name.
    pub name: Ident,
    /// A word such as `revolute`.
    pub kind: Ident,
    /// What stands in parentheses after the kind.
    pub arguments: Option<Vec<JointArgument>>,
    /// Frame before `to`.
    pub from: Ident,
    /// Frame after `to`.
    pub to: Ident,
    /// Placements, drives and what else is said of the joint, in order.
    pub clauses: Vec<JointClause>,
}

/// An axis, or something else that a joint needs: `z`, `turn: z`, `lead: 5 mm`.
#[derive(Clone, Debug, PartialEq)]
pub struct JointArgument {
    /// The name before the colon.
    pub name: Option<Ident>,
    /// What it is.
    pub value: Value,
}

/// What may follow the two frames of a joint.
#[derive(Clone, Debug, PartialEq)]
pub enum JointClause {
    /// `at VECTOR rotated(DIRECTION, ANGLE) on BODY`.
    Placement {
        /// Where the joint's frame is.
        placement: Placement,
        /// `on BODY`; the `from` side when absent.
        on: Option<Ident>,
    },
    /// `COORDINATE driven at SPEED`.
    Drive(Drive),
    /// `COORDINATE coasting`.
    Coast(Coast),
    /// `cut`.
    Cut(Extent),
}

/// A coordinate that runs at a speed of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Coast {
    /// Its name; all coordinates of the joint when absent.
    pub coordinate: Option<Ident>,
    /// The word `coasting`.
    pub keyword: Extent,
}

/// A coordinate whose motion is prescribed.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Its name; the joint's only one when absent.
    pub coordinate: Option<Ident>,
    /// The word `driven`.
    pub keyword: Extent,
    /// The speed.
    pub speed: Value,
}

/// Where a frame is in another.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// `at VECTOR`.
    pub offset: Option<Value>,
    /// `rotated(DIRECTION, ANGLE)`, in order.
    pub rotations: Vec<(Value, Value)>,
    /// Its first word.
    pub keyword: Extent,
}

/// A point with axes, fixed in a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Name.
    pub name: Ident,
    /// The frame it is fixed in.
    pub frame: Ident,
    /// Where it is there; at the origin when absent.
    pub placement: Option<Placement>,
}

/// A force element.
#[derive(Clone, Debug, PartialEq)]
pub struct Force {
    /// Name.
    pub name: Ident,
    /// The law with its arguments.
    pub law: NamedCall,
}

/// A force on every free coordinate of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Every {
    /// `angle` or `displacement`.
    pub quantity: Ident,
    /// The law with its arguments.
    pub law: NamedCall,
}

/// A constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// Name.
    pub name: Ident,
    /// The kind with its arguments.
    pub law: NamedCall,
}

/// A value with its position.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// What it is.
    pub kind: ValueKind,
    /// From its first to its last token.
    pub extent: Extent,
    /// Levels of values below it: bounded by the parser for the sake of every recursion over the tree.
    pub height: u16,
}

/// Kinds of value.
#[derive(Clone, Debug, PartialEq)]
pub enum ValueKind {
    /// A number with an optional unit.
    Number(f64, Option<Unit>),
    /// A name.
    Name(Ident),
    /// `[a, b, c] UNIT`.
    Vector(Vec<Value>, Option<Unit>),
    /// `-a`.
    Negate(Box<Value>),
    /// `a OPERATOR b`.
    Binary(Box<Binary>),
    /// `f(a, b)`.
    Call(Ident, Vec<Value>),
    /// `a.x`.
    Component(Box<Value>, Ident),
    /// `(a)`: kept, because `(3 kg) * m` is not `3 kg * m`.
    Parenthesised(Box<Value>),
}

/// An operation on two values.
#[derive(Clone, Debug, PartialEq)]
pub struct Binary {
    /// The operation.
    pub operator: Operator,
    /// Its sign.
    pub sign: Extent,
    /// The value before the sign.
    pub left: Value,
    /// The value after the sign.
    pub right: Value,
}

/// Operations on two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `+`.
    Add,
    /// `-`.
    Subtract,
    /// `*`.
    Multiply,
    /// `/`.
    Divide,
    /// `^`.
    Power,
}

impl Operator {
    /// The sign.
    pub fn sign(self) -> char {
        match self {
            Operator::Add => '+',
            Operator::Subtract => '-',
            Operator::Multiply => '*',
            Operator::Divide => '/',
            Operator::Power => '^',
        }
    }
}

/// A unit: a product of powers of named units. No factors means a plain number, written `1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Factors in order.
    pub factors: Vec<UnitFactor>,
    /// From its first to its last token.
    pub extent: Extent,
}

/// A power of a named unit.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitFactor {
    /// Name of the unit.
    pub name: String,
    /// Its token: a literal with a suffix, or a name.
    pub extent: Extent,
    /// The exponent; negative after a division.
    pub exponent: i32,
}

impl Value {
    /// A value from its first to its last token.
    pub fn new(kind: ValueKind, extent: impl Into<Extent>) -> Self {
        let tallest = |values: &[Value]| values.iter().map(|value| value.height).max();
        let below = match &kind {
            ValueKind::Number(..) | ValueKind::Name(_) => None,
            ValueKind::Vector(values, _) | ValueKind::Call(_, values) => tallest(values),
            ValueKind::Negate(of) | ValueKind::Component(of, _) => Some(of.height),
            ValueKind::Parenthesised(of) => Some(of.height),
            ValueKind::Binary(binary) => Some(binary.left.height.max(binary.right.height)),
        };
        Self {
            kind,
            extent: extent.into(),
            height: below.map_or(0, |height| height.saturating_add(1)),
        }
    }

    /// Every name in it that stands for a value, in order.
    pub fn names(&self) -> Vec<&Ident> {
        let names = self.parts().into_iter().map(|part| match &part.kind {
            ValueKind::Name(name) => Some(name),
            _ => None,
        });
        names.flatten().collect()
    }

    /// Every unit in it with the number before it, none before that of a vector, in order.
    pub fn units(&self) -> Vec<(Option<f64>, &Unit)> {
        let units = self.parts().into_iter().map(|part| match &part.kind {
            ValueKind::Number(number, Some(unit)) => Some((Some(*number), unit)),
            ValueKind::Vector(_, Some(unit)) => Some((None, unit)),
            _ => None,
        });
        units.flatten().collect()
    }

    /// It and every value in it, in order.
    fn parts(&self) -> Vec<&Value> {
        let mut parts = Vec::new();
        let mut rest = vec![self];
        while let Some(value) = rest.pop() {
            parts.push(value);
            match &value.kind {
                ValueKind::Number(..) | ValueKind::Name(_) => {}
                ValueKind::Vector(values, _) | ValueKind::Call(_, values) => {
                    rest.extend(values.iter().rev());
                }
                ValueKind::Negate(of) | ValueKind::Component(of, _) => rest.push(of),
                ValueKind::Parenthesised(of) => rest.push(of),
                ValueKind::Binary(binary) => rest.extend([&binary.right, &binary.left]),
            }
        }
        parts
    }

    /// The value inside any number of parentheses.
    pub fn bare(&self) -> &Value {
        match &self.kind {
            ValueKind::Parenthesised(inner) => inner.bare(),
            _ => self,
        }
    }
}
