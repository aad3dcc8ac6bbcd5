//! A beam that is stiffer across its narrow side.

#![deny(deprecated)]

use eigentol::mechanism;

mechanism! {
    pub mechanism Blade {
        body blade: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 9 N*m^2, stiffness_z: 2 N*m^2,
            width: 40 mm, height: 5 mm, bending: 2);
        joint clamp: fixed from ground to blade;
    }
}

mechanism! {
    /// Meant like this.
    #[allow(deprecated)]
    pub mechanism Wing {
        body wing: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 9 N*m^2, stiffness_z: 2 N*m^2,
            width: 40 mm, height: 5 mm, bending: 2);
        joint clamp: fixed from ground to wing;
    }
}

fn main() {}
