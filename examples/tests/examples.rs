//! Every example as a test: it runs, and what it asserts holds.

#[path = "../active_gel.rs"]
mod active_gel;
#[path = "../active_walls.rs"]
mod active_walls;
#[path = "../beating_sheet.rs"]
mod beating_sheet;
#[path = "../bifurcation.rs"]
mod bifurcation;
#[path = "../birth_death.rs"]
mod birth_death;
#[path = "../constriction.rs"]
mod constriction;
#[path = "../custom_geometry.rs"]
mod custom_geometry;
#[path = "../drop_in_shear.rs"]
mod drop_in_shear;
#[path = "../elastic_channel.rs"]
mod elastic_channel;
#[path = "../exchange.rs"]
mod exchange;
#[path = "../mesh_in_code.rs"]
mod mesh_in_code;
#[path = "../nucleus.rs"]
mod nucleus;
#[path = "../obstacle_from_points.rs"]
mod obstacle_from_points;
#[path = "../own_body.rs"]
mod own_body;
#[path = "../own_solver.rs"]
mod own_solver;
#[path = "../own_tension.rs"]
mod own_tension;
#[path = "../rigid_channel.rs"]
mod rigid_channel;
#[path = "../steady_state.rs"]
mod steady_state;
#[path = "../suspension.rs"]
mod suspension;
#[path = "../swimming_droplet.rs"]
mod swimming_droplet;
#[path = "../tube.rs"]
mod tube;
#[path = "../two_droplets.rs"]
mod two_droplets;

/// Leaves for a directory of the tests, in which examples may write.
fn leave() {
    std::env::set_current_dir(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
}

#[test]
fn run_active_gel() {
    active_gel::main().expect("a run");
}

#[test]
fn run_active_walls() {
    active_walls::main().expect("a run");
}

#[test]
fn run_beating_sheet() {
    beating_sheet::main().expect("a run");
}

#[test]
fn run_bifurcation() {
    bifurcation::main().expect("a run");
}

#[test]
fn run_birth_death() {
    birth_death::main().expect("a run");
}

#[test]
fn run_constriction() {
    constriction::main().expect("a run");
}

#[test]
fn run_custom_geometry() {
    custom_geometry::main().expect("a run");
}

#[test]
fn run_drop_in_shear() {
    drop_in_shear::main().expect("a run");
}

#[test]
fn run_elastic_channel() {
    elastic_channel::main().expect("a run");
}

#[test]
fn run_exchange() {
    exchange::main().expect("a run");
}

#[test]
fn run_mesh_in_code() {
    mesh_in_code::main().expect("a run");
}

#[test]
fn run_nucleus() {
    nucleus::main().expect("a run");
}

#[test]
fn run_obstacle_from_points() {
    obstacle_from_points::main().expect("a run");
}

#[test]
fn run_own_body() {
    own_body::main().expect("a run");
}

#[test]
fn run_own_solver() {
    own_solver::main().expect("a run");
}

#[test]
fn run_own_tension() {
    own_tension::main().expect("a run");
}

#[test]
fn run_rigid_channel() {
    rigid_channel::main().expect("a run");
}

#[test]
fn run_steady_state() {
    steady_state::main().expect("a run");
}

#[test]
fn run_suspension() {
    leave();
    suspension::main().expect("a run");
}

#[test]
fn run_swimming_droplet() {
    leave();
    swimming_droplet::main().expect("a run");
}

#[test]
fn run_tube() {
    tube::main().expect("a run");
}

#[test]
fn run_two_droplets() {
    two_droplets::main().expect("a run");
}
