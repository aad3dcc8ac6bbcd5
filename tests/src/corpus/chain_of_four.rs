//! Bars on a spinning shaft, design variables in the order of `truth/w1_w2_w3.json`: lengths, then masses.

machine! {
    /// Four uniform bars hinged in series on a vertical shaft that spins.
    pub mechanism ChainOfFour {
        input omega: rad/s;
        design l1 = 1 m +/- 1%;
        design l2 = 1 m +/- 1%;
        design l3 = 1 m +/- 1%;
        design l4 = 1 m +/- 1%;
        design m1 = 3 kg +/- 1%;
        design m2 = 3 kg +/- 1%;
        design m3 = 3 kg +/- 1%;
        design m4 = 3 kg +/- 1%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        body bar3: rod(mass: m3, length: l3, along: -z);
        body bar4: rod(mass: m4, length: l4, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        joint theta3: revolute(y) from bar2 to bar3 at [0, 0, -l2];
        joint theta4: revolute(y) from bar3 to bar4 at [0, 0, -l3];
    }
}
