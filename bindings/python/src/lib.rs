//! The compiled part of the Python package `motile`.

mod error;
mod outline;
mod scene;
mod setup;
mod steady;
mod tension;
mod value;
mod work;

/// Compiled part of motile.
#[pyo3::pymodule]
mod _motile {
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::outline::read_outline;
    #[pymodule_export]
    use super::scene::Scene;
    #[pymodule_export]
    use super::setup::Setup;
    #[pymodule_export]
    use super::steady::{SteadyState, branch, steady};

    /// Adds the version of the program and of its numbers.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("VERSION", motile::VERSION)
    }
}
