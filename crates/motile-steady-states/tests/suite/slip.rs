//! Steady swimmers between walls along which fluid slips, against runs.

use motile::base::Region;
use motile::prelude::*;
use motile_steady_states::{BranchEnd, Continuation, Parameter, SteadyState};

fn swimmer(slip: [f64; 2], nodes: usize) -> Setup {
    Setup {
        region: Region::SlipChannel { length: 8.0, width: 3.2, drive: Drive::ZeroFlux, slip },
        method: Method::Integral(IntegralMethod { nodes, elements: 4 * nodes }),
        droplets: vec![DropletSetup::active(-2.0)],
        ..Setup::default()
    }
}

#[test]
fn swimmers_between_slipping_walls_are_those_of_runs() {
    let speeds = [0.0, 0.5].map(|slip| {
        let state = SteadyState::find(&swimmer([slip; 2], 48)).expect("a swimmer");
        assert_eq!(Parameter::Width.get(state.setup()), Some(3.2));
        state.velocity().x.abs()
    });
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 384 });
    let run = Setup { method, ..swimmer([0.5; 2], 48) };
    let Built { mut scene, droplets, .. } = run.build().expect("a good scene");
    scene.run(30.0).go().expect("a run");
    let run = scene.observe(droplets[0]).expect("a good state").speed();
    println!("{speeds:?} {run}");
    assert!((run / speeds[1] - 1.0).abs() < 2e-3, "{run} {speeds:?}");
    // Slip matters far more than that.
    assert!((speeds[0] / speeds[1] - 1.0).abs() > 2e-2, "{speeds:?}");
    // A vanishing slip is no slip.
    let little = SteadyState::find(&swimmer([1e-7; 2], 48)).expect("a swimmer").velocity().x.abs();
    assert!((little / speeds[0] - 1.0).abs() < 1e-6, "{little} {speeds:?}");
}

/// Walls of different slip have no state that is its own mirror image: a swimmer on the centre line drifts.
#[test]
fn unequal_slip_breaks_the_mirror_symmetry() {
    let even = SteadyState::find(&swimmer([0.5; 2], 48)).expect("a swimmer");
    assert!(even.is_mirror_symmetric());
    let refused = SteadyState::near(&swimmer([0.5, 0.1], 48), even.profile(), even.velocity(), true);
    assert!(refused.is_err());
}

/// Branches start where a parameter is zero and may not be negative: slip, friction, cortex.
#[test]
fn branches_start_at_zero() {
    let start = SteadyState::find(&swimmer([0.0; 2], 48)).expect("a swimmer");
    for (parameter, end) in [(Parameter::Slip, 0.3), (Parameter::Friction, 5.0), (Parameter::Cortex, 50.0)] {
        let branch = Continuation::new(parameter, 0.0, end).follow(&start, |_, _| true).expect("a branch");
        let last = branch.points.last().expect("a point");
        assert!(matches!(branch.end, BranchEnd::Range) && (last.value - end).abs() < 1e-12 * end, "{}", branch.end);
        let direct = SteadyState::find(&parameter.with(&swimmer([0.0; 2], 48), end).expect("a number")).expect("one");
        // States over different nodes.
        let [along, found] = [&last.state, &direct].map(|state| state.measured().expect("as described").speed);
        assert!((along / found - 1.0).abs() < 2e-4, "{parameter:?}: {along} {found}");
    }
}

/// A parameter that breaks the mirror symmetry of a state leads to states without it.
#[test]
fn slip_at_one_wall_moves_the_swimmer_off_the_middle() {
    let start = SteadyState::find(&swimmer([0.0; 2], 48)).expect("a swimmer");
    assert!(start.is_mirror_symmetric());
    let branch = Continuation::new(Parameter::LowerSlip, 0.0, 0.1).follow(&start, |_, _| true).expect("a branch");
    let last = &branch.points.last().expect("a point").state;
    let direct = SteadyState::find(&swimmer([0.1, 0.0], 48)).expect("a swimmer");
    let at = start.at(Parameter::LowerSlip, 0.1).expect("a state");
    let speeds = [last, &at, &direct].map(|state| {
        assert!(!state.is_mirror_symmetric());
        let sum: f64 = state.profile().positions.iter().map(|place| place.y).sum();
        assert!((sum / 48.0).abs() > 1e-3, "{sum}");
        state.measured().expect("as described").speed
    });
    println!("{speeds:?}");
    // States over different nodes.
    assert!(speeds.iter().all(|speed| (speed / speeds[2] - 1.0).abs() < 2e-4), "{speeds:?}");
}
