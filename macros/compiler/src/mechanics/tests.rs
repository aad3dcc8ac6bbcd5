use crate::base::ids::*;
use crate::model::expression::Expr;
use crate::model::mechanism::*;
use crate::topology::*;
use proc_macro2::{Ident, Span};
use std::rc::Rc;

fn id(s: &str) -> Ident {
    Ident::new(s, Span::call_site())
}
fn num(x: f64) -> Expr {
    Expr::Number(x)
}
fn v(x: f64, y: f64, z: f64) -> [Expr; 3] {
    [num(x), num(y), num(z)]
}

fn chain(n: usize) -> (Mechanism, Topology) {
    let mut m = Mechanism {
        name: id("Chain"),
        visibility: syn::Visibility::Inherited,
        attributes: vec![],
        inputs: vec![Input {
            name: id("omega"),
            docs: vec![],
            unit: Unit {
                symbol: "rad/s".into(),
                scale: 1.0,
            },
        }],
        design: vec![],
        constants: vec![],
        gravity: v(0.0, 0.0, -9.81),
        bodies: vec![Body {
            name: id("shaft"),
            shape: Shape::Massless,
        }],
        joints: vec![],
        coordinates: vec![],
        points: vec![],
        forces: vec![],
        outputs: vec![],
    };
    let none = || Placement {
        offset: v(0.0, 0.0, 0.0),
        rotations: vec![],
    };
    m.joints.push(Joint {
        name: id("spin"),
        kind: JointKind::Revolute {
            axis: v(0.0, 0.0, 1.0),
            coordinate: CoordinateId(0),
        },
        from: Frame::Ground,
        to: Frame::Body(BodyId(0)),
        from_placement: none(),
        to_placement: none(),
    });
    m.coordinates.push(Coordinate {
        name: id("spin"),
        joint: JointId(0),
        quantity: CoordinateQuantity::Angle,
        motion: Motion::Driven(Expr::Input(InputId(0))),
    });
    for i in 0..n {
        for (p, x) in [("l", 1.0), ("m", 3.0)] {
            m.design.push(DesignVariable {
                name: id(&format!("{p}{}", i + 1)),
                docs: vec![],
                unit: Unit {
                    symbol: "m".into(),
                    scale: 1.0,
                },
                nominal: x,
                tolerance: 0.0,
            });
        }
        let l = Expr::Design(DesignId::new(2 * i));
        let mass = Expr::Design(DesignId::new(2 * i + 1));
        let half = Expr::Multiply(Rc::new(num(-0.5)), Rc::new(l.clone()));
        m.bodies.push(Body {
            name: id(&format!("bar{}", i + 1)),
            shape: Shape::Rod {
                mass,
                length: l,
                along: v(0.0, 0.0, -1.0),
                center: [num(0.0), num(0.0), half],
            },
        });
        let name = id(&format!("theta{}", i + 1));
        let mut fp = none();
        if i > 0 {
            fp.offset[2] = Expr::Negate(Rc::new(Expr::Design(DesignId::new(2 * (i - 1)))));
        }
        m.joints.push(Joint {
            name: name.clone(),
            kind: JointKind::Revolute {
                axis: v(0.0, 1.0, 0.0),
                coordinate: CoordinateId::new(i + 1),
            },
            from: Frame::Body(BodyId::new(i)),
            to: Frame::Body(BodyId::new(i + 1)),
            from_placement: fp,
            to_placement: none(),
        });
        m.coordinates.push(Coordinate {
            name,
            joint: JointId::new(i + 1),
            quantity: CoordinateQuantity::Angle,
            motion: Motion::Free,
        });
    }
    let t = Topology {
        branches: (0..=n)
            .map(|i| Branch {
                body: BodyId::new(i),
                parent: if i == 0 {
                    Frame::Ground
                } else {
                    Frame::Body(BodyId::new(i - 1))
                },
                joint: JointId::new(i),
                reversed: false,
            })
            .collect(),
        free: (1..=n).map(CoordinateId::new).collect(),
        driven: vec![CoordinateId(0)],
    };
    (m, t)
}

#[test]
fn counts() {
    for n in [1, 2, 4, 8, 16] {
        let (m, t) = chain(n);
        let start = std::time::Instant::now();
        let f = super::derive(
            &m,
            &t,
            super::Limits {
                explicit_partials: usize::MAX,
            },
        )
        .unwrap_or_else(|d| panic!("{:?}", d.iter().collect::<Vec<_>>()));
        println!(
            "n={n} {:?} graph {} {:?}",
            f.properties,
            f.graph.len(),
            start.elapsed()
        );
        for k in &f.functions {
            let c = k.cost(&f.graph);
            print!("{} {}+{} | ", k.name, c.operations, c.functions);
        }
        let both: Vec<_> = f
            .functions
            .iter()
            .filter(|k| k.name == "mode_gradient" || k.name == "residual_gradient")
            .flat_map(|k| k.roots())
            .collect();
        println!("\n both {:?}", crate::algebra::cost(&f.graph, &both));
    }
}

#[test]
fn dump() {
    let n: usize = std::env::var("CHAIN")
        .ok()
        .and_then(|s| s.parse().ok())
        .unwrap_or(2);
    let (m, t) = chain(n);
    let start = std::time::Instant::now();
    let f = super::derive(&m, &t, super::Limits::default())
        .unwrap_or_else(|d| panic!("{:?}", d.iter().collect::<Vec<_>>()));
    println!("derive {:?}", start.elapsed());
    let p = crate::program::lower(&f.graph, &f.functions);
    println!("lower {:?}", start.elapsed());
    let code = crate::emit::emit(&m, &t, f.properties, &f.requirements, &p);
    println!("emit {:?}", start.elapsed());
    let file: syn::File = syn::parse2(code).unwrap();
    std::fs::write(format!("/tmp/chain{n}.rs"), prettyplease::unparse(&file)).unwrap();
}
