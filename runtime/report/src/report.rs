//! The settings of a report.

use std::fs;
use std::path::Path;

use eigentol::kernels::{PictureKernels, SummaryKernels};
use eigentol::{Input, Output, Study, Value};
use eigentol_figures::Style;

use crate::content::Content;
use crate::part::{Part, Section};
use crate::pictures::{POSES, Pictures};
use crate::scene::View;
use crate::{Error, page, sections};

/// A report of a study: the analyses it runs and its heading.
///
/// ```
/// use eigentol::{Study, mechanism};
/// use eigentol_report::Report;
///
/// mechanism! {
///     mechanism Pendulum {
///         input  omega: rad/s;
///         design l = 1.0 m +/- 3%;
///         gravity 9.81 m/s^2 along -z;
///         body shaft: massless;
///         body bar: rod(mass: 3 kg, length: l, along: -z);
///         joint spin:  revolute(z) from ground to shaft, driven at omega;
///         joint theta: revolute(y) from shaft to bar;
///     }
/// }
///
/// let study = Study::new(Pendulum).input(Pendulum::omega, 5.0).start(Pendulum::theta, 1.0);
/// let report = Report::new(&study)
///     .title("The bar on its shaft")
///     .samples(500)
///     .sweep(Pendulum::omega, &[4.0, 4.5, 5.0, 5.5, 6.0]);
/// assert!(report.html()?.starts_with("<!doctype html>"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Report<M> {
    pub(crate) study: Study<M>,
    pub(crate) title: Option<String>,
    pub(crate) declaration: Option<String>,
    pub(crate) along: Option<(Input<M>, Vec<Value>)>,
    pub(crate) orders: Vec<f64>,
    pub(crate) orbits: Vec<[Output; 2]>,
    pub(crate) style: Style,
}

/// The equilibrium, modes and forced vibrations of a study in motion: an HTML file, which loads nothing, with the view in 3-D
/// of a report.
///
/// # Errors
/// [`Error::Study`] if there is no equilibrium or there are no modes.
pub fn motion<M: PictureKernels>(study: &Study<M>, style: &Style) -> Result<String, Error> {
    let (pictures, modes) = (Pictures::of(study, POSES)?, study.modes()?);
    let title = style.titled(study.description().name.to_string());
    page::motion(&title, &View::new(&pictures, study.description(), Some(&modes), style))
}

impl<M: SummaryKernels + PictureKernels + Clone> Report<M> {
    /// A report of a study as set up: its operating point, tolerances, samples and seed.
    #[must_use]
    pub fn new(study: &Study<M>) -> Self {
        Self {
            study: study.clone(),
            title: None,
            declaration: None,
            along: None,
            orders: Vec::new(),
            orbits: Vec::new(),
            style: Style::default(),
        }
    }

    /// Sets the title (the name of the mechanism unless set).
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = Some(title.into());
        self
    }

    /// Includes the declaration of the mechanism.
    #[must_use]
    pub fn declaration(mut self, text: impl Into<String>) -> Self {
        self.declaration = Some(text.into());
        self
    }

    /// Follows equilibria, modes and their spread along an input at these values, ascending or descending.
    ///
    /// Branches are followed from the lowest to the highest value.
    #[must_use]
    pub fn sweep(mut self, input: Input<M>, values: &[impl Into<Value> + Copy]) -> Self {
        let values = values.iter().map(|&value| value.into()).collect();
        self.along = Some((input, values));
        self
    }

    /// Marks where a frequency is one of these multiples of the swept input: engine orders.
    #[must_use]
    pub fn orders(mut self, orders: &[f64]) -> Self {
        self.orders = orders.to_vec();
        self
    }

    /// Draws the orbit of two outputs, perpendicular displacements of one place, under each harmonic; may be called
    /// several times.
    #[must_use]
    pub fn orbit(mut self, x: Output<M>, y: Output<M>) -> Self {
        self.orbits.push([x.any(), y.any()]);
        self
    }

    /// Sets mode names and the unit of frequencies for figures and sentences. Tables keep numbers and rad/s.
    #[must_use]
    pub fn style(mut self, style: Style) -> Self {
        self.style = style;
        self
    }

    /// Sets the number of Monte Carlo samples.
    #[must_use]
    pub fn samples(mut self, samples: usize) -> Self {
        self.study = self.study.samples(samples);
        self
    }

    /// Sets the seed of the samples.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.study = self.study.seed(seed);
        self
    }

    /// Returns the report as a self-contained HTML file, which loads nothing.
    ///
    /// # Errors
    /// [`Error::Study`] if the study is set up wrongly. A refusal of an analysis is not an error: the report states it
    /// in its place.
    pub fn html(&self) -> Result<String, Error> {
        page::html(&Content::of(self, Part::All)?)
    }

    /// Some of the sections of the report, for a page that asks for them as its values change ([`frame`](crate::frame)). The
    /// spread at the operating point is judged without samples, and branches are among all sections only.
    ///
    /// # Errors
    /// The errors of [`Report::html`].
    pub fn sections(&self, part: Part) -> Result<Vec<Section>, Error> {
        sections::each(&Content::of(self, part)?, part)
    }

    /// Writes the report to a file.
    ///
    /// # Errors
    /// The errors of [`Report::html`]; [`Error::Write`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        fs::write(path, self.html()?).map_err(|source| Error::Write { path: path.to_owned(), source })
    }
}
