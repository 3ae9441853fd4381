//! Swimmers against boundary-integral values.
