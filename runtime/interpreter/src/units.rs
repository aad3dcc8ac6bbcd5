//! Units in which answers are stated.

use std::sync::Arc;

use eigentol::{List, Shared, Unit};

use crate::given::value;
use crate::mechanism::Interpreted;
use crate::mistakes::{Mistakes, UnitError};

impl Interpreted {
    /// The same mechanism, whose answers state an input, a design variable, a coordinate or an output in this unit.
    ///
    /// ```
    /// use eigentol::Study;
    /// use eigentol_interpreter::Interpreted;
    ///
    /// let text = "mechanism Spring { body mass: point(mass: 2 kg); joint x: prismatic(-z) from ground to mass;
    ///     gravity 10 m/s^2 along -z; force s: spring(on: x, stiffness: 1 N/mm); output sag = x; }";
    /// let study = Study::new(Interpreted::from_text(text)?.in_unit("sag", "mm")?);
    /// assert!(study.outputs()?.to_string().contains("sag [mm]"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`UnitError`]: there is no such name, or this is no unit of what it names.
    pub fn in_unit(mut self, name: &str, unit: &str) -> Result<Self, UnitError> {
        let mut d = (*self.description).clone();
        let mut stated = None;
        let mut state = |own: &str, old: &mut Unit| {
            if own == name {
                stated = Some(restate(old, unit, &format!("`{name}`")));
            }
        };
        each(&mut d.inputs, |info| state(&info.name, &mut info.unit));
        each(&mut d.design, |info| state(&info.name, &mut info.unit));
        each(&mut d.coordinates, |info| state(&info.name, &mut info.unit));
        each(&mut d.outputs, |info| state(&info.name, &mut info.unit));
        stated.ok_or_else(|| UnitError::Unknown { name: name.to_owned() })??;
        self.description = Shared::Counted(Arc::new(d));
        Ok(self)
    }

    /// The same mechanism, whose texts and figures state frequencies in this unit: `Hz`, `rpm`.
    ///
    /// # Errors
    /// The mistakes in the text.
    pub fn frequencies_in(mut self, unit: &str) -> Result<Self, Mistakes> {
        let mut d = (*self.description).clone();
        restate(&mut d.frequency, unit, "a frequency")?;
        self.description = Shared::Counted(Arc::new(d));
        Ok(self)
    }
}

/// Changes the items of a list.
fn each<T: Clone>(list: &mut List<T>, change: impl FnMut(&mut T)) {
    let mut items = list.to_vec();
    items.iter_mut().for_each(change);
    *list = items.into();
}

/// Replaces a unit by another one of the same dimension.
fn restate(old: &mut Unit, unit: &str, what: &str) -> Result<(), Mistakes> {
    let scale = value(&format!("1 {unit}"), old, what)?;
    *old = Unit { symbol: unit.trim().to_owned().into(), scale };
    Ok(())
}
