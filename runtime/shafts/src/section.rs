//! Sections of a shaft: the numbers that are constant along each, and what they multiply.

use eigentol_numerics::Complex;

use crate::number::Number as Field;

/// What a line of a shaft does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Line {
    /// Bends and shears: Timoshenko's theory with rotary inertia. Two unknowns a node and plane, deflection and rotation
    /// of the section.
    Timoshenko,
    /// Bends without shear: Rayleigh's theory. The same unknowns.
    Slender,
    /// Twists, or stretches. One unknown a node.
    Bar,
}

/// The largest number of coefficients of a line.
pub(crate) const TERMS: usize = 5;

/// A piece of a shaft with the same numbers all along, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// m.
    pub length: f64,
    /// `E I`, N m^2; of a bar `G J`, or `E A` in N.
    pub stiffness: f64,
    /// `kappa G A`, N. Only of [`Line::Timoshenko`].
    pub shear: f64,
    /// Per length, kg/m; of a bar that twists polar inertia, kg m.
    pub mass: f64,
    /// Inertia about a diameter per length, kg m.
    pub rotary: f64,
    /// Time that the rate of bending or twist is multiplied by, s: the material's damping, which turns with it.
    pub lag: f64,
    /// Axial force, N; positive if it stretches.
    pub tension: f64,
    /// Resistance of a medium at rest, N s/m^2; of a bar that twists N s.
    pub drag: f64,
}

/// The numbers of a section, in the order of gradients.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the fields of a section")]
pub enum Number {
    Length,
    Stiffness,
    Shear,
    Mass,
    Rotary,
    Lag,
    Tension,
    Drag,
}

impl Number {
    /// All, in the order of gradients.
    pub const ALL: [Self; 8] =
        [Self::Length, Self::Stiffness, Self::Shear, Self::Mass, Self::Rotary, Self::Lag, Self::Tension, Self::Drag];
}

/// Each coefficient of a line as a polynomial in `s`: constant, linear and quadratic part.
pub(crate) type Coefficients<T = Complex> = [[T; 3]; TERMS];

/// The coefficients of a section with these numbers at a speed, for `y + i z`; for `y - i z` the speed changes its sign. They
/// are those of the mass of deflection, the mass of rotation (with the stiffness of shear), bending, the slope of deflection, and
/// shear; of a slender line the deflection, its slope and its curvature; of a bar the deflection and its slope.
#[inline(always)]
pub(crate) fn coefficients<T: Field>(line: Line, numbers: &[T; Number::ALL.len()], speed: T) -> Coefficients<T> {
    let [length, stiffness, shear, mass, rotary, lag, tension, drag] = *numbers;
    let half = length.times(0.5);
    let per_half = half.inverse();
    let turning = speed * T::of(Complex::I);
    let none = T::zero();
    let inertia = [none, half * drag, half * mass];
    let turns = |scale: T| [none, -(turning * scale * rotary).times(2.0), scale * rotary];
    let elastic = |x: T| [x - x * lag * turning, x * lag, none];
    let plus = |[a, b, c]: [T; 3], x: T| [a + x, b, c];
    match line {
        Line::Timoshenko => [
            inertia,
            plus(turns(half), half * shear),
            elastic(stiffness * per_half),
            [(shear + tension) * per_half, none, none],
            [-shear, none, none],
        ],
        Line::Slender => [
            inertia,
            plus(turns(per_half), tension * per_half),
            elastic(stiffness * per_half * per_half * per_half),
            [none; 3],
            [none; 3],
        ],
        // What twists turns with the shaft: its damping does not.
        Line::Bar => {
            [inertia, [stiffness * per_half, stiffness * lag * per_half, none], [none; 3], [none; 3], [none; 3]]
        }
    }
}

impl Section {
    /// A number of the section.
    #[must_use]
    pub fn number(&self, number: Number) -> f64 {
        let mut own = *self;
        *own.number_mut(number)
    }

    /// A number of the section, to change it.
    pub fn number_mut(&mut self, number: Number) -> &mut f64 {
        match number {
            Number::Length => &mut self.length,
            Number::Stiffness => &mut self.stiffness,
            Number::Shear => &mut self.shear,
            Number::Mass => &mut self.mass,
            Number::Rotary => &mut self.rotary,
            Number::Lag => &mut self.lag,
            Number::Tension => &mut self.tension,
            Number::Drag => &mut self.drag,
        }
    }

    /// [`coefficients`] of the section.
    #[inline]
    pub(crate) fn coefficients(&self, line: Line, speed: f64) -> Coefficients {
        coefficients(line, &Number::ALL.map(|number| self.number(number).into()), speed.into())
    }

    /// Derivatives of the sum of the coefficients `k` at `s` times these forms, by the numbers of the section and behind them by
    /// the speed, in one direction.
    #[inline(always)]
    pub(crate) fn slopes<T: Field>(
        &self,
        (line, speed, direction): (Line, f64, f64),
        s: T,
        k: &[T; TERMS],
        forms: &[T; TERMS],
    ) -> [T; Number::ALL.len() + 1] {
        let (half, per_half) = (0.5 * self.length, 2.0 / self.length);
        // What rotary inertia and stiffness are multiplied by, and the powers of the length in each coefficient.
        let (inertia, elastic, powers) = match line {
            Line::Timoshenko => (half, per_half, [1.0, 1.0, -1.0, -1.0, 0.0]),
            Line::Slender => (per_half, per_half * per_half * per_half, [1.0, -1.0, -3.0, 0.0, 0.0]),
            Line::Bar => (0.0, per_half, [1.0, -1.0, 0.0, 0.0, 0.0]),
        };
        let along = forms[3].times(per_half);
        let (by_shear, by_tension) = match line {
            Line::Timoshenko => (forms[1].times(half) + along - forms[4], along),
            Line::Slender => (T::zero(), forms[1].times(per_half)),
            Line::Bar => (T::zero(), T::zero()),
        };
        let mut by_length = T::zero();
        for ((k, form), power) in k.iter().zip(forms).zip(powers) {
            by_length += (*k * *form).times(power / self.length);
        }
        let moved = (s * forms[0]).times(half);
        let turned = (s * forms[1]).times(inertia);
        let bent = if line == Line::Bar { forms[1] } else { forms[2] }.times(elastic);
        let turn = T::of(Complex::new(0.0, direction));
        let lagging = (s - turn.times(speed)) * bent;
        [
            by_length,
            bent + lagging.times(self.lag),
            by_shear,
            s * moved,
            (s - turn.times(2.0 * speed)) * turned,
            lagging.times(self.stiffness),
            by_tension,
            moved,
            -(turn * (turned.times(2.0 * self.rotary) + bent.times(self.stiffness * self.lag))),
        ]
    }
}

/// The coefficients at `s`.
#[inline(always)]
pub(crate) fn at<T: Field>(coefficients: &Coefficients, s: T) -> [T; TERMS] {
    let mut all = [T::zero(); TERMS];
    for (to, [a, b, c]) in all.iter_mut().zip(coefficients) {
        *to = T::of(*a) + s * (T::of(*b) + s * T::of(*c));
    }
    all
}

/// Their derivatives by `s`.
#[inline(always)]
pub(crate) fn slope_at<T: Field>(coefficients: &Coefficients, s: T) -> [T; TERMS] {
    let mut all = [T::zero(); TERMS];
    for (to, [_, b, c]) in all.iter_mut().zip(coefficients) {
        *to = T::of(*b) + s * T::of(2.0 * c);
    }
    all
}
