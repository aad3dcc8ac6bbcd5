//! The syntax tree of a declaration: items in the user's order, every leaf with its position.

use std::ops::Range;

use proc_macro2::{Ident, TokenStream};

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
    /// Where the parts among the items come from.
    pub uses: Uses,
    /// Tables and matrices that values name: names and texts.
    pub files: Vec<(String, String)>,
}

impl Ast {
    /// Everything that items of one kind declare, in order.
    pub fn all<'a, T: Declaration + 'a>(&'a self) -> impl Iterator<Item = &'a T> + Clone {
        self.items.iter().filter_map(|item| T::of(&item.kind))
    }
}

/// The instances of parts in a declaration. Any two are equal, as positions are.
#[derive(Clone, Debug, Default)]
pub struct Uses(pub Vec<Use>);

impl PartialEq for Uses {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// An instance of a part.
#[derive(Clone, Debug)]
pub struct Use {
    /// Its name.
    pub name: Ident,
    /// The name of the part.
    pub part: String,
    /// The items of the part as written.
    pub tokens: TokenStream,
}

/// Keywords of items without a name.
const NAMELESS: [&str; 6] = ["gravity", "kernels", "every", "correlated", "cyclic", "steady"];

/// The known parts of an item that could not be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Unread {
    /// The word that the item starts with.
    pub keyword: Option<Ident>,
    /// The names that the item would have declared, as far as they could be read.
    pub names: Vec<Ident>,
}

impl Unread {
    /// Whether it may be a body, a joint or a constraint; false only if its keyword says otherwise.
    pub fn may_connect(&self) -> bool {
        const OTHERS: [&str; 14] = [
            "correlated",
            "input",
            "design",
            "let",
            "curve",
            "gravity",
            "kernels",
            "point",
            "force",
            "every",
            "unbalance",
            "material",
            "steady",
            "output",
        ];
        !self.starts_with(&OTHERS)
    }

    /// Whether its keyword implies that it declares no name.
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
    /// The kind of the item, with its content.
    pub kind: ItemKind,
}

/// The kind of an item, with its content.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemKind {
    /// `input NAME: UNIT [TOLERANCE];`
    Input(Input),
    /// `design NAME = VALUE [TOLERANCE];`
    Design(Design),
    /// `let NAME = VALUE;` or `let NAME: UNIT = VALUE;`
    Let(Stated),
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
    /// `unbalance NAME: on BODY, ...;`
    Unbalance(Unbalance),
    /// `material NAME: QUANTITY VALUE, ...;`
    Material(Material),
    /// `constraint NAME: KIND(...);`
    Constraint(Constraint),
    /// `correlated NUMBER: NAME, NAME, ...;`
    Correlated(Correlated),
    /// `cyclic NAME[RANGE] about DIRECTION;`
    Cyclic(Cyclic),
    /// `steady UNKNOWN = VALUE;`
    Steady(Named),
    /// `output NAME = VALUE;` or `output NAME: UNIT = VALUE;`
    Output(Stated),
}

/// What items of one kind declare.
pub trait Declaration {
    /// The declaration, if the item is of this kind.
    fn of(kind: &ItemKind) -> Option<&Self>;
}

macro_rules! declarations {
    ($($kind:ident($content:ty),)+) => {$(
        impl Declaration for $content {
            fn of(kind: &ItemKind) -> Option<&Self> {
                match kind {
                    ItemKind::$kind(declared) => Some(declared),
                    _ => None,
                }
            }
        }
    )+};
}

declarations! {
    Input(Input),
    Design(Design),
    Curve(Curve),
    Gravity(Gravity),
    Body(Body),
    Joint(Joint),
    Point(Point),
    Force(Force),
    Every(Every),
    Material(Material),
    Constraint(Constraint),
    Correlated(Correlated),
    Cyclic(Cyclic),
    Steady(Named),
}

