//! One-pass summary statistics of samples, in memory that does not grow with their number.
//!
//! The result has the same bits for any split of the samples into ranges, any order of merging and any number of
//! threads. Samples have an index; [`CHUNK`] consecutive samples are summed as a unit in a fixed order, and the sums of
//! neighbouring chunks are combined in a binary tree over the chunk index. However they were added, each sum in the
//! tree therefore covers the same samples in the same order. Integer counts, such as the buckets of a [`Sketch`], need
//! no tree.
//!
//! ```
//! # fn main() -> Result<(), eigentol_statistics::Error> {
//! use eigentol_statistics::summary::{Chunk, Partial, Plan, chunks};
//!
//! let plan = Plan::new(1).sketch(0, 10.0, 1.0)?;
//! let of = |samples| {
//!     let mut partial = Partial::new(plan.clone());
//!     for piece in chunks(samples) {
//!         let mut chunk = Chunk::new(&plan, piece.clone())?;
//!         for sample in piece {
//!             chunk.set(sample, 0, Some(10.0 + (sample % 7) as f64))?;
//!         }
//!         partial.add(&chunk)?;
//!     }
//!     Ok::<_, eigentol_statistics::Error>(partial)
//! };
//! let mut later = of(300..700)?;
//! later.merge(of(0..300)?)?;
//! assert_eq!(later, of(0..700)?);
//! assert_eq!(later.ranges(), [0..700]);
//!
//! let statistics = later.statistics(0)?.expect("seven hundred values");
//! assert_eq!((statistics.count, statistics.mean), (700, 13.0));
//! let median = statistics.quantile(0.5)?;
//! assert!((median.value - 13.0).abs() <= median.error);
//! # Ok(())
//! # }
//! ```

mod binomial;
#[cfg(feature = "serde")]
mod bits;
mod checks;
mod chunk;
mod comoments;
mod covariance;
mod lanes;
mod mask;
mod mean;
mod moments;
mod partial;
mod plan;
mod ranges;
#[cfg(feature = "serde")]
mod serialized;
mod sketch;
mod sorted;
mod statistics;
mod tree;

pub use chunk::{Chunk, chunks};
pub use comoments::Comoments;
pub use covariance::Covariance;
pub use mask::CHUNK;
pub use moments::{LARGEST, Moments};
pub use partial::Partial;
pub use plan::Plan;
pub use sketch::{Estimate, Histogram, Sketch};
pub use sorted::{Interval, Sorted};
pub use statistics::Statistics;
