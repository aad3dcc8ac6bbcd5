//! Machines that can be driven, or stripped of their springs, until nothing holds them.

eigentol::mechanism! {
    /// A mass on a radial spring of a spinning plate: the spring holds it up to `omega^2 = k / m`.
    pub mechanism SprungMass {
        input omega: rad/s;
        design m = 1 kg +/- 1%;
        design k = 100 N/m +/- 1%;
        design rest = 0.1 m;
        body plate: massless;
        body block: point(mass: m);
        joint spin: revolute(z) from ground to plate, driven at omega;
        joint slide: prismatic(x) from plate to block;
        force spring: spring(on: slide, stiffness: k, rest: rest);
    }
}

eigentol::mechanism! {
    /// A bar standing on its hinge, held upright by a spring that may be too weak.
    pub mechanism StandingBar {
        input lean: rad;
        design m = 2 kg +/- 1%;
        design l = 1 m +/- 1%;
        design k = 5 N*m/rad;
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: m, length: l, along: z);
        joint theta: revolute(y) from ground to bar;
        force spring: spring(on: theta, stiffness: k, rest: lean);
    }
}

eigentol::mechanism! {
    /// A bar that nothing holds once its spring is gone.
    pub mechanism FreeBar {
        design m = 2 kg;
        design k = 1 N*m/rad;
        body bar: rod(mass: m, length: 1 m, along: x);
        joint theta: revolute(z) from ground to bar;
        force spring: spring(on: theta, stiffness: k);
    }
}

eigentol::mechanism! {
    /// A weight on a spring, which falls once the spring is gone.
    pub mechanism Falling {
        design m = 2 kg;
        design k = 1 N/m;
        gravity 9.81 m/s^2 along -z;
        body block: point(mass: m);
        joint height: prismatic(z) from ground to block;
        force spring: spring(on: height, stiffness: k);
    }
}
