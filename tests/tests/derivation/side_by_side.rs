//! For every machine of the corpus, samples solved in vectors match those solved one by one.

use eigentol::{Coordinate, Input, Mechanism, Study};
use eigentol_tests::corpus::{self, Visitor};
use eigentol_tests::rederived::operating_points;
use eigentol_tests::sampled::{Compared, compare};

struct Machines {
    samples: usize,
    compared: Vec<(&'static str, [Compared; 2])>,
}

impl Visitor for Machines {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, _: &'static str, machine: M) {
        for operation in operating_points(name) {
            let mut study = Study::new(machine).policy(operation.policy).samples(self.samples);
            for (k, &value) in operation.inputs.iter().enumerate() {
                study = study.input(Input::new(k), value);
            }
            for (k, &value) in operation.start.iter().enumerate() {
                study = study.guess(Coordinate::new(k), value);
            }
            self.compared.push((name, compare(&study, name)));
        }
    }
}

#[test]
fn samples_in_vectors_are_those_alone() {
    compare_all(100);
}

#[test]
#[ignore = "ten seconds"]
fn many_samples_in_vectors_are_those_alone() {
    compare_all(400);
}

fn compare_all(samples: usize) {
    let mut machines = Machines { samples, compared: Vec::new() };
    corpus::visit(&mut machines);
    let compared = machines.compared;
    println!("{compared:#?}");
    let [own, wide] = Compared::sum(compared.iter().map(|(_, x)| *x));
    assert!(own.samples > 20 * samples && 10 * own.in_vectors > 8 * own.samples, "{own:?}");
    assert!(wide.samples > 5 * samples && 10 * wide.in_vectors > 6 * wide.samples, "{wide:?}");
}
