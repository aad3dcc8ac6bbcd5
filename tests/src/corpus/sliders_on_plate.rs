//! A gyroscopic machine with a closed form: `truth/P3.json`.

machine! {
    /// A small block on two crossed slides of a turntable, held by springs whose rest lengths are off the axis.
    pub mechanism SlidersOnPlate {
        input omega: rad/s;
        design m = 0.5 kg +/- 0.01 kg;
        design kx = 40 N/m +/- 1.2 N/m;
        design ky = 60 N/m +/- 1.8 N/m;
        design x0 = 100 mm;
        design y0 = 20 mm;
        design cx = 0 N*s/m;
        design cy = 0 N*s/m;
        gravity 9.81 m/s^2 along -z;
        body plate: massless;
        body carriage: massless;
        body block: point(mass: m);
        joint spin: revolute(z) from ground to plate, driven at omega;
        joint x_slide: prismatic(x) from plate to carriage;
        joint y_slide: prismatic(y) from carriage to block;
        force x_spring: spring(on: x_slide, stiffness: kx, rest: x0);
        force y_spring: spring(on: y_slide, stiffness: ky, rest: y0);
        force x_damper: damper(on: x_slide, damping: cx);
        force y_damper: damper(on: y_slide, damping: cy);
        output radius = sqrt(x_slide^2 + y_slide^2);
    }
}
