//! What mistuning says.

use eigentol_results::columns::Columns;
use eigentol_results::numbers::{frequency_in, number, rough};
use eigentol_results::relevance::largest;
use eigentol_results::{Answer, Findings, at_point, displayed};

use super::{BladePeak, Mistuning};

displayed!(Mistuning);

/// `mistuning`: the factors; `blades`: how often each is the worst; `derivatives` of the factor; `samples`.
impl Answer for Mistuning {
    const KIND: &'static str = "mistuning";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled(format_args!("engine order {} on `{}`", self.order, self.ring));
        let name = |blade: usize| format!("{}[{blade}]", self.ring);
        let factors = [("as they are", Some(self.factor))].into_iter().chain(
            [("median", 0.5), ("90 %", 0.9), ("99 %", 0.99), ("highest", 1.0)]
                .map(|(name, share)| (name, self.quantile(share))),
        );
        let factors: Vec<_> = factors.filter(|(_, factor)| factor.is_some()).collect();
        let mut table = Columns::new("mistuning", &factors);
        table.words("blades", &|row| Some(row.0.to_owned())).shown();
        table.number("amplification factor", "", &|row| row.1).digits(rough);
        said.columns(table);
        let Self { tuned, built, .. } = self;
        let peak = |peak: &BladePeak| {
            format!("{} at {}", rough(peak.amplitude), frequency_in(peak.frequency, &d.frequency, number))
        };
        let worst = match built.others {
            0 => format!("the worst is `{}`: {}", name(built.blade), peak(built)),
            _ => format!("several are equal: {}", peak(built)),
        };
        said.note(format!(
            "Highest amplitude, per unit of the force on each blade, of equal blades: {}. As they are, {worst}.",
            peak(tuned)
        ));
        said.note(format!("Whitehead's greatest factor of {} blades: {}.", self.blades, number(self.whitehead())));
        if !self.sampled.is_empty() {
            self.of_samples(&mut said, &name);
        }
        let Some(by_design) = &self.by_design else { return said };
        let most = largest(by_design.iter().copied());
        let moving: Vec<usize> = (0..d.design.len()).filter(|k| by_design[*k].abs() > 1e-9 * most).collect();
        let mut table = Columns::new("derivatives", &moving);
        table.words("derivative of the factor by", &|k| Some(d.design[*k].name.to_string())).shown();
        table.number("per unit", "", &|k| Some(by_design[*k] * d.design[*k].unit.scale)).digits(rough);
        said.columns(table);
        said
    }
}

impl Mistuning {
    fn of_samples(&self, said: &mut Findings, name: &dyn Fn(usize) -> String) {
        let (verified, difference) = self.verified;
        said.note(format!(
            "{} samples within the tolerances; of {verified} solved as a whole, the factor differs by {} at most.",
            self.sampled.len(),
            rough(difference)
        ));
        let blades: Vec<usize> = (0..self.blades).collect();
        let mut table = Columns::new("blades", &blades);
        table.words("blade", &|blade| Some(name(*blade))).shown();
        let share = |blade: &usize| Some(self.worst[*blade] as f64 / self.sampled.len() as f64);
        table.number("worst in", "", &share).digits(rough);
        said.columns(table);
        let samples: Vec<f64> = self.sampled.iter().copied().collect();
        let mut table = Columns::new("samples", &samples);
        table.number("amplification factor", "", &|factor| Some(*factor));
        said.columns(table);
    }
}
