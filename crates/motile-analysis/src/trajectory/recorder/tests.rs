use super::*;
use crate::trajectory::Regime;
use active_interface::{ContractileTension, Curve, InitialConcentration};
use approx::assert_relative_eq;
use motile_base::{FlowSample, SolveReport, Vec2};
use motile_scene::{Domain, Every, FlowError, FlowWork, FluidView, Markers, Scene, SceneError, StepSize};

/// A wind between walls at y = -1 and y = 3 whose vertical part drives points back to y = 1 or away from it.
#[derive(Debug)]
struct Wind {
    along: f64,
    rate: f64,
    walls: bool,
}

impl Wind {
    fn at(&self, point: Vec2) -> Vec2 {
        Vec2::new(self.along, self.rate * (point.y - 1.0))
    }
}

impl Hydrodynamics for Wind {
    fn fluid_view(&self) -> FluidView {
        let domain = Domain {
            origin: [0.0, -1.0],
            periods: [Some(10.0), None].into(),
            walls: self.walls.then_some([-1.0, 3.0]),
        };
        FluidView {
            domain,
            viscosity: 1.0,
            spacing: None,
            second_order: true,
            interface_stiffness: 1.0,
            shape_modes: None,
            nodes: None,
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        // Only the droplet as a whole is moved, so that it stays round.
        let centre = markers.positions().iter().sum::<Vec2>() / markers.len() as f64;
        markers.velocities_mut().fill(self.at(centre));
        Ok(SolveReport { mean_pressure_gradient: [-0.5, 0.0], ..SolveReport::default() })
    }

    fn sample(&mut self, _: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        for (out, point) in out.iter_mut().zip(points) {
            out.velocity = self.at(*point);
        }
        Ok(())
    }

    fn work(&self) -> FlowWork {
        FlowWork::default()
    }
}

fn scene(along: f64, rate: f64, walls: bool) -> (Scene<Wind>, Handle<ActiveDroplet>) {
    let mut scene = Scene::new(Wind { along, rate, walls });
    let markers = Curve::circle(0.5).unwrap().translated(Vec2::new(0.0, 1.8)).markers(64).unwrap();
    let droplet = scene.add(ActiveDroplet::passive(&markers, 0.1).unwrap());
    (scene, droplet)
}

#[test]
fn records_columns_and_gap() {
    let (mut scene, droplet) = scene(0.25, -0.1, true);
    let mut recorder = TrajectoryRecorder::new(droplet).with_gap_flow();
    assert!(recorder.records().is_empty() && recorder.minimum_gap().is_none() && recorder.column("time").is_none());
    let step = StepSize::Fixed(0.05);
    scene.run(5.0).step_size(step).observe(Every::StepAfter(0.5), &mut recorder).go().unwrap();
    // Continued: the end of the first run is the start of the second one.
    scene.run(10.0).step_size(step).observe(Every::StepAfter(0.5), &mut recorder).go().unwrap();
    assert_eq!(recorder.records().len(), 21);

    let column = |name: &str| -> Vec<f64> {
        recorder.column(name).unwrap().into_iter().map(|value| value.unwrap_or(f64::NAN)).collect()
    };
    for (k, ((time, x), (y, gap))) in
        column("time").iter().zip(column("x")).zip(column("y").iter().zip(column("gap"))).enumerate()
    {
        let decay = 0.8 * (-0.1 * time).exp();
        assert_relative_eq!(*time, 0.5 * k as f64, epsilon = 1e-12);
        assert_relative_eq!(x, 0.25 * time, epsilon = 1e-12, max_relative = 1e-5);
        assert_relative_eq!(*y, 1.0 + decay, max_relative = 1e-5);
        // To the top wall at 3, the polygon being as high as the circle, which has a marker at the top.
        assert_relative_eq!(gap, 1.5 - decay, max_relative = 1e-3);
    }
    assert_eq!(recorder.minimum_gap(), recorder.records()[0].gap);
    assert!(column("pressure_gradient").iter().all(|gradient| *gradient == -0.5));
    assert!(column("net_flux").iter().all(|flux| (flux - 1.0).abs() < 1e-12));
    assert!(column("retrograde_flow").iter().all(|flux| flux.abs() < 1e-12));
    assert!(recorder.column("nothing").is_none());
    // What does not exist is no number.
    assert!(recorder.column("concentration_max").unwrap().iter().all(Option::is_none));
}

#[test]
fn feeds_the_analysis() {
    let (mut scene, droplet) = scene(0.25, -0.1, true);
    let mut recorder = TrajectoryRecorder::new(droplet);
    scene.run(40.0).step_size(StepSize::Fixed(0.05)).observe(Every::StepAfter(0.5), &mut recorder).go().unwrap();
    let trajectory = recorder.trajectory().unwrap();
    // Heights are measured from the centre line, y = 1.
    assert_relative_eq!(trajectory.heights()[0], 0.8, max_relative = 1e-9);
    assert_relative_eq!(trajectory.lateral_velocities().unwrap()[0], -0.08, max_relative = 1e-9);
    let report = recorder.regime(&RegimeCriteria::default()).unwrap();
    assert_eq!(report.regime, Regime::Decaying);
    assert_relative_eq!(report.evidence.growth_rate.unwrap().value, -0.1, max_relative = 1e-3);
    assert!(recorder.records().iter().all(|record| record.flow.is_none()));
}

#[test]
fn without_walls() {
    let (mut scene, droplet) = scene(0.0, 0.0, false);
    let mut recorder = TrajectoryRecorder::new(droplet).with_convention(Convention::AsPrinted);
    scene.run(5.0).step_size(StepSize::Fixed(0.05)).observe(Every::Steps(10), &mut recorder).go().unwrap();
    assert!(recorder.minimum_gap().is_none());
    assert!(recorder.column("gap").unwrap().iter().all(Option::is_none));
    assert!(recorder.records().iter().all(|record| record.observables.convention == Convention::AsPrinted));
    // From its first height.
    assert!(recorder.trajectory().unwrap().heights().iter().all(|y| y.abs() < 1e-12));
    assert_eq!(recorder.regime(&RegimeCriteria::default()).unwrap().regime, Regime::AtRest);
    assert!(TrajectoryRecorder::new(droplet).regime(&RegimeCriteria::default()).is_err());
}

#[test]
fn what_cannot_be_recorded_ends_the_run() {
    let (mut first, droplet) = scene(0.0, 0.0, false);
    let (_, other) = scene(0.0, 0.0, false);
    let mut stranger = TrajectoryRecorder::new(other);
    let error = first.run(1.0).observe(Every::StepAfter(0.5), &mut stranger).go().unwrap_err();
    assert!(matches!(error, SceneError::Observer { .. }) && error.explanation().contains("another scene"), "{error}");

    let mut recorder = TrajectoryRecorder::new(droplet);
    let start = first.checkpoint("");
    first.run(1.0).observe(Every::StepAfter(0.5), &mut recorder).go().unwrap();
    first.resume(&start).unwrap();
    let error = first.run(1.0).observe(Every::StepAfter(0.5), &mut recorder).go().unwrap_err();
    assert!(error.explanation().contains("the times of the records"), "{error}");

    let mut greedy = TrajectoryRecorder::new(droplet).with_gap_flow();
    let error = first.run(1.0).observe(Every::StepAfter(0.5), &mut greedy).go().unwrap_err();
    assert!(error.explanation().contains("walls"), "{error}");
}

/// A recorder reports its own droplet: markers, particles and forces of the second are not paired with those of the
/// first.
#[test]
fn of_two_droplets_each_recorder_reports_its_own() {
    let active = || {
        let markers = Curve::ellipse(0.6, 0.4).unwrap().translated(Vec2::new(2.0, 0.5)).markers(80).unwrap();
        let numbers = InitialConcentration::polarised(3.0, 0.2).unwrap().particle_numbers(&markers).unwrap();
        let law = ContractileTension::thesis(0.1, -0.02, 0.1, 3.0).unwrap();
        ActiveDroplet::new(&markers, numbers, law, 0.1).unwrap()
    };
    let record = |scene: &mut Scene<Wind>, droplet| {
        let mut recorder = TrajectoryRecorder::new(droplet).with_gap_flow();
        scene.run(0.2).step_size(StepSize::Fixed(0.05)).observe(Every::StepAfter(0.1), &mut recorder).go().unwrap();
        recorder.records().to_vec()
    };
    let mut alone = Scene::new(Wind { along: 0.25, rate: 0.0, walls: true });
    let only = alone.add(active());
    let expected = record(&mut alone, only);
    assert!(expected[0].observables.moments.stresslet()[0][0].abs() > 1e-3);

    let (mut both, first) = scene(0.25, 0.0, true);
    let second = both.add(active());
    assert_eq!(record(&mut both, second), expected);
    assert_ne!(record(&mut both, first)[0].observables.area, expected[0].observables.area);
}