impl ItemKind {
    /// The declared name, if there is one.
    pub fn name(&self) -> Option<&Ident> {
        match self {
            ItemKind::Input(input) => Some(&input.name),
            ItemKind::Design(design) => Some(&design.name),
            ItemKind::Let(named) => Some(&named.name),
            ItemKind::Output(output) => Some(&output.name),
            ItemKind::Curve(curve) => Some(&curve.name),
            ItemKind::Gravity(_)
            | ItemKind::KernelsOnly(_)
            | ItemKind::Every(_)
            | ItemKind::Correlated(_)
            | ItemKind::Cyclic(_)
            | ItemKind::Steady(_) => None,
            ItemKind::Body(body) => Some(&body.name),
            ItemKind::Joint(joint) => Some(&joint.name),
            ItemKind::Point(point) => Some(&point.name),
            ItemKind::Force(force) => Some(&force.name),
            ItemKind::Unbalance(unbalance) => Some(&unbalance.name),
            ItemKind::Material(material) => Some(&material.name),
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
    /// Tolerance about the value given at run time.
    pub tolerance: Option<Tolerance>,
}

/// A design variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Name.
    pub name: Ident,
    /// Nominal value.
    pub nominal: Value,
    /// Tolerance about the nominal value.
    pub tolerance: Option<Tolerance>,
}

/// Limits about a value, and the distribution between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    /// The limits.
    pub limits: Limits,
    /// The numbers of the limits with their units, without the `+/-`; for a list of values, the whole list.
    pub extent: Extent,
    /// The distribution; normal if absent.
    pub law: Option<Law>,
}

/// Limits as written.
#[derive(Clone, Debug, PartialEq)]
pub enum Limits {
    /// `+/- 3%`: the same on both sides, in percent of the value.
    Percent(f64),
    /// `+/- 1 mm`: the same on both sides.
    HalfWidth(Value),
    /// `+0.1 -0.05 mm`: different on each side.
    Deviations(Box<Deviations>),
    /// `one of [1.9, 2.0, 2.1] mm`: the possible values.
    Values(Box<Values>),
}

/// A list of possible values.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    /// The values, as a list.
    pub values: Value,
    /// A list of relative frequencies, on any scale; all equal if absent.
    pub weights: Option<Value>,
}

/// The limits minus the value.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviations {
    /// The first number, for the upper limit.
    pub upper: Deviation,
    /// The second number, for the lower limit.
    pub lower: Deviation,
}

impl Deviations {
    /// The measure of the upper number: if nothing follows it, the measure of the lower one.
    pub fn upper_measure(&self) -> &Measure {
        if self.shares_measure() { &self.lower.measure } else { &self.upper.measure }
    }

    /// Whether both numbers share one measure: `+0.1 -0.05 mm`.
    pub fn shares_measure(&self) -> bool {
        self.upper.measure == Measure::Bare && self.lower.measure != Measure::Bare
    }
}

/// A signed number; a zero may lack the sign.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// The number.
    pub number: f64,
    /// The measure that follows the number.
    pub measure: Measure,
    /// From its sign to its last token.
    pub extent: Extent,
}

/// The measure of a number.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// Nothing follows the number.
    Bare,
    /// Percent.
    Percent,
    /// A unit.
    Unit(Unit),
}

/// A distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// The kind of distribution.
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

/// A steady value.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Name.
    pub name: Ident,
    /// Value.
    pub value: Value,
}

/// A name for a value: a `let` or an output.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    /// Name.
    pub name: Ident,
    /// Unit in which it is stated.
    pub unit: Option<Unit>,
    /// Value.
    pub value: Value,
}

/// A curve through points.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name.
    pub name: Ident,
    /// Arguments, in increasing order.
    pub arguments: Value,
    /// The value at each argument.
    pub values: Value,
}

/// The acceleration of gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct Gravity {
    /// The item's keyword.
    pub keyword: Extent,
    /// Magnitude, or the whole vector if no direction is given.
    pub value: Value,
    /// Direction.
    pub along: Option<Value>,
}

