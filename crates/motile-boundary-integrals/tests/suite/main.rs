//! Boundary integrals for scenes against exact values, against each other and against what must be conserved.

mod channel;
mod convergence;
mod fixed_shapes;
mod interaction;
mod layers;
mod layers_in_boxes;
mod linear_theory;
mod nested;
mod reference;
mod refusals;
mod relaxation;
mod sampling;
mod scenes;
mod slip;
mod steady_state;
mod symmetries;
