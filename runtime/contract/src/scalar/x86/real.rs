//! [`Real`](crate::Real) for every width of vector.

/// Implements everything that differs only in the names of the instructions.
macro_rules! real {
    ($vector:ident, $lanes:literal, $set1:ident, $load:ident, $store:ident, $sqrt:ident, $($trait:ident $method:ident $operation:ident)*) => {
        $(impl $trait for $vector {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the module.
                Self(unsafe { $operation(self.0, other.0) })
            }
        })*

        impl $vector {
            #[inline(always)]
            fn array(self) -> [f64; $lanes] {
                let mut lanes = [0.0; $lanes];
                // SAFETY: see the module; the array has room for the vector.
                unsafe { $store(lanes.as_mut_ptr(), self.0) };
                lanes
            }

            #[inline(always)]
            fn of(lanes: [f64; $lanes]) -> Self {
                // SAFETY: see the module; the array is as long as the vector.
                Self(unsafe { $load(lanes.as_ptr()) })
            }

            #[inline(always)]
            fn with(self, other: Self, function: impl Fn(f64, f64) -> f64) -> Self {
                let (a, b) = (self.array(), other.array());
                Self::of(core::array::from_fn(|l| function(a[l], b[l])))
            }

            /// Applies the scalar function to each lane, for angles of any size.
            #[cold]
            #[inline(never)]
            fn sin_cos_beyond(angles: &[f64; $lanes]) -> [[f64; $lanes]; 2] {
                let pairs = angles.map(trigonometry::sin_cos);
                [pairs.map(|pair| pair.0), pairs.map(|pair| pair.1)]
            }
        }

        impl Real for $vector {
            #[inline(always)]
            fn constant(value: f64) -> Self {
                // SAFETY: see the module.
                Self(unsafe { $set1(value) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: see the module.
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let near = trigonometry::sin_cos_within(self);
                if Self::every(self.abs().at_most(Self::constant(trigonometry::LIMIT))) {
                    return near;
                }
                let [sines, cosines] = Self::sin_cos_beyond(&self.array());
                (Self::of(sines), Self::of(cosines))
            }
            #[inline(always)]
            fn tan(self) -> Self {
                self.each(|x| Real::tan(x))
            }
            #[inline(always)]
            fn asin(self) -> Self {
                self.each(|x| Real::asin(x))
            }
            #[inline(always)]
            fn acos(self) -> Self {
                self.each(|x| Real::acos(x))
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                self.with(x, |y, x| Real::atan2(y, x))
            }
            #[inline(always)]
            fn exp(self) -> Self {
                self.each(|x| Real::exp(x))
            }
            #[inline(always)]
            fn ln(self) -> Self {
                self.each(|x| Real::ln(x))
            }
            #[inline(always)]
            fn powi(self, exponent: i32) -> Self {
                crate::scalar::real::integer_power(self, exponent)
            }
            #[inline(always)]
            fn spline(self, pieces: &[[f64; 5]], derivative: usize) -> Self {
                self.each(|x| crate::scalar::spline(x, pieces, derivative))
            }
            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                self.with(exponent, |x, y| Real::powf(x, y))
            }
        }
    };
}

/// Inside of an implementation of [`Lanes`](crate::scalar::lanes::Lanes): the number of lanes, and what goes by memory.
macro_rules! memory {
    ($lanes:literal, $load:ident, $store:ident) => {
        const WIDTH: usize = $lanes;

        #[inline(always)]
        fn load(from: &Batch, at: usize) -> Self {
            assert!(at + $lanes <= WIDTH);
            // SAFETY: see the module; within the batch by the assertion.
            Self(unsafe { $load(from.0.as_ptr().add(at)) })
        }
        #[inline(always)]
        fn store(self, to: &mut Batch, at: usize) {
            assert!(at + $lanes <= WIDTH);
            // SAFETY: see the module; within the batch by the assertion.
            unsafe { $store(to.0.as_mut_ptr().add(at), self.0) };
        }
        #[inline(always)]
        fn each(self, function: impl Fn(f64) -> f64) -> Self {
            Self::of(self.array().map(function))
        }
    };
}

pub(super) use {memory, real};
