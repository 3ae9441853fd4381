//! Files for ParaView.

mod base64;
pub(crate) mod file;
pub(crate) mod observer;
