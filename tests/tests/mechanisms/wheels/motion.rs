//! The full nonlinear motion of a coin that rolls and leans, against its equations written by hand.
//!
//! With `phi` the lean, `psi'` the yaw rate, `n = spin + psi' sin phi`, `A` and `C` the moments of inertia across and
//! along the axle, angular momentum about the centre along the horizontal diameter, the axle and the steepest diameter
//! gives
//!
//! ```text
//! (A + m r^2) phi'' = -A psi'^2 sin cos + (C + m r^2) n psi' cos + m g r sin
//! (C + m r^2) n'    = -m r^2 psi' phi' cos
//! A psi'' cos       = 2 A psi' phi' sin - C phi' n
//! ```

use eigentol::mechanism;
use eigentol::motion::accelerations;

use super::common::close;

mechanism! {
    /// A uniform thin coin on a table.
    mechanism Coin {
        design m = 0.4 kg;
        design r = 0.2 m;
        gravity 9.81 m/s^2 along -z;
        body base: massless;
        body mast: massless;
        body cradle: massless;
        body coin: disk(mass: m, radius: r, axis: y);
        joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
        joint height: prismatic(z) from base to mast;
        joint lean: revolute(x) from mast to cradle;
        joint spin: revolute(y) from cradle to coin, coasting;
        point table: ground;
        point center: coin;
        constraint contact: rolling(wheel: center, axis: y, radius: r, on: table);
    }
}

#[test]
fn a_coin_rolls_as_its_equations_say() {
    let (m, r, g) = (0.4, 0.2, 9.81);
    let (across, along) = (0.25 * m * r * r, 0.5 * m * r * r);
    for [phi, rate, yaw, spin] in
        [[0.3, 0.2, 1.5, 5.0], [-0.7, 1.1, -2.0, 9.0], [1.1, -0.6, 4.0, -3.0], [0.0, 0.5, 0.0, 2.0]]
    {
        let (s, c) = f64::sin_cos(phi);
        let n = spin + yaw * s;
        let rolled = m * r * r;
        let lean = (-across * yaw * yaw * s * c + (along + rolled) * n * yaw * c + m * g * r * s) / (across + rolled);
        let turned = -rolled * yaw * rate * c / (along + rolled);
        let swung = (2.0 * across * yaw * rate * s - along * rate * n) / (across * c);
        // Force of the table on the coin: along the horizontal diameter, the axle, the steepest diameter.
        let force = [
            m * r * (turned + yaw * c * rate),
            m * r * (yaw * c * n - lean) + m * g * s,
            -m * r * (rate * rate + yaw * s * n) + m * g * c,
        ];
        let expected = [
            -r * (lean * s + rate * rate * c),
            lean,
            r * turned,
            -r * (lean * c - rate * rate * s),
            swung,
            turned - swung * s - yaw * c * rate,
            s * force[1] + c * force[2],
            force[0],
            c * force[1] - s * force[2],
        ];

        let q = [r * c, phi, r * n, -r * rate * c, yaw, spin, 0.0, 0.0, 0.0];
        let velocity = [-r * rate * s, rate, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let values = accelerations(&Coin, &velocity, &q, &[], &[m, r]).expect("regular");
        for (k, (found, expected)) in values.iter().zip(expected).enumerate() {
            close(*found, expected, 1.0, &format!("unknown {k} leaning {phi}"));
        }
    }
}