/// A body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name.
    pub name: Ident,
    /// The terms that it consists of, in order: `disk(...) + rod(...) at [0, 0, 10 cm] - cylinder(...)`.
    pub terms: Vec<Term>,
    /// `spinning at SPEED`: a beam that turns about its own bent axis.
    pub spinning: Option<Value>,
}

/// A shape that is added to a body or cut out of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Whether it follows a minus sign.
    pub hole: bool,
    /// `massless`, or a shape with its arguments.
    pub shape: NamedCall,
    /// Placement of its frame in the body frame.
    pub placement: Option<Placement>,
}

/// A word with named arguments: `rod(mass: m1, length: l1, along: -z)`.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCall {
    /// The word.
    pub word: Ident,
    /// The arguments; `None` if there are no parentheses.
    pub arguments: Option<Vec<Argument>>,
}

impl NamedCall {
    /// The values of the arguments, last first.
    fn values(&self) -> impl Iterator<Item = &Value> {
        self.arguments.iter().flatten().rev().map(|argument| &argument.value)
    }
}

/// A named argument.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// Name of the argument.
    pub name: Ident,
    /// Its value.
    pub value: Value,
    /// `of DRIVE`: what an order is counted in.
    pub of: Option<Ident>,
}

/// A joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name.
    pub name: Ident,
    /// A word such as `revolute`.
    pub kind: Ident,
    /// The arguments in parentheses after the kind.
    pub arguments: Option<Vec<JointArgument>>,
    /// Frame before `to`.
    pub from: Ident,
    /// The place along a beam before `to`.
    pub from_station: Option<Value>,
    /// Frame after `to`.
    pub to: Ident,
    /// Placements, drives and other clauses of the joint, in order.
    pub clauses: Vec<JointClause>,
}

/// An axis, or another value that a joint needs: `z`, `turn: z`, `lead: 5 mm`.
#[derive(Clone, Debug, PartialEq)]
pub struct JointArgument {
    /// The name before the colon.
    pub name: Option<Ident>,
    /// The value.
    pub value: Value,
}

/// A clause after the two frames of a joint.
#[derive(Clone, Debug, PartialEq)]
pub enum JointClause {
    /// `at VECTOR rotated(DIRECTION, ANGLE) on BODY`.
    Placement {
        /// Placement of the joint's frame.
        placement: Placement,
        /// `on BODY`; the `from` side if absent.
        on: Option<Ident>,
    },
    /// `COORDINATE driven at SPEED`.
    Drive(Drive),
    /// `COORDINATE coasting`.
    Coast(Coast),
    /// `COORDINATE shaken(...)`.
    Shake(Shake),
    /// `cut`.
    Cut(Extent),
}

/// A coordinate that coasts at a speed of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Coast {
    /// Name of the coordinate; if absent, all coordinates of the joint.
    pub coordinate: Option<Ident>,
    /// The word `coasting`.
    pub keyword: Extent,
}

/// A coordinate that is shaken about zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Shake {
    /// Name of the coordinate; if absent, the joint's only one.
    pub coordinate: Option<Ident>,
    /// `shaken` with its arguments.
    pub call: NamedCall,
}

/// A coordinate whose motion is prescribed.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Name of the coordinate; if absent, the joint's only one.
    pub coordinate: Option<Ident>,
    /// The word `driven`.
    pub keyword: Extent,
    /// The speed.
    pub speed: Value,
}

/// Placement of one frame in another.
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
    /// Placement in that frame; at the origin if absent.
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

impl Force {
    /// Whether it is an excitation.
    pub fn is_harmonic(&self) -> bool {
        self.law.word == "harmonic"
    }
}

