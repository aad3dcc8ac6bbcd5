//! What beams require of a design is checked whenever the design changes.

use eigentol::kernels::Kernels;

use crate::beams::compared::machine;

/// The first requirement that a design breaks.
fn broken(text: &str, design: &[f64]) -> Option<String> {
    let machine = machine(text);
    let found = machine.violation(&[], design)?;
    Some(found.quantity.to_string())
}

const BLADE: &str = "mechanism Blade {
    design L = 1 m; design w = 20 mm; design h = 5 mm; design E = 70 GPa; design rho = 2700 kg/m^3;
    material metal: density rho, modulus E, poisson 0.3;
    body blade: beam(length: L, along: x, up: z, section: rectangle(width: w, height: h) to rectangle(width: w, height: h / 2),
        material: metal, bending: 2, torsion: 1);
    joint clamp: fixed from ground to blade;
}";

#[test]
fn dimensions_and_moduli_must_be_positive() {
    let right = [1.0, 0.02, 0.005, 70e9, 2700.0];
    assert_eq!(broken(BLADE, &right), None);
    let wrong = [
        (0, "length of blade"),
        (1, "width of blade"),
        (2, "height of blade"),
        (3, "Young's modulus of blade"),
        (4, "density of blade"),
    ];
    for (k, expected) in wrong {
        for factor in [0.0, -1.0] {
            let mut design = right;
            design[k] *= factor;
            let text = broken(BLADE, &design);
            // A negative modulus makes the shear modulus negative too.
            assert_eq!(text.as_deref(), Some(expected), "{design:?}");
        }
    }
}

#[test]
fn tubes_need_a_wall_and_numbers_must_be_positive() {
    let tube = "mechanism Boom {
        design outer = 20 mm; design inner = 18 mm;
        body boom: beam(length: 1 m, along: x, up: z, section: tube(outer: outer, inner: inner),
            density: 2700 kg/m^3, modulus: 70 GPa, bending_y: 3);
        joint clamp: fixed from ground to boom;
    }";
    assert_eq!(broken(tube, &[0.02, 0.018]), None);
    let wall = broken(tube, &[0.018, 0.02]);
    assert_eq!(wall.as_deref(), Some("thickness of the wall of boom"));
    let numbers = "mechanism Boom {
        design m = 1 kg/m; design EI = 20 N*m^2;
        body boom: beam(length: 1 m, along: x, up: z, mass_per_length: m, stiffness_y: EI, bending_y: 3);
        joint clamp: fixed from ground to boom;
    }";
    assert_eq!(broken(numbers, &[1.0, 20.0]), None);
    assert_eq!(broken(numbers, &[0.0, 20.0]).as_deref(), Some("mass per length of boom"));
    let stiffness = broken(numbers, &[1.0, -20.0]);
    assert_eq!(stiffness.as_deref(), Some("bending stiffness about y of boom"));
}

/// Entries beside the diagonal can make a section give way although its diagonal is positive.
#[test]
fn a_matrix_of_stiffness_must_be_positive_definite() {
    let text = "mechanism Blade {
        design both = 1 N*m^2; design axial = 5 N;
        body blade: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, inertia_y: 1 g*m, inertia_z: 2 g*m,
            bending: 2, torsion: 1,
            stiffness: [[axial, 0, 0, 0, 1 N*m, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0],
                [0, 0, 0, 1, both, 0], [1 N*m, 0, 0, both, 2, 0], [0, 0, 0, 0, 0, 3]]);
        joint clamp: fixed from ground to blade;
    }";
    let bending = "stiffness of blade against bending about y with the strains of earlier rows free";
    let axial = "stiffness of blade against stretch with the strains of earlier rows free";
    // about y 2 - 1 / axial - both^2 is left
    let cases = [
        ([1.0, 5.0], None),
        ([-1.3, 5.0], None),
        ([1.35, 5.0], Some(bending)),
        ([-1.35, 5.0], Some(bending)),
        ([1.0, 0.9], Some(bending)),
        ([1.0, -5.0], Some(axial)),
    ];
    for (design, expected) in cases {
        assert_eq!(broken(text, &design).as_deref(), expected, "{design:?}");
    }
}

/// Without inertia about the axis the default has no torsion, so the machine has modes.
#[test]
fn torsion_by_default_needs_inertia() {
    let text = |inertia: &str| {
        format!(
            "mechanism Boom {{
                body boom: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 20 N*m^2,
                    stiffness_z: 30 N*m^2, torsion_stiffness: 5 N*m^2, {inertia}bending: 3);
                joint clamp: fixed from ground to boom;
            }}"
        )
    };
    let unknowns = |text: &str| machine(text).description().coordinates.len();
    assert_eq!(unknowns(&text("")), 6);
    assert_eq!(unknowns(&text("inertia_y: 1e-4 kg*m, ")), 8);
}
