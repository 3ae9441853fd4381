//! Scenes as a user meets them: hard cases, checkpoints, copies, odd parameters, programs that are killed.

mod checkpoints;
mod copies;
mod hard_cases;
mod killed;
mod parameters;
mod suite;
mod taken_over;
