//! The five-bar: two chains whose ends coincide, with two gyroscopically coupled freedoms.

use crate::corpus::machine;

machine! {
    /// A five-bar linkage in a horizontal plane on a driven table, torsion springs on both cranks.
    pub mechanism FiveBar {
        input omega: rad/s;
        design left_crank = 120 mm +/- 0.3 mm;
        design right_crank = 130 mm +/- 0.3 mm;
        design left_coupler = 200 mm +/- 0.4 mm;
        design right_coupler = 210 mm +/- 0.4 mm;
        design spacing = 150 mm +/- 0.5 mm;
        design tool = 500 g +/- 10 g;
        design left_stiffness = 9 N*m/rad +/- 0.3 N*m/rad;
        design right_stiffness = 7 N*m/rad +/- 0.2 N*m/rad;
        body table: massless;
        body crank_left: rod(mass: 300 g, length: left_crank, along: x);
        body crank_right: rod(mass: 350 g, length: right_crank, along: x);
        body coupler_left: rod(mass: 250 g, length: left_coupler, along: x)
            + point(mass: tool) at [left_coupler, 0, 0];
        body coupler_right: rod(mass: 280 g, length: right_coupler, along: x);
        joint spin: revolute(z) from ground to table, driven at omega;
        joint left: revolute(z) from table to crank_left at [-spacing / 2, 50 mm, 0];
        joint right: revolute(z) from table to crank_right at [spacing / 2, 50 mm, 0];
        joint left_elbow: revolute(z) from crank_left to coupler_left at [left_crank, 0, 0];
        joint right_elbow: revolute(z) from crank_right to coupler_right at [right_crank, 0, 0];
        point left_tip: coupler_left at [left_coupler, 0, 0];
        point right_tip: coupler_right at [right_coupler, 0, 0];
        point post: table at [0, 150 mm, 0];
        constraint tip: coincident(from: left_tip, to: right_tip, along: [x, y]);
        force left_spring: spring(on: left, stiffness: left_stiffness, rest: 2 rad);
        force right_spring: spring(on: right, stiffness: right_stiffness, rest: 1 rad);
        force tie: spring_damper(from: post, to: left_tip, stiffness: 60 N/m);
        output tip_force = norm(reaction_force(tip));
        output reach = distance_from_axis(left_tip, z);
    }
}
