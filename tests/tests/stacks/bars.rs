//! 64 unknowns with 64 design variables.

use eigentol::mechanism;

/// A chain of bars on a spinning shaft, each with a tolerance on its length.
macro_rules! chain {
    (($bar:ident $turn:ident $length:ident) $($rest:tt)*) => {
        chain! {
            @[$length $bar]
            [
                design $length = 1 m +/- 1%;
                body $bar: rod(mass: 3 kg, length: $length, along: -z);
                joint $turn: revolute(y) from shaft to $bar;
            ]
            $($rest)*
        }
    };
    (@[$above:ident $upper:ident] [$($declared:tt)*]
        ($bar:ident $turn:ident $length:ident) $($rest:tt)*) => {
        chain! {
            @[$length $bar]
            [
                $($declared)*
                design $length = 1 m +/- 1%;
                body $bar: rod(mass: 3 kg, length: $length, along: -z);
                joint $turn: revolute(y) from $upper to $bar at [0 m, 0 m, -$above];
            ]
            $($rest)*
        }
    };
    (@[$length:ident $lowest:ident] [$($declared:tt)*]) => {
        chain! {
            @@
            /// Hanging on a shaft that turns.
            pub(crate) mechanism Bars {
                input omega: rad/s;
                gravity 9.81 m/s^2 along -z;
                body shaft: massless;
                joint spin: revolute(z) from ground to shaft, driven at omega;
                $($declared)*
                point tip: $lowest at [0 m, 0 m, -$length];
                output depth = position(tip).z;
            }
        }
    };
    (@@ $($declaration:tt)*) => {
        mechanism! { $($declaration)* }
        /// The declaration, one token after the other.
        pub(crate) const DECLARATION: &str = stringify!($($declaration)*);
    };
}

chain! {
    (bar1 turn1 length1) (bar2 turn2 length2) (bar3 turn3 length3) (bar4 turn4 length4)
    (bar5 turn5 length5) (bar6 turn6 length6) (bar7 turn7 length7) (bar8 turn8 length8)
    (bar9 turn9 length9) (bar10 turn10 length10) (bar11 turn11 length11) (bar12 turn12 length12)
    (bar13 turn13 length13) (bar14 turn14 length14) (bar15 turn15 length15) (bar16 turn16 length16)
    (bar17 turn17 length17) (bar18 turn18 length18) (bar19 turn19 length19) (bar20 turn20 length20)
    (bar21 turn21 length21) (bar22 turn22 length22) (bar23 turn23 length23) (bar24 turn24 length24)
    (bar25 turn25 length25) (bar26 turn26 length26) (bar27 turn27 length27) (bar28 turn28 length28)
    (bar29 turn29 length29) (bar30 turn30 length30) (bar31 turn31 length31) (bar32 turn32 length32)
    (bar33 turn33 length33) (bar34 turn34 length34) (bar35 turn35 length35) (bar36 turn36 length36)
    (bar37 turn37 length37) (bar38 turn38 length38) (bar39 turn39 length39) (bar40 turn40 length40)
    (bar41 turn41 length41) (bar42 turn42 length42) (bar43 turn43 length43) (bar44 turn44 length44)
    (bar45 turn45 length45) (bar46 turn46 length46) (bar47 turn47 length47) (bar48 turn48 length48)
    (bar49 turn49 length49) (bar50 turn50 length50) (bar51 turn51 length51) (bar52 turn52 length52)
    (bar53 turn53 length53) (bar54 turn54 length54) (bar55 turn55 length55) (bar56 turn56 length56)
    (bar57 turn57 length57) (bar58 turn58 length58) (bar59 turn59 length59) (bar60 turn60 length60)
    (bar61 turn61 length61) (bar62 turn62 length62) (bar63 turn63 length63) (bar64 turn64 length64)
}
