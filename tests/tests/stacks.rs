//! Large mechanisms fit into the small stacks that threads have, without optimisation too: 64 bars and the bicycle aborted there,
//! 32 bars in `monte_carlo`.
#![recursion_limit = "256"]

use std::hint::black_box;

use eigentol::equilibrium::Search;
use eigentol::second_order::Band;
use eigentol::{Error, Input, Study, mechanism};
use eigentol_tests::wheels::WhippleBicycle;

/// A chain of bars on a spinning shaft, each with a tolerance on its length and on its mass.
macro_rules! chain {
    (($bar:ident $turn:ident $length:ident $mass:ident) $($rest:tt)*) => {
        chain! {
            @[$length $bar]
            [
                design $length = 1 m +/- 1%;
                design $mass = 3 kg +/- 1%;
                body $bar: rod(mass: $mass, length: $length, along: -z);
                joint $turn: revolute(y) from shaft to $bar;
            ]
            $($rest)*
        }
    };
    (@[$above:ident $upper:ident] [$($declared:tt)*]
        ($bar:ident $turn:ident $length:ident $mass:ident) $($rest:tt)*) => {
        chain! {
            @[$length $bar]
            [
                $($declared)*
                design $length = 1 m +/- 1%;
                design $mass = 3 kg +/- 1%;
                body $bar: rod(mass: $mass, length: $length, along: -z);
                joint $turn: revolute(y) from $upper to $bar at [0 m, 0 m, -$above];
            ]
            $($rest)*
        }
    };
    (@[$above:ident $upper:ident] [$($declared:tt)*]) => {
        mechanism! {
            mechanism Bars {
                input omega: rad/s;
                gravity 9.81 m/s^2 along -z;
                body shaft: massless;
                joint spin: revolute(z) from ground to shaft, driven at omega;
                $($declared)*
            }
        }
    };
}

chain! {
    (bar1 turn1 length1 mass1) (bar2 turn2 length2 mass2) (bar3 turn3 length3 mass3)
    (bar4 turn4 length4 mass4) (bar5 turn5 length5 mass5) (bar6 turn6 length6 mass6)
    (bar7 turn7 length7 mass7) (bar8 turn8 length8 mass8) (bar9 turn9 length9 mass9)
    (bar10 turn10 length10 mass10) (bar11 turn11 length11 mass11) (bar12 turn12 length12 mass12)
    (bar13 turn13 length13 mass13) (bar14 turn14 length14 mass14) (bar15 turn15 length15 mass15)
    (bar16 turn16 length16 mass16) (bar17 turn17 length17 mass17) (bar18 turn18 length18 mass18)
    (bar19 turn19 length19 mass19) (bar20 turn20 length20 mass20) (bar21 turn21 length21 mass21)
    (bar22 turn22 length22 mass22) (bar23 turn23 length23 mass23) (bar24 turn24 length24 mass24)
    (bar25 turn25 length25 mass25) (bar26 turn26 length26 mass26) (bar27 turn27 length27 mass27)
    (bar28 turn28 length28 mass28) (bar29 turn29 length29 mass29) (bar30 turn30 length30 mass30)
    (bar31 turn31 length31 mass31) (bar32 turn32 length32 mass32) (bar33 turn33 length33 mass33)
    (bar34 turn34 length34 mass34) (bar35 turn35 length35 mass35) (bar36 turn36 length36 mass36)
    (bar37 turn37 length37 mass37) (bar38 turn38 length38 mass38) (bar39 turn39 length39 mass39)
    (bar40 turn40 length40 mass40) (bar41 turn41 length41 mass41) (bar42 turn42 length42 mass42)
    (bar43 turn43 length43 mass43) (bar44 turn44 length44 mass44) (bar45 turn45 length45 mass45)
    (bar46 turn46 length46 mass46) (bar47 turn47 length47 mass47) (bar48 turn48 length48 mass48)
    (bar49 turn49 length49 mass49) (bar50 turn50 length50 mass50) (bar51 turn51 length51 mass51)
    (bar52 turn52 length52 mass52) (bar53 turn53 length53 mass53) (bar54 turn54 length54 mass54)
    (bar55 turn55 length55 mass55) (bar56 turn56 length56 mass56) (bar57 turn57 length57 mass57)
    (bar58 turn58 length58 mass58) (bar59 turn59 length59 mass59) (bar60 turn60 length60 mass60)
    (bar61 turn61 length61 mass61) (bar62 turn62 length62 mass62) (bar63 turn63 length63 mass63)
    (bar64 turn64 length64 mass64)
}

type Bicycle = Study<WhippleBicycle>;

/// Runs on a stack of so many KiB.
fn on(stack: usize, question: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(stack << 10);
    let thread = thread.spawn(question).expect("a thread");
    thread.join().expect("no panic");
}

/// Asks 64 bars on the stack of a Rust thread.
fn ask<T>(question: impl FnOnce(&Study<Bars>) -> Result<T, Error> + Send + 'static) {
    on(2048, || {
        let study = Study::new(Bars).threads(2).samples(2).steps(2);
        black_box(question(&study).expect("an answer"));
    });
}

const OMEGA: Input<Bars> = Bars::omega;

#[test]
fn questions_about_one_state() {
    ask(Study::equilibrium);
    ask(Study::assembly);
    ask(|study| study.equilibria(&Search::new([-0.01; 64], [0.01; 64]).starts(1).seed(0)));
    ask(Study::modes);
    ask(Study::equilibrium_shift);
    ask(Study::sensitivities);
    ask(Study::outputs);
    ask(Study::first_order);
    ask(Study::output_tolerances);
    ask(|study| study.shape_sensitivity(0));
    ask(|study| study.mode_curvature(0));
    ask(Study::whirls);
}

#[test]
fn questions_about_spreads() {
    ask(Study::monte_carlo);
    ask(Study::clusters);
    ask(|study| {
        let band = Band::Between {
            low: 1.0,
            high: 2.0,
        };
        study.margin(0, band)
    });
}

#[test]
fn questions_about_a_range() {
    ask(|study| study.sweep(OMEGA, &[0.0, 0.1]));
    ask(|study| study.sensitivity_sweep(OMEGA, &[0.0, 0.1], |_, slopes| assert!(slopes.is_ok())));
    ask(|study| study.first_order_sweep(OMEGA, &[0.0, 0.1]));
    ask(|study| study.campbell(OMEGA, &[0.0, 0.1], &[1.0]));
    ask(|study| study.branches(OMEGA, 0.0, 0.01));
    ask(|study| study.critical_state(OMEGA, 0.4, 0.6));
    ask(|study| study.crossings(OMEGA, 0.2, 0.5, 1.0));
}

/// Minutes without optimisation.
#[test]
#[ignore = "second derivatives of 64 modes by 128 variables"]
fn questions_of_second_order() {
    ask(Study::second_order);
    ask(Study::summary);
}

#[test]
fn the_bicycle_on_the_main_thread_of_windows() {
    on(1024, || {
        let study: Bicycle = Study::new(WhippleBicycle);
        let speeds = [4.0, 5.0, 6.0];
        let found = study.campbell(WhippleBicycle::v, &speeds, &[] as &[f64]);
        assert_eq!(found.expect("a diagram").points.len(), speeds.len());
        black_box(study.summary().expect("a summary"));
    });
}
