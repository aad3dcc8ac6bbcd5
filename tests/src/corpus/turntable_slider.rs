//! A slide on a turntable with a pendulum hanging from it.

machine! {
    /// A carriage on a radial slide of a turntable, with a pendulum hanging from it that swings across the slide.
    pub mechanism TurntableSlider {
        input omega: rad/s;
        design carriage_mass = 2.5 kg +/- 50 g;
        design bob_mass = 800 g;
        design length = 0.4 m +/- 2 mm;
        design stiffness = 900 N/m +/- 4%;
        design rest = 0.25 m +/- 1 mm;
        gravity [0, 0, -9.81] m/s^2;
        body table: disk(mass: 12 kg, radius: 0.6 m, axis: z);
        body carriage: box(mass: carriage_mass, size: [120 mm, 80 mm, 40 mm], center: [0, 0, 20 mm]);
        body pendulum: rigid(mass: bob_mass, center: [0, 0, -length],
                             inertia: [bob_mass * length^2 / 30, bob_mass * length^2 / 30, 0.001 kg*m^2]);
        joint spin: revolute(z) from ground to table, driven at 2 * omega;
        joint slide: prismatic(x) from table to carriage;
        joint swing: revolute(x) from carriage to pendulum at [0, 10 mm, 0];
        force spring: spring(on: slide, stiffness: stiffness, rest: rest);
        force drag: damper(on: slide, damping: 3 N*s/m);
        output reach = slide;
        output tilt = swing;
    }
}
