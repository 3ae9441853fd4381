//! The compiled part of the Python package `motile`.

mod error;
mod scene;
mod setup;
mod steady;
mod tension;
mod value;
mod work;

/// Compiled part of motile.
#[pyo3::pymodule]
mod _motile {
    #[pymodule_export]
    use super::scene::Scene;
    #[pymodule_export]
    use super::setup::Setup;
    #[pymodule_export]
    use super::steady::{SteadyState, branch, steady};
}
