//! Physics across the crates: each claim of the documentation against something exact or computed independently.

mod allocation;
mod bending;
mod channel;
mod contact;
mod contrast;
mod curved_walls;
mod elastic_walls;
mod errors;
mod exchange;
mod fixed_shapes;
mod gel;
mod headings;
mod imposed_flows;
mod interfaces;
mod linear_theory;
mod mirror;
mod near_walls;
mod nested;
mod net_forces;
mod nucleus;
mod open_interfaces;
mod particles_inside;
mod recommended;
mod relaxation;
mod solids;
mod stresslets;
mod swimmers;
#[cfg(feature = "rayon")]
mod threads;
mod time_steps;
mod units;
mod viscoelastic;
mod warnings;
mod without_grid;
mod work;
