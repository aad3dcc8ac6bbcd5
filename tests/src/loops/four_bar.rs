//! The four-bar in its two assembly modes, closed by a joint that is declared `cut`.

use crate::corpus::machine;

machine! {
    /// A four-bar linkage in a vertical plane through the axis of a driven table, with a spring and a dashpot on a
    /// diagonal.
    pub mechanism FourBar {
        input omega: rad/s;
        design crank = 150 mm +/- 0.4 mm;
        design coupler = 260 mm +/- 0.4 mm;
        design rocker = 220 mm +/- 0.4 mm;
        design spacing = 300 mm +/- 0.5 mm;
        design coupler_mass = 600 g +/- 10 g;
        design stiffness = 800 N/m +/- 30 N/m;
        design free_length = 300 mm +/- 2 mm;
        design damping = 3 N*s/m +/- 10%;
        gravity 9.81 m/s^2 along -z;
        body table: massless;
        body crank_bar: rod(mass: 400 g, length: crank, along: x);
        body coupler_bar: rod(mass: coupler_mass, length: coupler, along: x);
        body rocker_bar: rod(mass: 500 g, length: rocker, along: x);
        joint spin: revolute(z) from ground to table, driven at omega;
        joint crank_angle: revolute(-y) from table to crank_bar at [100 mm, 0, 0];
        joint elbow: revolute(-y) from crank_bar to coupler_bar at [crank, 0, 0];
        joint rocker_angle: revolute(-y) from table to rocker_bar at [100 mm + spacing, 0, 0];
        joint close: revolute(y) from coupler_bar to rocker_bar at [coupler, 0, 0], at [rocker, 0, 0] on rocker_bar, cut;
        point pivot: table at [100 mm, 0, 0];
        point corner: coupler_bar at [coupler, 0, 0];
        force diagonal: spring_damper(from: pivot, to: corner, stiffness: stiffness, damping: damping, length: free_length);
        output close_force = norm(reaction_force(close));
        output diagonal_length = distance(pivot, corner);
    }
}
