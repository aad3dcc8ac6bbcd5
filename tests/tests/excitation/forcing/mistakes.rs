//! Texts with random mistakes: they are refused, or mean something, but never panic.

use eigentol_interpreter::Interpreted;

use crate::forcing::compared::Random;

const TEXTS: [&str; 3] = [
    "mechanism Rotor {
    input omega : rad / s ;
    design e = 2 um +/- 5 um ;
    body seat : massless ;
    body wheel : disk ( mass : 2 kg , radius : 20 cm , axis : z ) ;
    joint bend : planar ( px : x , py : y , twist : z ) from ground to seat , twist shaken ( velocity : 1 mrad / s , frequency : 3 Hz ) ;
    joint spin : revolute ( z ) from seat to wheel , driven at omega ;
    force kx : spring ( on : px , stiffness : 1 kN / m ) ;
    force ky : spring ( on : py , stiffness : 1 kN / m ) ;
    point hub : wheel at [ 0 , 0 , 1 mm ] ;
    unbalance heavy : on wheel , eccentricity : e , angle : 30 deg ;
    unbalance bolt : on wheel , amount : 20 g * mm , at [ 0 , 0 , 10 ] mm ;
    force push : harmonic ( on : px , force : 1 N , order : 2 of spin , phase : 10 deg ) ;
    force pull : harmonic ( at : hub , force : [ 1 , 0 , 0 ] N , moment : [ 0 , 0 , 1 ] N * m , frequency : 4 Hz ) ;
    output east = position ( hub ) . x ;
    output side = reaction_force ( spin ) . y ;
    }",
    "mechanism Pendulum {
    gravity 9.81 m / s ^ 2 along - z ;
    body cart : box ( mass : 1 kg , size : [ 10 , 10 , 10 ] cm ) ;
    body bob : rod ( mass : 1 kg , length : 1 m , along : - z ) ;
    body fan : sphere ( mass : 1 kg , radius : 10 cm ) ;
    joint travel : prismatic ( x ) from ground to cart , shaken ( amplitude : 1 mm , frequency : 3 Hz , phase : 1 deg ) ;
    joint swing : revolute ( y ) from cart to bob ;
    joint turning : revolute ( z ) from cart to fan , coasting ;
    force motor : generalized ( on : turning , value : 1 N * m - 0.1 N * m * s * rate ( turning ) ) ;
    unbalance heavy : on fan , amount : 20 g * mm ;
    force push : harmonic ( on : swing , moment : 1 N * m , order : 1 of turning ) ;
    output pull = reaction_force ( travel ) . x ;
    }",
    "mechanism Linkage {
    body crank : rod ( mass : 1 kg , length : 1 m , along : x ) ;
    body link : rod ( mass : 1 kg , length : 1 m , along : x ) ;
    body slide : massless ;
    joint a : revolute ( y ) from ground to crank ;
    joint b : revolute ( y ) from crank to link at [ 1 , 0 , 0 ] m ;
    joint s : prismatic ( z ) from ground to slide at [ 1.5 , 0 , 0 ] m , shaken ( acceleration : 1 m / s ^ 2 , frequency : 9 Hz ) ;
    joint c : revolute ( y ) from slide to link at [ 0 , 0 , 0 ] m , at [ 1 , 0 , 0 ] m on link , cut ;
    force k : spring ( on : a , stiffness : 30 N * m / rad ) ;
    force rock : harmonic ( on : b , moment : 2 N * m , frequency : 9 Hz ) ;
    output push = reaction_force ( s ) . z ;
    }",
];

const WORDS: [&str; 40] = [
    "unbalance",
    "harmonic",
    "shaken",
    "order",
    "of",
    "frequency",
    "phase",
    "angle",
    "at",
    "on",
    "amount",
    "eccentricity",
    "tilt",
    "amplitude",
    "velocity",
    "acceleration",
    "driven",
    "coasting",
    "spin",
    "px",
    "wheel",
    "ground",
    "seat",
    "0",
    "-1",
    "1e300",
    "2 Hz",
    "3 kg",
    "[0, 0, 1] m",
    "omega",
    ":",
    ",",
    ";",
    "(",
    ")",
    "from",
    "swing",
    "turning",
    "cut",
    "force",
];

#[test]
fn mistakes_never_panic() {
    let mut random = Random::new(3);
    let (mut refused, mut accepted) = (0, 0);
    for _ in 0..2000 {
        let text = random.one_of(&TEXTS);
        let mut tokens: Vec<&str> = text.split_whitespace().collect();
        for _ in 0..1 + random.below(2) {
            let (at, other) = (random.below(tokens.len()), random.below(tokens.len()));
            match random.below(4) {
                0 => drop(tokens.remove(at)),
                1 => tokens.insert(at, random.one_of(&WORDS)),
                2 => tokens[at] = random.one_of(&WORDS),
                _ => tokens.swap(at, other),
            }
        }
        match Interpreted::from_text(&tokens.join(" ")) {
            Ok(_) => accepted += 1,
            Err(mistakes) => {
                refused += 1;
                for mistake in mistakes.iter() {
                    assert!(mistake.line > 0 && !mistake.message.is_empty(), "{mistake:?}");
                }
            }
        }
    }
    assert!(refused > 1000 && accepted > 20, "{refused} {accepted}");
}

/// The limit of an amplitude may lie below zero, its nominal value not.
#[test]
fn tolerances_of_amplitudes_may_reach_below_zero() {
    assert!(TEXTS[0].contains("2 um +/- 5 um"));
    for text in TEXTS {
        Interpreted::from_text(text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
    }
    let negative = TEXTS[0].replace("2 um +/- 5 um", "-2 um +/- 5 um");
    assert!(Interpreted::from_text(&negative).is_err());
}
