//! Reasons why a question has no answer: each one can be matched on, and prints as a sentence.

/// The text of values that are words.
#[doc(hidden)]
#[macro_export]
macro_rules! worded {
    ($type:ty { $($value:pat => $word:literal,)+ }) => {
        impl ::core::fmt::Display for $type {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.write_str(match self {
                    $($value => $word,)+
                })
            }
        }
    };
}

macro_rules! reasons {
    ($(#[$doc:meta])* $name:ident { $($variant:ident = $sentence:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub enum $name {
            $(#[doc = $sentence] $variant,)+
        }

        $crate::worded! {
            $name {
                $(Self::$variant => $sentence,)+
            }
        }
    };
}

reasons! {
    /// Why no equilibrium was found.
    NotFound {
        Minimum = "the residual has a minimum that is not zero",
        OnlyUnstable = "only unstable equilibria",
        Unbounded = "the search ended where a force grows without bound",
        NoDescent = "no descent from the last state",
        Escape = "the coordinates escape to infinity",
        IterationLimit = "too many iterations",
        Inaccurate = "the residual stays larger than rounding can explain",
        Diverges = "Newton's method does not converge",
        NoMember = "no member of this family of steady motions has the values that are to be held",
        NotIsolated = "other equilibria lie right beside it, as where nothing resists a motion",
        BendsAway = "the branch bends away",
        BendsSharply = "the branch bends sharply",
        TurnsBack = "the end of the range is not straight ahead",
        TooManyEvents = "too many events between two points",
        NothingBetween = "no point between two points",
        Coincide = "the points coincide",
        UnusualLimitPoint = "no limit point of the ordinary kind",
        LimitPointOutside = "the limit point is not between the points",
        LimitPointLost = "the limit point was not located",
        BranchPointOutside = "the branch point is not between the points",
        BranchPointLost = "the branch point was not located",
        BranchPointNotSimple = "the branch point is not simple",
        DependentVectors = "the critical vectors are not independent",
        SingularStiffness = "the stiffness is singular to rounding",
    }
}

reasons! {
    /// Why a mechanism with constraints cannot be assembled.
    NotClosed {
        Held = "the coordinates that are held do not let it close: hold fewer, or at other values",
        Contradiction = "constraints that depend on each other contradict each other",
        Minimum = "the gaps have a minimum that is not zero: lengths that do not reach, or start values on the wrong side",
        IterationLimit = "the gaps do not close within the number of iterations",
    }
}

reasons! {
    /// Why a critical value, a crossing or an output has no derivative, first or second.
    NoDerivative {
        Merge = "two frequencies merge there: the slightest damping moves the onset by a finite amount",
        UnknownInput = "there is no such input",
        Touch = "the two sides touch without crossing",
        IndependentOfInput = "the stiffness does not depend on the input",
        Imperfection = "a design variable pushes along the critical mode and destroys the bifurcation",
        Cusp = "two limit points meet there",
        Transcritical = "another branch continues on both sides of it: second derivatives are available only at limit points and pitchforks",
        Family = "it belongs to a family of steady motions: only first derivatives are available",
        Stability = "stability is not a number: sample, or require a critical value beyond the operating point",
        Peak = "a peak has first derivatives only: take samples or the design point",
        NotSmooth = "it has a value there, but no derivative",
    }
}
