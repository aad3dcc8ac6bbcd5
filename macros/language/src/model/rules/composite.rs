//! Rules for several masses together: the remainder of a body with holes, and bodies welded together.

use super::moments::Moments;
use super::tensor::{Matrix, Vector, inertia, is_inertia_of_a_body, matrix, nearest_of_a_body, principal, trace};
use super::violation::{Violation, digits};
use crate::base::span::Extent;
use crate::model::evaluate::Values;
use crate::model::expression::Expr;
use crate::model::mechanism::{Part, Placement};

/// Bodies welded together, at least one of which has an inertia given as numbers.
#[derive(Clone, Debug)]
pub(crate) struct Welded {
    /// Name, parts, and the placements that lead into the frame of the first body, the innermost first.
    pub(crate) bodies: Vec<(String, Vec<Part>, Vec<Placement>)>,
    /// The given inertias.
    pub(crate) given: Vec<GivenInertia>,
}

/// An inertia tensor as declared.
#[derive(Clone, Debug)]
pub(crate) struct GivenInertia {
    /// Name of the body.
    pub(crate) body: String,
    /// Entries as given: xx, yy, zz, xy, yz, xz.
    pub(crate) tensor: [Expr; 6],
    /// The tensor about the centre of mass.
    pub(crate) central: [Expr; 6],
    /// Where it was declared.
    pub(crate) extent: Extent,
}

/// The problem with the holes of a body, as the end of a sentence. Unknown values, and masses and inertias that are
/// reported separately, are not attributed to the holes.
pub(super) fn holes(parts: &[Part], at: &Values) -> Option<String> {
    let [mut solid, mut holes] = [Moments::default(), Moments::default()];
    for part in parts {
        let moments = Moments::of(part, at);
        if !moments.is_real() {
            return None;
        }
        let sum = if part.hole { &mut holes } else { &mut solid };
        sum.add(&moments, 1.0);
    }
    let scale = trace(&solid.second);
    if !is_body(&solid.second_about_center(), scale) {
        return None;
    }
    let mut whole = solid.clone();
    whole.add(&holes, -1.0);
    // A remainder within rounding counts as nothing.
    if whole.mass <= 1e-12 * solid.mass {
        return Some("are as heavy as the rest of it, or heavier: nothing is left".to_string());
    }
    (!is_body(&whole.second_about_center(), scale))
        .then(|| "leave an inertia that no body has: a hole must lie inside the shapes it is cut from".to_string())
}

/// The first given inertia that no body can have, unless the bodies welded to it compensate for it.
pub(super) fn impossible(welded: &Welded, at: &Values) -> Option<Violation> {
    let mut whole = Moments::default();
    for (_, parts, placements) in &welded.bodies {
        let mut body = Moments::default();
        for part in parts {
            body.add(&Moments::of(part, at), if part.hole { -1.0 } else { 1.0 });
        }
        for placement in placements {
            body = body.placed(placement, at);
        }
        whole.add(&body, 1.0);
    }
    let together = whole.second_about_center();
    let scale = trace(&together).abs() + 1e-5 * trace(&whole.second).abs();
    if !whole.is_real() || is_body(&together, scale) {
        return None;
    }
    // If every given inertia is possible, a hole is to blame and is reported separately.
    let wrong = |given: &&GivenInertia| {
        let central = tensor(&given.central, at);
        !is_inertia_of_a_body(&central)
    };
    let given = welded.given.iter().find(wrong)?;
    let others: Vec<String> =
        welded.bodies.iter().filter(|(name, ..)| *name != given.body).map(|(name, ..)| format!("`{name}`")).collect();
    let welded_to = match others.as_slice() {
        [] => String::new(),
        others => format!(
            "; together with {}, welded to it, the principal moments are {}",
            others.join(", "),
            moments(principal(&inertia(&together)).0)
        ),
    };
    Some(Violation {
        extent: given.extent,
        what: format!("the inertia of `{}`", given.body),
        problem: format!("belongs to no body: {}{welded_to}", given.problem(at)),
        help: Some(given.nearest(at)),
    })
}

/// Whether a second moment about the centre of mass is positive semidefinite, up to rounding errors of entries of size
/// `scale`.
fn is_body(second: &Matrix, scale: f64) -> bool {
    principal(second).0[0] >= -1e-9 * scale.max(f64::MIN_POSITIVE)
}

impl GivenInertia {
    /// The moments that are incompatible, in words.
    fn problem(&self, at: &Values) -> String {
        const NAMES: [&str; 3] = ["Jxx", "Jyy", "Jzz"];
        let central = tensor(&self.central, at);
        let about = if self.central == self.tensor { "" } else { "about its centre of mass, " };
        let diagonal = [0, 1, 2].map(|k| central[k][k]);
        if let Some(k) = diagonal.iter().position(|&moment| moment < 0.0) {
            let (name, value) = (NAMES[k], digits(diagonal[k], 6));
            return format!("{about}{name} = {value} kg*m^2 is negative");
        }
        let is_diagonal = (0..3).all(|i| (0..i).all(|j| central[i][j] == 0.0));
        let (values, _) = principal(&central);
        if !is_diagonal {
            let which =
                if values[0] < 0.0 { "the first is negative" } else { "the first two sum to less than the third" };
            return format!("{about}of its principal moments {}, {which}", moments(values));
        }
        let (mut order, [a, b, c]) = ([0, 1, 2], values);
        order.sort_by(|&i, &j| diagonal[i].total_cmp(&diagonal[j]));
        let [mut first, mut second, greatest] = order.map(|k| NAMES[k]);
        if first > second {
            std::mem::swap(&mut first, &mut second);
        }
        let apart = (6..17).find(|&n| digits(a + b, n) != digits(c, n)).unwrap_or(17);
        let (sum, greatest_value) = (digits(a + b, apart), digits(c, apart));
        format!("{about}{first} + {second} = {sum} kg*m^2 is less than {greatest} = {greatest_value} kg*m^2")
    }

    /// The replacement to suggest.
    fn nearest(&self, at: &Values) -> String {
        let (given, central) = (tensor(&self.tensor, at), tensor(&self.central, at));
        let nearest = nearest_of_a_body(&central);
        let [x, y, z] = matrix(|i, j| given[i][j] + nearest[i][j] - central[i][j]);
        let mut entries = vec![x[0], y[1], z[2]];
        if [x[1], y[2], x[2]].iter().any(|&entry| entry != 0.0) {
            entries.extend([x[1], y[2], x[2]]);
        }
        // Use as many digits as keep a flat body flat.
        let entries: Vec<String> = entries.into_iter().map(|entry| digits(entry, 10).to_string()).collect();
        let entries = entries.join(", ");
        format!("the nearest inertia that a body can have is `[{entries}] kg*m^2`")
    }
}

fn tensor(entries: &[Expr; 6], at: &Values) -> Matrix {
    let [xx, yy, zz, xy, yz, xz] = [0, 1, 2, 3, 4, 5].map(|k| at.of(&entries[k]));
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

fn moments(values: Vector) -> String {
    let [a, b, c] = values.map(|value| digits(value, 6));
    format!("{a}, {b} and {c} kg*m^2")
}
