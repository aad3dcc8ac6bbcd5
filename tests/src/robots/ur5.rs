//! `truth/robots/Ur5.mech`, compiled.

use crate::corpus::machine;

machine! {
    /// An arm of six hinges.
    pub mechanism Ur5 {
        design servo = 50.0 N*m/rad +/- 5%;
        let brake = 0.5 N*m*s/rad;
        let servo_linear = 50.0 N/m;
        let brake_linear = 0.5 N*s/m;
        design mass_of_forearm_link = 2.275 kg +/- 1%;
        design mass_of_wrist_1_link = 1.219 kg +/- 1%;
        design offset_of_elbow_joint = 0.425 m +/- 1 mm;
        gravity 9.81 m/s^2 along -z;
        body base_link: rigid(mass: 4.0 kg, inertia: [0.00443333156, 0.00443333156, 0.0072, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.0] m);
        body shoulder_link: rigid(mass: 3.7 kg, inertia: [0.010267495893, 0.010267495893, 0.00666, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.0] m);
        body upper_arm_link: rigid(mass: 8.393 kg, inertia: [0.22689067591, 0.22689067591, 0.0151074, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.28] m);
        body forearm_link: rigid(mass: mass_of_forearm_link, inertia: [0.049443313556, 0.049443313556, 0.004095, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.25] m);
        body wrist_1_link: rigid(mass: mass_of_wrist_1_link, inertia: [0.111172755531, 0.111172755531, 0.21942, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.0] m);
        body wrist_2_link: rigid(mass: 1.219 kg, inertia: [0.111172755531, 0.111172755531, 0.21942, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.0] m);
        body wrist_3_link: rigid(mass: 0.1879 kg, inertia: [0.0171364731454, 0.0171364731454, 0.033822, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.0] m);
        body ee_link: massless;
        body base: massless;
        body tool0: massless;
        body world: massless;
        joint root_weld: fixed from ground to world;
        joint shoulder_pan_joint: revolute(z) from base_link to shoulder_link at [0.0, 0.0, 0.089159] m;
        joint shoulder_lift_joint: revolute(y) from shoulder_link to upper_arm_link at [0.0, 0.13585, 0.0] m rotated(y, 1.57079632679 rad);
        joint elbow_joint: revolute(y) from upper_arm_link to forearm_link at [0.0 m, -0.1197 m, offset_of_elbow_joint];
        joint wrist_1_joint: revolute(y) from forearm_link to wrist_1_link at [0.0, 0.0, 0.39225] m rotated(y, 1.57079632679 rad);
        joint wrist_2_joint: revolute(z) from wrist_1_link to wrist_2_link at [0.0, 0.093, 0.0] m;
        joint wrist_3_joint: revolute(y) from wrist_2_link to wrist_3_link at [0.0, 0.0, 0.09465] m;
        joint ee_fixed_joint: fixed from wrist_3_link to ee_link at [0.0, 0.0823, 0.0] m rotated(z, 1.57079632679 rad);
        joint base_link_base_fixed_joint: fixed from base_link to base rotated(z, -3.14159265359 rad);
        joint wrist_3_link_tool0_fixed_joint: fixed from wrist_3_link to tool0 at [0.0, 0.0823, 0.0] m rotated(x, -1.57079632679 rad);
        joint world_joint: fixed from world to base_link;
        force hold_shoulder_pan_joint: spring(on: shoulder_pan_joint, stiffness: servo);
        force brake_shoulder_pan_joint: damper(on: shoulder_pan_joint, damping: brake);
        force hold_shoulder_lift_joint: spring(on: shoulder_lift_joint, stiffness: servo);
        force brake_shoulder_lift_joint: damper(on: shoulder_lift_joint, damping: brake);
        force hold_elbow_joint: spring(on: elbow_joint, stiffness: servo);
        force brake_elbow_joint: damper(on: elbow_joint, damping: brake);
        force hold_wrist_1_joint: spring(on: wrist_1_joint, stiffness: servo);
        force brake_wrist_1_joint: damper(on: wrist_1_joint, damping: brake);
        force hold_wrist_2_joint: spring(on: wrist_2_joint, stiffness: servo);
        force brake_wrist_2_joint: damper(on: wrist_2_joint, damping: brake);
        force hold_wrist_3_joint: spring(on: wrist_3_joint, stiffness: servo);
        force brake_wrist_3_joint: damper(on: wrist_3_joint, damping: brake);
    }
}
