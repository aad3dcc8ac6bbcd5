//! Numbers of the `num-dual` crate as scalars for generated code.

/// Implements [`Real`](eigentol::Real) and its supertraits for a wrapper of a `num-dual` number.
macro_rules! scalar {
    ($scalar:ident of $inner:ident) => {
        impl PartialOrd for $scalar {
            fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
                self.0.re.partial_cmp(&other.0.re)
            }
        }

        $crate::num_dual::scalar! { @operators $scalar Add add, Sub sub, Mul mul, Div div }

        impl std::ops::Neg for $scalar {
            type Output = Self;
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl eigentol::Real for $scalar {
            fn constant(value: f64) -> Self {
                Self($inner::from_re(value))
            }
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = num_dual::DualNum::sin_cos(&self.0);
                (Self(sin), Self(cos))
            }
            /// In axes aligned with the value itself, where the quotient is defined: `num-dual`'s own formula divides
            /// by `x`.
            fn atan2(self, x: Self) -> Self {
                let (x0, y0) = (Self::constant(x.0.re), Self::constant(self.0.re));
                let turned = (self * x0 - x * y0) / (x * x0 + self * y0);
                let angle = self.0.re.atan2(x.0.re);
                Self(num_dual::DualNum::atan(&turned.0)) + Self::constant(angle)
            }
            fn powi(self, exponent: i32) -> Self {
                Self(num_dual::DualNum::powi(&self.0, exponent))
            }
            /// Evaluates the terms of the segment, which are then differentiated like everything else.
            fn spline(self, pieces: &[[f64; 5]], derivative: usize) -> Self {
                let started = pieces.iter().rev().find(|piece| self.0.re >= piece[0]);
                let [start, coefficients @ ..] = *started.unwrap_or(&pieces[0]);
                let t = self - Self::constant(start);
                let mut sum = Self::constant(0.0);
                for (power, coefficient) in coefficients.into_iter().enumerate().skip(derivative) {
                    let factor: usize = (power + 1 - derivative..=power).product();
                    let mut term = Self::constant(coefficient * factor as f64);
                    for _ in derivative..power {
                        term = term * t;
                    }
                    sum = sum + term;
                }
                sum
            }
            fn powf(self, exponent: Self) -> Self {
                Self(num_dual::DualNum::powd(&self.0, exponent.0))
            }
            $crate::num_dual::scalar! { @functions sqrt tan asin acos exp ln }
        }
    };
    (@operators $scalar:ident $($operator:ident $method:ident),*) => {$(
        impl std::ops::$operator for $scalar {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(std::ops::$operator::$method(self.0, other.0))
            }
        }
    )*};
    (@functions $($function:ident)*) => {$(
        fn $function(self) -> Self {
            Self(num_dual::DualNum::$function(&self.0))
        }
    )*};
}

pub(crate) use scalar;
