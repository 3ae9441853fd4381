//! The solvers of this crate against the discrete equations, direct solutions, exact solutions and each other.

#[cfg(test)]
mod allocation;
#[cfg(test)]
mod channel;
#[cfg(test)]
mod common;
#[cfg(test)]
mod convergence;
#[cfg(test)]
mod dense;
#[cfg(test)]
mod friction;
#[cfg(test)]
mod kinematics;
#[cfg(test)]
mod periodic;
#[cfg(test)]
mod projection;
#[cfg(test)]
mod properties;
#[cfg(test)]
mod slip;
#[cfg(test)]
mod two_phase;
