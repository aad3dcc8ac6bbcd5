//! A public seven-joint robot arm: the numbers of `truth/panda_arm.json`.

machine! {
    /// An arm held by servos that act as springs.
    pub mechanism RobotArm {
        design servo = 500 N*m/rad +/- 5%;
        gravity 9.81 m/s^2 along -z;
        body link1: rigid(mass: 4.970684 kg, center: [0.003875, 0.002081, -0.04762] m,
            inertia: [0.70337, 0.70661, 0.009117, -0.000139, 0.019169, 0.006772] kg*m^2);
        joint q1: revolute(z) from ground to link1 at [0.0, 0.0, 0.333] m;
        force servo1: spring(on: q1, stiffness: servo);
        body link2: rigid(mass: 0.646926 kg, center: [-0.003141, -0.02872, 0.003495] m,
            inertia: [0.007962, 0.02811, 0.025995, -0.003925, 0.000704, 0.010254] kg*m^2);
        joint q2: revolute(z) from link1 to link2 rotated(x, -90 deg);
        force servo2: spring(on: q2, stiffness: servo);
        body link3: rigid(mass: 3.228604 kg, center: [0.027518, 0.039252, -0.066502] m,
            inertia: [0.037242, 0.036155, 0.01083, -0.004761, -0.012805, -0.011396] kg*m^2);
        joint q3: revolute(z) from link2 to link3 at [0.0, -0.316, 0.0] m rotated(x, 90 deg);
        force servo3: spring(on: q3, stiffness: servo);
        body link4: rigid(mass: 3.587895 kg, center: [-0.05316999999999998, 0.10441899999999996, 0.02745399999999999] m,
            inertia: [0.025853, 0.019552, 0.028323, 0.007796, 0.008641, -0.001332] kg*m^2);
        joint q4: revolute(z) from link3 to link4 at [0.0825, 0.0, 0.0] m rotated(x, 90 deg);
        force servo4: spring(on: q4, stiffness: servo);
        body link5: rigid(mass: 1.225946 kg, center: [-0.011953, 0.041065, -0.038437] m,
            inertia: [0.035549, 0.029474, 0.008627, -0.002117, 0.000229, -0.004037] kg*m^2);
        joint q5: revolute(z) from link4 to link5 at [-0.0825, 0.384, 0.0] m rotated(x, -90 deg);
        force servo5: spring(on: q5, stiffness: servo);
        body link6: rigid(mass: 1.666555 kg, center: [0.060149, -0.014117, -0.010517] m,
            inertia: [0.0019640000000000005, 0.004354, 0.005433, 0.000109, 0.000341, -0.001158] kg*m^2);
        joint q6: revolute(z) from link5 to link6 rotated(x, 90 deg);
        force servo6: spring(on: q6, stiffness: servo);
        body link7: rigid(mass: 1.4955219999999998 kg, center: [0.0017208742976286579, 0.00136035441716123, 0.1004852811486558] m,
            inertia: [0.016529853712634626, 0.014107248642161839, 0.006676955556640956, 0.0003948922971191777, -0.001051105327046708, -0.0007066957106145017] kg*m^2);
        joint q7: revolute(z) from link6 to link7 at [0.088, 0.0, 0.0] m rotated(x, 90 deg);
        force servo7: spring(on: q7, stiffness: servo);
        point flange: link7 at [0, 0, 107 mm];
        output height = position(flange).z;
    }
}
