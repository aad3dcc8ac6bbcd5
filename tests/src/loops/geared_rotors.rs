//! Geared rotors whose twists are coupled: both hubs are driven in the ratio of the gear.

use crate::corpus::machine;

machine! {
    /// Two driven shafts, a pinion on a torsion spring, a wheel in mesh with it, and a rotor on a torsion spring.
    pub mechanism GearedRotors {
        input omega: rad/s;
        design ratio = 0.6 +/- 0.001;
        design pinion_mass = 800 g +/- 10 g;
        design wheel_mass = 1.9 kg +/- 20 g;
        design rotor_mass = 3.2 kg +/- 50 g;
        design pinion_stiffness = 240 N*m/rad +/- 8 N*m/rad;
        design rotor_stiffness = 150 N*m/rad +/- 5 N*m/rad;
        design load = 1.7 N*m +/- 0.1 N*m;
        body hub_in: massless;
        body hub_out: massless;
        body pinion_disk: disk(mass: pinion_mass, radius: 60 mm, axis: z);
        body wheel_disk: disk(mass: wheel_mass, radius: 110 mm, axis: z);
        body rotor_disk: disk(mass: rotor_mass, radius: 160 mm, axis: z);
        joint spin_in: revolute(z) from ground to hub_in, driven at omega;
        joint spin_out: revolute(z) from ground to hub_out at [170 mm, 0, 0], driven at -ratio * omega;
        joint pinion: revolute(z) from hub_in to pinion_disk;
        joint wheel: revolute(z) from hub_out to wheel_disk;
        joint rotor: revolute(z) from wheel_disk to rotor_disk;
        constraint mesh: coupling(of: wheel, with: pinion, ratio: -ratio);
        force pinion_spring: spring(on: pinion, stiffness: pinion_stiffness);
        force rotor_spring: spring(on: rotor, stiffness: rotor_stiffness);
        point rotor_center: rotor_disk;
        force resistance: load(at: rotor_center, moment: [0 N*m, 0 N*m, -load]);
        output tooth_torque = reaction(mesh);
        output drive_torque = reaction_moment(spin_in).z;
    }
}
