//! A driven shaft geared to a freely running one, each with a disk on a torsion spring: closed forms.
//!
//! The gear prescribes the speed `-r W` of the second shaft, so the disks are uncoupled: eigenvalues of
//! `J s^2 + c s + k`. The drag `c r W` on the second disk winds its spring up by `c r W / k2` and equals the torque of
//! the gear.

use eigentol::{Role, Stability, Study, mechanism};

mechanism! {
    /// Two disks on torsion springs on geared shafts.
    mechanism GearTrain {
        input speed: rad/s;
        design ratio = 1.5 +/- 0.1%;
        design mass_1 = 2 kg +/- 1%;
        design mass_2 = 3 kg +/- 1%;
        design stiffness_1 = 40 N*m/rad +/- 2%;
        design stiffness_2 = 70 N*m/rad +/- 2%;
        design loss = 0.02 N*m*s/rad;
        design air = 0.01 N*m*s/rad;
        body shaft_1: massless;
        body shaft_2: cylinder(mass: 1 kg, radius: 2 cm, length: 20 cm, axis: z);
        body disk_1: disk(mass: mass_1, radius: 10 cm, axis: z);
        body disk_2: disk(mass: mass_2, radius: 20 cm, axis: z);
        joint spin: revolute(z) from ground to shaft_1, driven at speed;
        joint run: revolute(z) from ground to shaft_2 at [30 cm, 0, 0], coasting;
        joint twist_1: revolute(z) from shaft_1 to disk_1;
        joint twist_2: revolute(z) from shaft_2 to disk_2;
        constraint mesh: coupling(of: run, with: spin, ratio: -ratio);
        force spring_1: spring(on: twist_1, stiffness: stiffness_1);
        force spring_2: spring(on: twist_2, stiffness: stiffness_2);
        force loss_1: damper(on: twist_1, damping: loss);
        point center: disk_2;
        force drag: drag(at: center, turning_damping: air);
        output tooth = reaction(mesh);
        output other_speed = rate(run);
    }
}

fn close(value: f64, expected: f64, what: &str) {
    let off = (value - expected).abs();
    assert!(off <= 1e-11 * expected.abs().max(1e-3), "{what}: {value}, not {expected}");
}

#[test]
fn geared_disks_have_closed_forms() {
    let (ratio, air, loss) = (1.5, 0.01, 0.02);
    let (inertia_1, inertia_2) = (0.5 * 2.0 * 0.01, 0.5 * 3.0 * 0.04);
    for speed in [0.0, 20.0, 300.0] {
        let study = Study::new(GearTrain).input(GearTrain::speed, speed);
        let at = study.equilibrium().expect("a steady motion");
        assert_eq!(at.stability, Stability::Stable);
        close(at.coordinates[GearTrain::twist_1.index()], 0.0, "first twist");
        let twist = air * ratio * speed / 70.0;
        close(at.coordinates[GearTrain::twist_2.index()], twist, "second twist");
        let mut unknowns = at.description.coordinates.iter();
        let run = unknowns.position(|one| one.role == Role::Speed);
        close(at.coordinates[run.expect("a speed")], -ratio * speed, "speed");

        let outputs = study.outputs().expect("outputs");
        close(outputs.values[0], -air * ratio * speed, "tooth");
        let by_design = outputs.by_design[0].as_ref().expect("derivatives");
        close(by_design[GearTrain::ratio.index()], -air * speed, "tooth by ratio");
        close(by_design[GearTrain::air.index()], -ratio * speed, "tooth by air");
        let by_input = outputs.by_input[1].as_ref().expect("derivatives");
        close(by_input[0], -ratio, "speed by speed");

        let modes = study.modes().expect("modes");
        let [slow, fast] = &modes.modes[..] else {
            panic!("two modes, not {}", modes.modes.len());
        };
        for (mode, damping, inertia, stiffness) in [(slow, air, inertia_2, 70.0), (fast, loss, inertia_1, 40.0)] {
            let growth = -damping / (2.0 * inertia);
            close(mode.s.re, growth, "growth");
            let natural: f64 = stiffness / inertia;
            close(mode.s.im, (natural - growth * growth).sqrt(), "frequency");
        }
    }
}
