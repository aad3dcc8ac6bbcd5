//! `truth/robots/Solo12Free.mech`, compiled.

use crate::corpus::machine;

machine! {
    /// A walking robot: twelve hinges and a floating base.
    pub mechanism Solo12Free {
        design servo = 50.0 N*m/rad +/- 5%;
        let brake = 0.5 N*m*s/rad;
        let servo_linear = 50.0 N/m;
        let brake_linear = 0.5 N*s/m;
        gravity 9.81 m/s^2 along -z;
        body base_link: rigid(mass: 1.16115091 kg, inertia: [0.00578574, 0.01938108, 0.02476124, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.0] m);
        body FL_SHOULDER: rigid(mass: 0.14853845 kg, inertia: [3.024e-05, 0.00041193, 0.00041107, 4.671e-05, 0.0, 0.0] kg*m^2, center: [-0.078707, 0.01, 0.0] m);
        body FL_UPPER_LEG: rigid(mass: 0.14853845 kg, inertia: [0.00041107, 0.00041193, 3.024e-05, 0.0, 4.671e-05, 0.0] kg*m^2, center: [1.377e-05, 0.01935853, -0.078707] m);
        body FL_LOWER_LEG: rigid(mass: 0.03070001 kg, inertia: [0.00012024, 0.00012029, 2.16e-06, 0.0, 3.05e-06, 0.0] kg*m^2, center: [0.0, 0.00787644, -0.08928215] m);
        body FL_FOOT: rigid(mass: 0.00693606 kg, inertia: [5.7e-07, 8.4e-07, 5.3e-07, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.00035767] m);
        body FR_SHOULDER: rigid(mass: 0.14853845 kg, inertia: [3.024e-05, 0.00041193, 0.00041107, -4.671e-05, 0.0, 0.0] kg*m^2, center: [-0.078707, -0.01, 0.0] m);
        body FR_UPPER_LEG: rigid(mass: 0.14853845 kg, inertia: [0.00041107, 0.00041193, 3.024e-05, 0.0, -4.671e-05, 0.0] kg*m^2, center: [-1.377e-05, -0.01935853, -0.078707] m);
        body FR_LOWER_LEG: rigid(mass: 0.03070001 kg, inertia: [0.00012024, 0.00012029, 2.16e-06, 0.0, -3.05e-06, 0.0] kg*m^2, center: [0.0, -0.00787644, -0.08928215] m);
        body FR_FOOT: rigid(mass: 0.00693606 kg, inertia: [5.7e-07, 8.4e-07, 5.3e-07, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.00035767] m);
        body HL_SHOULDER: rigid(mass: 0.14853845 kg, inertia: [3.024e-05, 0.00041193, 0.00041107, 4.671e-05, 0.0, 0.0] kg*m^2, center: [0.078707, 0.01, 0.0] m);
        body HL_UPPER_LEG: rigid(mass: 0.14853845 kg, inertia: [0.00041107, 0.00041193, 3.024e-05, 0.0, 4.671e-05, 0.0] kg*m^2, center: [1.377e-05, 0.01935853, -0.078707] m);
        body HL_LOWER_LEG: rigid(mass: 0.03070001 kg, inertia: [0.00012024, 0.00012029, 2.16e-06, 0.0, 3.05e-06, 0.0] kg*m^2, center: [0.0, 0.00787644, -0.08928215] m);
        body HL_FOOT: rigid(mass: 0.00693606 kg, inertia: [5.7e-07, 8.4e-07, 5.3e-07, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.00035767] m);
        body HR_SHOULDER: rigid(mass: 0.14853845 kg, inertia: [3.024e-05, 0.00041193, 0.00041107, -4.671e-05, 0.0, 0.0] kg*m^2, center: [0.078707, -0.01, 0.0] m);
        body HR_UPPER_LEG: rigid(mass: 0.14853845 kg, inertia: [0.00041107, 0.00041193, 3.024e-05, 0.0, -4.671e-05, 0.0] kg*m^2, center: [-1.377e-05, -0.01935853, -0.078707] m);
        body HR_LOWER_LEG: rigid(mass: 0.03070001 kg, inertia: [0.00012024, 0.00012029, 2.16e-06, 0.0, -3.05e-06, 0.0] kg*m^2, center: [0.0, -0.00787644, -0.08928215] m);
        body HR_FOOT: rigid(mass: 0.00693606 kg, inertia: [5.7e-07, 8.4e-07, 5.3e-07, 0.0, 0.0, 0.0] kg*m^2, center: [0.0, 0.0, 0.00035767] m);
        joint root_free: free(base_px: x, base_py: y, base_pz: z, base_yaw: z, base_pitch: y, base_roll: x) from ground to base_link;
        joint FL_HAA: revolute(x) from base_link to FL_SHOULDER at [0.1946, 0.0875, 0.0] m;
        joint FL_HFE: revolute(y) from FL_SHOULDER to FL_UPPER_LEG at [0.0, 0.014, 0.0] m;
        joint FL_KFE: revolute(y) from FL_UPPER_LEG to FL_LOWER_LEG at [0.0, 0.03745, -0.16] m;
        joint FL_ANKLE: fixed from FL_LOWER_LEG to FL_FOOT at [0.0, 0.008, -0.16] m;
        joint FR_HAA: revolute(x) from base_link to FR_SHOULDER at [0.1946, -0.0875, 0.0] m;
        joint FR_HFE: revolute(y) from FR_SHOULDER to FR_UPPER_LEG at [0.0, -0.014, 0.0] m;
        joint FR_KFE: revolute(y) from FR_UPPER_LEG to FR_LOWER_LEG at [0.0, -0.03745, -0.16] m;
        joint FR_ANKLE: fixed from FR_LOWER_LEG to FR_FOOT at [0.0, -0.008, -0.16] m;
        joint HL_HAA: revolute(x) from base_link to HL_SHOULDER at [-0.1946, 0.0875, 0.0] m;
        joint HL_HFE: revolute(y) from HL_SHOULDER to HL_UPPER_LEG at [0.0, 0.014, 0.0] m;
        joint HL_KFE: revolute(y) from HL_UPPER_LEG to HL_LOWER_LEG at [0.0, 0.03745, -0.16] m;
        joint HL_ANKLE: fixed from HL_LOWER_LEG to HL_FOOT at [0.0, 0.008, -0.16] m;
        joint HR_HAA: revolute(x) from base_link to HR_SHOULDER at [-0.1946, -0.0875, 0.0] m;
        joint HR_HFE: revolute(y) from HR_SHOULDER to HR_UPPER_LEG at [0.0, -0.014, 0.0] m;
        joint HR_KFE: revolute(y) from HR_UPPER_LEG to HR_LOWER_LEG at [0.0, -0.03745, -0.16] m;
        joint HR_ANKLE: fixed from HR_LOWER_LEG to HR_FOOT at [0.0, -0.008, -0.16] m;
        force hold_px: spring(on: base_px, stiffness: servo_linear);
        force brake_px: damper(on: base_px, damping: brake_linear);
        force hold_py: spring(on: base_py, stiffness: servo_linear);
        force brake_py: damper(on: base_py, damping: brake_linear);
        force hold_pz: spring(on: base_pz, stiffness: servo_linear);
        force brake_pz: damper(on: base_pz, damping: brake_linear);
        force hold_yaw: spring(on: base_yaw, stiffness: servo);
        force brake_yaw: damper(on: base_yaw, damping: brake);
        force hold_pitch: spring(on: base_pitch, stiffness: servo);
        force brake_pitch: damper(on: base_pitch, damping: brake);
        force hold_roll: spring(on: base_roll, stiffness: servo);
        force brake_roll: damper(on: base_roll, damping: brake);
        force hold_FL_HAA: spring(on: FL_HAA, stiffness: servo);
        force brake_FL_HAA: damper(on: FL_HAA, damping: brake);
        force hold_FL_HFE: spring(on: FL_HFE, stiffness: servo);
        force brake_FL_HFE: damper(on: FL_HFE, damping: brake);
        force hold_FL_KFE: spring(on: FL_KFE, stiffness: servo);
        force brake_FL_KFE: damper(on: FL_KFE, damping: brake);
        force hold_FR_HAA: spring(on: FR_HAA, stiffness: servo);
        force brake_FR_HAA: damper(on: FR_HAA, damping: brake);
        force hold_FR_HFE: spring(on: FR_HFE, stiffness: servo);
        force brake_FR_HFE: damper(on: FR_HFE, damping: brake);
        force hold_FR_KFE: spring(on: FR_KFE, stiffness: servo);
        force brake_FR_KFE: damper(on: FR_KFE, damping: brake);
        force hold_HL_HAA: spring(on: HL_HAA, stiffness: servo);
        force brake_HL_HAA: damper(on: HL_HAA, damping: brake);
        force hold_HL_HFE: spring(on: HL_HFE, stiffness: servo);
        force brake_HL_HFE: damper(on: HL_HFE, damping: brake);
        force hold_HL_KFE: spring(on: HL_KFE, stiffness: servo);
        force brake_HL_KFE: damper(on: HL_KFE, damping: brake);
        force hold_HR_HAA: spring(on: HR_HAA, stiffness: servo);
        force brake_HR_HAA: damper(on: HR_HAA, damping: brake);
        force hold_HR_HFE: spring(on: HR_HFE, stiffness: servo);
        force brake_HR_HFE: damper(on: HR_HFE, damping: brake);
        force hold_HR_KFE: spring(on: HR_KFE, stiffness: servo);
        force brake_HR_KFE: damper(on: HR_KFE, damping: brake);
    }
}
