//! For every machine of the corpus, samples solved in vectors match those solved one by one.

use eigentol::{Coordinate, Input, Mechanism, Study};
use eigentol_tests::corpus::{self, Visitor};
use eigentol_tests::rederived::operating_points;
use eigentol_tests::sampled::{Compared, compare};

struct Machines(Vec<(&'static str, [Compared; 2])>);

impl Visitor for Machines {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, _: &'static str, machine: M) {
        for operation in operating_points(name) {
            let mut study = Study::new(machine).policy(operation.policy).samples(400);
            for (k, &value) in operation.inputs.iter().enumerate() {
                study = study.input(Input::new(k), value);
            }
            for (k, &value) in operation.start.iter().enumerate() {
                study = study.guess(Coordinate::new(k), value);
            }
            self.0.push((name, compare(&study, name)));
        }
    }
}

#[test]
fn samples_in_vectors_are_those_alone() {
    let mut machines = Machines(Vec::new());
    corpus::visit(&mut machines);
    println!("{:#?}", machines.0);
    let [own, wide] = Compared::sum(machines.0.iter().map(|(_, own)| *own));
    assert!(
        own.samples > 8000 && 10 * own.in_vectors > 8 * own.samples,
        "{own:?}"
    );
    assert!(
        wide.samples > 2000 && 10 * wide.in_vectors > 6 * wide.samples,
        "{wide:?}"
    );
}