/// A deviation of a turning body from symmetry about its axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Unbalance {
    /// Name.
    pub name: Ident,
    /// The body.
    pub on: Ident,
    /// `unbalance` with its named arguments.
    pub call: NamedCall,
    /// `at VECTOR` in the body's frame.
    pub at: Option<Value>,
}

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name.
    pub name: Ident,
    /// `material` with its properties as named arguments.
    pub call: NamedCall,
}

/// Design variables of one batch.
#[derive(Clone, Debug, PartialEq)]
pub struct Correlated {
    /// The linear correlation of any two.
    pub correlation: f64,
    /// Names as written, whose indices may be ranges, and where they stand.
    pub names: Vec<(String, Extent)>,
    /// The item's keyword.
    pub keyword: Extent,
}

/// Equal instances around an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Cyclic {
    /// Their name without index.
    pub name: Ident,
    /// Their indices, in the sense of a positive rotation.
    pub members: Range<u32>,
    /// The axis, in the frame that carries them.
    pub about: Value,
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
    /// The kind of value.
    pub kind: ValueKind,
    /// From its first to its last token.
    pub extent: Extent,
    /// Number of levels below it; the parser bounds it, so that recursion over the tree is safe.
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
    /// `tube(outer: a, inner: b) to tube(outer: c, inner: d)`: cross-sections, only as an argument.
    Sections(Vec<NamedCall>),
    /// `0.4 length`: a place along a beam, only after `at`.
    Fraction(f64),
    /// `station 4`: the end of a section of a shaft, counted from 1; 0 is its root. Of a superelement its fourth. Only after
    /// `at`.
    Station(u32),
    /// `"sections.csv"`: a table or a matrix in a file, only as an argument.
    File(String),
    /// `(a)`: kept in the tree because `(3 kg) * m` is not `3 kg * m`.
    Parenthesised(Box<Value>),
}

/// An operation on two values.
#[derive(Clone, Debug, PartialEq)]
pub struct Binary {
    /// The operator.
    pub operator: Operator,
    /// The position of its sign.
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
            ValueKind::Number(..)
            | ValueKind::Name(_)
            | ValueKind::Fraction(_)
            | ValueKind::Station(_)
            | ValueKind::File(_)
            | ValueKind::Sections(_) => None,
            ValueKind::Vector(values, _) | ValueKind::Call(_, values) => tallest(values),
            ValueKind::Negate(of) | ValueKind::Component(of, _) => Some(of.height),
            ValueKind::Parenthesised(of) => Some(of.height),
            ValueKind::Binary(binary) => Some(binary.left.height.max(binary.right.height)),
        };
        Self { kind, extent: extent.into(), height: below.map_or(0, |height| height.saturating_add(1)) }
    }

    /// Every name in the value that stands for a value, in order.
    pub fn names(&self) -> Vec<&Ident> {
        self.parts()
            .into_iter()
            .filter_map(|part| match &part.kind {
                ValueKind::Name(name) => Some(name),
                _ => None,
            })
            .collect()
    }

    /// Every unit in the value with the number before it, in order; units of vectors have no number.
    pub fn units(&self) -> Vec<(Option<f64>, &Unit)> {
        let units = self.parts().into_iter().map(|part| match &part.kind {
            ValueKind::Number(number, Some(unit)) => Some((Some(*number), unit)),
            ValueKind::Vector(_, Some(unit)) => Some((None, unit)),
            _ => None,
        });
        units.flatten().collect()
    }

    /// The value and all values in it, in order.
    fn parts(&self) -> Vec<&Value> {
        let mut parts = Vec::new();
        let mut rest = vec![self];
        while let Some(value) = rest.pop() {
            parts.push(value);
            match &value.kind {
                ValueKind::Number(..)
                | ValueKind::Name(_)
                | ValueKind::Fraction(_)
                | ValueKind::Station(_)
                | ValueKind::File(_) => {}
                ValueKind::Sections(calls) => {
                    let arguments = calls.iter().rev().flat_map(NamedCall::values);
                    rest.extend(arguments);
                }
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
