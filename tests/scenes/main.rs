//! Scenes as a user meets them: hard cases, checkpoints, odd parameters, programs that are killed.

mod checkpoints;
mod killed;
mod parameters;
mod suite;
