//! Bars on a spinning shaft, design variables in the order of `truth/w1_w2_w3.json`: lengths, then masses.

machine! {
    /// Eight uniform bars hinged in series on a vertical shaft that spins.
    pub mechanism ChainOfEight {
        input omega: rad/s;
        design l1 = 1 m +/- 1%;
        design l2 = 1 m +/- 1%;
        design l3 = 1 m +/- 1%;
        design l4 = 1 m +/- 1%;
        design l5 = 1 m +/- 1%;
        design l6 = 1 m +/- 1%;
        design l7 = 1 m +/- 1%;
        design l8 = 1 m +/- 1%;
        design m1 = 3 kg +/- 1%;
        design m2 = 3 kg +/- 1%;
        design m3 = 3 kg +/- 1%;
        design m4 = 3 kg +/- 1%;
        design m5 = 3 kg +/- 1%;
        design m6 = 3 kg +/- 1%;
        design m7 = 3 kg +/- 1%;
        design m8 = 3 kg +/- 1%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        body bar3: rod(mass: m3, length: l3, along: -z);
        body bar4: rod(mass: m4, length: l4, along: -z);
        body bar5: rod(mass: m5, length: l5, along: -z);
        body bar6: rod(mass: m6, length: l6, along: -z);
        body bar7: rod(mass: m7, length: l7, along: -z);
        body bar8: rod(mass: m8, length: l8, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        joint theta3: revolute(y) from bar2 to bar3 at [0, 0, -l2];
        joint theta4: revolute(y) from bar3 to bar4 at [0, 0, -l3];
        joint theta5: revolute(y) from bar4 to bar5 at [0, 0, -l4];
        joint theta6: revolute(y) from bar5 to bar6 at [0, 0, -l5];
        joint theta7: revolute(y) from bar6 to bar7 at [0, 0, -l6];
        joint theta8: revolute(y) from bar7 to bar8 at [0, 0, -l7];
    }
}
