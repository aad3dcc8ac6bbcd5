//! Geared rotors without a drive: the motor torque and the losses determine the speed.

use crate::corpus::machine;

machine! {
    /// A motor's rotor, a pinion on a torsion spring, a wheel in mesh with it, and a rotor with drag.
    pub mechanism GearedMotor {
        input torque: N*m;
        design ratio = 0.6 +/- 0.001;
        design pinion_mass = 800 g +/- 10 g;
        design wheel_mass = 1.9 kg +/- 20 g;
        design rotor_mass = 3.2 kg +/- 50 g;
        design pinion_stiffness = 240 N*m/rad +/- 8 N*m/rad;
        design rotor_stiffness = 150 N*m/rad +/- 5 N*m/rad;
        design drag = 0.02 N*m*s/rad +/- 10%;
        design motor_inertia = 0.004 kg*m^2 +/- 0.0001 kg*m^2;
        design friction = 0.015 N*m*s/rad +/- 0.001 N*m*s/rad;
        body armature: rigid(mass: 500 g, inertia: [motor_inertia, motor_inertia, motor_inertia]);
        body pinion_disk: disk(mass: pinion_mass, radius: 60 mm, axis: z);
        body wheel_disk: disk(mass: wheel_mass, radius: 110 mm, axis: z);
        body rotor_disk: disk(mass: rotor_mass, radius: 160 mm, axis: z);
        joint run_in: revolute(z) from ground to armature, coasting;
        joint pinion: revolute(z) from armature to pinion_disk;
        joint run_out: revolute(z) from ground to wheel_disk at [170 mm, 0, 0], coasting;
        joint rotor: revolute(z) from wheel_disk to rotor_disk;
        constraint mesh: equation(zero: run_out + ratio * (run_in + pinion));
        force motor: generalized(on: run_in, value: torque);
        force bearing: damper(on: run_in, damping: friction);
        force pinion_spring: spring(on: pinion, stiffness: pinion_stiffness);
        force rotor_spring: spring(on: rotor, stiffness: rotor_stiffness);
        point rotor_center: rotor_disk;
        force air: drag(at: rotor_center, turning_damping: drag);
        output tooth_torque = reaction(mesh);
        output motor_speed = rate(run_in);
    }
}
