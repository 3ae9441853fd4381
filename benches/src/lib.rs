//! Times in units of plain transforms.
//!
//! Times on a machine that does other things too mean little; ratios of times measured by turns mean much. [`Turns`]
//! runs works by turns and takes medians of the ratios within a turn; [`PlainPair`] is the unit, real transforms as
//! anyone would write them. [`WORKS`] are kernels and steps whose instructions the studies count.

mod counted;
mod plain_pair;
mod turns;

pub use counted::{WORKS, Work, counted};
pub use plain_pair::PlainPair;
pub use turns::{Turns, median, print_ratios};
