//! A corpus of machines in the language of `mechanism!`. Each declaration is written once and kept in two forms:
//! compiled by the macro, and as text for the compiler's other front ends. Together they use every construct of the
//! language.

use eigentol::Mechanism;

/// Compiles a declaration and keeps its text as `DECLARATION`.
macro_rules! machine {
    ($($declaration:tt)*) => {
        eigentol::mechanism! { $($declaration)* }
        /// The text of the declaration.
        pub const DECLARATION: &str = stringify!($($declaration)*);
    };
}

pub(crate) use machine;

/// Performs an operation on every machine of the corpus, whatever its size.
pub trait Visitor {
    /// Called once for each machine with its name in `snake_case`, its declaration and the compiled type.
    fn visit<M: Mechanism + Copy + 'static>(&mut self, name: &'static str, declaration: &'static str, machine: M);
}

/// Makes each machine known by the name of its module.
macro_rules! machines {
    ($($module:ident: $machine:ident,)*) => {
        $(
            pub mod $module;
            pub use $module::$machine;
        )*

        /// Names and declarations, in a fixed order.
        pub fn declarations() -> Vec<(&'static str, &'static str)> {
            vec![$((stringify!($module), $module::DECLARATION)),*]
        }

        /// Passes every machine to a visitor, in the order of [`declarations`].
        pub fn visit(visitor: &mut impl $crate::corpus::Visitor) {
            $(visitor.visit(stringify!($module), $module::DECLARATION, $module::$machine);)*
        }
    };
}

pub(crate) use machines;

machines! {
    rotating_pendulum: RotatingPendulum,
    rotating_double_pendulum: RotatingDoublePendulum,
    sliders_on_plate: SlidersOnPlate,
    chain_of_four: ChainOfFour,
    chain_of_eight: ChainOfEight,
    governor: Governor,
    turntable_slider: TurntableSlider,
    rotor: Rotor,
    gimbal: Gimbal,
    carousel: Carousel,
    rotor_blade: RotorBlade,
    centrifuge: Centrifuge,
    hoist: Hoist,
    bucket_chain: BucketChain,
    flap_lag_blade: FlapLagBlade,
    bearing_rotor: BearingRotor,
    steady_top: SteadyTop,
    screw_press: ScrewPress,
    robot_arm: RobotArm,
    film_rotor: FilmRotor,
    balanced_fan: BalancedFan,
    shaken_turntable: ShakenTurntable,
    hinged_tip_blade: HingedTipBlade,
    twisting_boom: TwistingBoom,
}
