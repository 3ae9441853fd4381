use motile_scene::checkpoint::Checkpoint;
use motile_scene::integrator::RungeKuttaChebyshev;
use motile_scene::{Handle, Scene, SceneError};

use super::*;
use crate::{ContractileTension, EdgeFollowing, Repulsion, SpaceDroplet};

/// Two swimmers in a radius of this length (units: the length and the force), with other viscosities inside.
fn pair(length: f64, force: f64) -> (Scene<SpaceFluid>, Handle<SpaceBody>) {
    let eta = 100.0 * force / length;
    let droplet = |position: [f64; 3], rear: [f64; 3], ratio: f64| {
        let (mean, activity) = (100.0 / length.powi(2), -force * length.powi(2));
        let law = ContractileTension::thesis(10.0 * force, activity, -2.0 * activity, mean).unwrap();
        let sphere = SpaceDroplet::sphere(6, length, [ratio * eta, eta], law).unwrap();
        let particles = move |s: [f64; 3]| mean * (1.0 - s[0] * rear[0] - s[1] * rear[1] - s[2] * rear[2]);
        let sphere = sphere.with_particles(0.1 * length.powi(2), particles).unwrap();
        let sphere = sphere.with_edge_following(EdgeFollowing { strength: 4.0, time: 1.0 }).unwrap();
        sphere.with_position(position.map(|x| x * length)).unwrap()
    };
    let all = [droplet([-1.3, 0.2, 0.1], [0.8, 0.6, 0.0], 2.0), droplet([1.3, 0.0, -0.2], [-0.8, 0.0, 0.6], 0.5)];
    let all = SpaceDroplets::new(all.into()).unwrap();
    let all = all.with_repulsion(Repulsion::new(200.0 * force / length.powi(2), 0.3 * length).unwrap());
    let mut scene = Scene::new(SpaceFluid::new(eta).unwrap()).advanced_by(RungeKuttaChebyshev::new());
    let handle = scene.add(SpaceBody::new(all, &["one", "other"]).unwrap());
    (scene, handle)
}

#[test]
fn a_run_continues_from_a_checkpoint_bit_for_bit() {
    let (mut whole, handle) = pair(1.0, 1.0);
    whole.run(1.0).go().unwrap();
    let (mut first, _) = pair(1.0, 1.0);
    let stopped = first.run(1.0).most_steps(3).go();
    assert!(matches!(stopped, Err(SceneError::TooManySteps { .. })), "{stopped:?}");
    let bytes = first.checkpoint("a pair").to_bytes().unwrap();
    let (mut second, there) = pair(1.0, 1.0);
    second.resume(&Checkpoint::from_bytes(&bytes).unwrap()).unwrap();
    second.run(1.0).go().unwrap();
    assert!(whole.steps() > 4 && whole.steps() == second.steps());
    assert_eq!(whole.body(handle).unwrap().save(), second.body(there).unwrap().save());
    // Another degree or viscosity is refused.
    let law = ContractileTension::thesis(10.0, -1.0, 2.0, 100.0).unwrap();
    let alone = SpaceDroplet::sphere(6, 1.0, [200.0, 100.0], law).unwrap();
    let mut other = Scene::new(SpaceFluid::new(100.0).unwrap()).advanced_by(RungeKuttaChebyshev::new());
    other.add(SpaceBody::new(SpaceDroplets::new(vec![alone]).unwrap(), &["one"]).unwrap());
    assert!(other.resume(&Checkpoint::from_bytes(&bytes).unwrap()).is_err());
}

/// In metres, a scene has as many steps, and the same shape and speed to round-off.
#[test]
fn units_do_not_matter() {
    let end = |length: f64, force: f64| {
        let (mut scene, handle) = pair(length, force);
        scene.run(0.3).go().unwrap();
        let seen = scene.observe(handle).unwrap().remove(0);
        (
            scene.steps(),
            seen.speed / length,
            seen.semi_axes[0] / length,
            scene.body(handle).unwrap().warnings(&scene.system().hydrodynamics().fluid_view()).len(),
        )
    };
    let (here, there) = (end(1.0, 1.0), end(1e-6, 1e-7));
    assert_eq!((here.0, here.3), (there.0, there.3));
    assert!((here.1 / there.1 - 1.0).abs() < 1e-8 && (here.2 / there.2 - 1.0).abs() < 1e-9, "{here:?} {there:?}");
}

#[test]
fn planes_and_states_of_other_bodies_are_refused() {
    let (mut scene, handle) = pair(1.0, 1.0);
    let mut out = [FlowSample::default()];
    let refused = scene.system_mut().sample(&[Vec2::ZERO], &mut out).unwrap_err().explanation();
    assert!(refused.contains("Use SpaceDroplets::velocities_at"), "{refused}");
    let view = scene.system().hydrodynamics().fluid_view();
    let body = scene.body_mut(handle).unwrap();
    let mut state = vec![0.0; body.state_len()];
    body.write_state(&mut state);
    state[7] = f64::NAN;
    assert!(body.read_state(&state).unwrap_err().to_string().contains("coefficient number 7"));
    assert!(body.load(&view, &SavedState { reals: vec![0.0; 3], counts: vec![0, u64::MAX] }).is_err());
    assert!(body.load(&view, &SavedState::default()).is_err());
}
