//! Plans of Fourier transforms.

/// Declares a plan for transforms of one length and their inverses, from a planner, the traits of what it plans, and
/// the name of the method that returns the length of the scratch.
macro_rules! transform {
    ($(#[$doc:meta])* $name:ident, $planner:ident, [$forward:ident, $inverse:ident], $scratch:ident) => {
        $(#[$doc])*
        #[derive(Clone)]
        pub struct $name {
            forward: std::sync::Arc<dyn $forward<f64>>,
            inverse: std::sync::Arc<dyn $inverse<f64>>,
            scratch: Vec<num_complex::Complex64>,
        }

        impl std::fmt::Debug for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.debug_struct(stringify!($name)).field("len", &self.len()).finish_non_exhaustive()
            }
        }

        impl $name {
            /// Creates a plan for `len` numbers.
            ///
            /// # Errors
            /// Returns an error for more than 67,108,864.
            pub fn new(len: usize) -> Result<Self, crate::InputError> {
                crate::check_length(len)?;
                let mut planner = $planner::new();
                let (forward, inverse) = (planner.plan_fft_forward(len), planner.plan_fft_inverse(len));
                let scratch = forward.$scratch().max(inverse.$scratch());
                Ok(Self { forward, inverse, scratch: vec![num_complex::Complex64::ZERO; scratch] })
            }

            /// Returns N, how many numbers it transforms.
            #[must_use]
            pub fn len(&self) -> usize {
                self.forward.len()
            }

            /// Returns true of a plan for no numbers, which does nothing.
            #[must_use]
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }
        }
    };
}

pub(crate) use transform;
