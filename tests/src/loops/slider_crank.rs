//! The slider-crank: a loop of four joints, in which the compiler chooses the cut.

use crate::corpus::machine;

machine! {
    /// A slider-crank in a vertical plane through the axis of a driven table, held by a spring on the slider.
    pub mechanism SliderCrank {
        input omega: rad/s;
        design crank = 80 mm +/- 0.2 mm;
        design rod = 200 mm +/- 0.5 mm;
        design height = 15 mm +/- 0.2 mm;
        design base = 60 mm +/- 0.3 mm;
        design crank_mass = 400 g +/- 10 g;
        design rod_mass = 600 g +/- 10 g;
        design slider_mass = 900 g +/- 20 g;
        design stiffness = 3 kN/m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body table: massless;
        body arm: rod(mass: crank_mass, length: crank, along: x);
        body coupler: rod(mass: rod_mass, length: rod, along: x);
        body slider: point(mass: slider_mass);
        joint spin: revolute(z) from ground to table, driven at omega;
        joint crank_angle: revolute(-y) from table to arm at [base, 0, 0];
        joint pin: revolute(-y) from arm to coupler at [crank, 0, 0];
        joint wrist: revolute(-y) from coupler to slider at [rod, 0, 0];
        joint guide: prismatic(x) from table to slider at [base, 0, height];
        force hold: spring(on: guide, stiffness: stiffness, rest: 240 mm);
        output pin_force = norm(reaction_force(pin));
        output guide_force = reaction_force(guide).z;
        output stroke = guide;
    }
}
