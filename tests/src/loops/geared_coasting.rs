//! Geared rotors of which only the first is driven; the gear drives the second shaft.

use crate::corpus::machine;

machine! {
    /// A driven shaft, a pinion on a torsion spring, a wheel in mesh with it that runs freely, and a rotor with drag.
    pub mechanism GearedCoasting {
        input omega: rad/s;
        design ratio = 0.6 +/- 0.001;
        design pinion_mass = 800 g +/- 10 g;
        design wheel_mass = 1.9 kg +/- 20 g;
        design rotor_mass = 3.2 kg +/- 50 g;
        design pinion_stiffness = 240 N*m/rad +/- 8 N*m/rad;
        design rotor_stiffness = 150 N*m/rad +/- 5 N*m/rad;
        design drag = 0.02 N*m*s/rad +/- 10%;
        body hub: massless;
        body pinion_disk: disk(mass: pinion_mass, radius: 60 mm, axis: z);
        body wheel_disk: disk(mass: wheel_mass, radius: 110 mm, axis: z);
        body rotor_disk: disk(mass: rotor_mass, radius: 160 mm, axis: z);
        joint spin: revolute(z) from ground to hub, driven at omega;
        joint pinion: revolute(z) from hub to pinion_disk;
        joint run: revolute(z) from ground to wheel_disk at [170 mm, 0, 0], coasting;
        joint rotor: revolute(z) from wheel_disk to rotor_disk;
        constraint mesh: equation(zero: run + ratio * (spin + pinion));
        force pinion_spring: spring(on: pinion, stiffness: pinion_stiffness);
        force rotor_spring: spring(on: rotor, stiffness: rotor_stiffness);
        point rotor_center: rotor_disk;
        force air: drag(at: rotor_center, turning_damping: drag);
        output tooth_torque = reaction(mesh);
        // The gear acts on the coordinates it couples: part of what the joint transmits along its axis.
        output drive_torque = reaction_moment(spin).z - ratio * reaction(mesh);
    }
}
