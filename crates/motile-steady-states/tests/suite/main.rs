//! Steady states, their growth rates and branches against exact values and runs.

mod branches;
mod collapse;
mod cortex;
mod cortex_runs;
mod cycles;
mod every_number;
mod exchange;
mod imposed_flows;
mod linear_theory;
mod nucleus;
mod reference;
mod revolution;
mod sensitivities;
mod slip;
mod special_points;
mod units;
mod verdicts;
