use eigentol_urdf::*;
fn main() {
    let mut args: Vec<String> = std::env::args().skip(1).collect();
    let mode = args.remove(0);
    for p in args {
        let t = std::fs::read_to_string(&p).unwrap();
        let mut o = Options::default().nearest_inertias(mode.contains('n'));
        if mode.contains('f') {
            o = o.base(Base::Floating)
        }
        if mode.contains('k') {
            o = o.resistance(Resistance::KernelsOnly)
        }
        if mode.contains('d') {
            o = o.resistance(Resistance::Drives)
        }
        let name = p.rsplit('/').next().unwrap();
        match import(&t, &o) {
            Err(e) => println!("{name}: IMPORT {} {}", e.mistakes.len(), e.mistakes[0]),
            Ok(i) => {
                if mode.contains('p') {
                    println!("{}", i.declaration);
                    for n in &i.notes {
                        println!("{n}")
                    }
                }
                let start = std::time::Instant::now();
                if mode.contains('c') {
                    match eigentol_compiler::compile(
                        i.declaration.parse().unwrap(),
                        eigentol_compiler::mechanics::Limits {
                            explicit_partials: 0,
                            motion_linear: 0,
                        },
                    ) {
                        Ok(c) => println!(
                            "{name}: ok {} unknowns, undetermined {:?} {:.1?}",
                            c.functions.unknowns.len(),
                            c.functions.undetermined.len(),
                            start.elapsed()
                        ),
                        Err(m) => println!("{name}: COMPILE {m}"),
                    }
                } else {
                    println!("{name}: imported")
                }
            }
        }
    }
}
