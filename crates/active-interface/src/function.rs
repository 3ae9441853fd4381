//! Functions that a user gives.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// A shared function of one number.
#[derive(Clone)]
pub(crate) struct Function<T>(Arc<dyn Fn(f64) -> T + Send + Sync>);

impl<T> Function<T> {
    pub(crate) fn new(function: impl Fn(f64) -> T + Send + Sync + 'static) -> Self {
        Self(Arc::new(function))
    }
}

impl<T> Deref for Function<T> {
    type Target = dyn Fn(f64) -> T + Send + Sync;

    fn deref(&self) -> &Self::Target {
        self.0.as_ref()
    }
}

impl<T> fmt::Debug for Function<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Function")
    }
}
