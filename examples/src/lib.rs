//! Scenes of motile to copy from: the examples of this package.
