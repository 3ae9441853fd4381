use crate::error::refused;
use std::convert::Infallible;

use super::*;
use crate::hydrodynamics::tests::DragBox;
use crate::{
    MarkerBody,
    integrator::{Dynamics, Integrator, IntegratorKind, IntegratorWork},
};
use motile_base::{InputError, Vec2};

fn empty() -> Scene<DragBox> {
    Scene::new(DragBox::new(1.6, 1.0, 0.1))
}

/// A point that a force of -100 x draws to the origin, without a bound on its time step.
fn drawn() -> MarkerBody {
    let draw = |positions: &[Vec2], forces: &mut [Vec2]| forces[0] = -100.0 * positions[0];
    MarkerBody::new("drawn", vec![Vec2::new(0.3, 0.0)], draw).with_stiffness(0.0).unwrap()
}

/// The times at which an observer is called.
fn times(scene: &mut Scene<DragBox>, until: f64, step: StepSize, every: &[Every]) -> Vec<Vec<f64>> {
    let mut seen = vec![Vec::new(); every.len()];
    let mut watches: Vec<_> = seen
        .iter_mut()
        .map(|times| {
            move |system: &mut System<DragBox>| {
                times.push(system.time());
                Ok::<_, Infallible>(())
            }
        })
        .collect();
    let mut run = scene.run(until).step_size(step);
    for (&every, watch) in every.iter().zip(&mut watches) {
        run = run.observe(every, watch);
    }
    run.go().unwrap();
    drop(watches);
    seen
}

#[test]
fn runs_that_would_never_end_are_refused() {
    let mut scene = empty();
    scene.add(drawn().with_stiffness(1.5).unwrap());
    let error = scene.run(1.0).step_size(StepSize::Fixed(1e-300)).go().unwrap_err();
    assert!(matches!(error, SceneError::Input(InputError::OutOfRange { .. })), "{error}");
    scene.add(drawn().with_stiffness(1e12).unwrap());
    let error = scene.run(1.0).step_size(StepSize::OfLimit(0.5)).go().unwrap_err();
    assert!(refused(&error, "the time step at the start of the run would be "), "{error}");
    let dt = error.to_string().split("would be ").nth(1).and_then(|rest| rest.split(',').next()?.parse::<f64>().ok());
    assert!(dt.is_some_and(|dt| dt < 1e-10), "{error}");
    assert!(scene.run(1e-9).step_size(StepSize::OfLimit(0.5)).go().is_ok());
}

#[test]
fn reports_are_exact_or_after_a_step() {
    for step in [StepSize::Fixed(0.7), StepSize::OfLimit(0.5), StepSize::Adaptive { tolerance: 1e-3 }] {
        let mut scene = empty();
        scene.add(drawn().with_stiffness(1.5).unwrap());
        let every = [Every::Time(2.0), Every::StepAfter(2.0), Every::Time(0.9)];
        let seen = times(&mut scene, 6.5, step, &every);
        assert_eq!(seen[0], [0.0, 2.0, 4.0, 6.0, 6.5]);
        assert!(seen[1].len() >= 5 && seen[1][1] >= 2.0 && seen[1][2] >= 4.0, "{seen:?}");
        assert!(seen[2].iter().zip([0.0, 0.9, 1.8, 2.7, 3.6, 4.5, 5.4, 6.3, 6.5]).all(|(a, b)| (a - b).abs() < 1e-12));
        // The next run goes on with them.
        assert_eq!(times(&mut scene, 9.0, step, &[Every::Time(2.0)]), [[6.5, 8.0, 9.0]]);
    }
    let mut scene = empty();
    let seen = times(&mut scene, 2.1, StepSize::Fixed(0.7), &[Every::StepAfter(1.0)]);
    assert!(seen[0].iter().zip([0.0, 1.4, 2.1]).all(|(a, b)| (a - b).abs() < 1e-12), "{seen:?}");
}

/// Steps that end at a report say nothing about those that follow.
#[test]
fn exact_reports_leave_the_adaptive_steps_as_they_are() {
    let steps = |every: &[Every]| {
        let mut scene = empty();
        scene.add(drawn());
        times(&mut scene, 40.0, StepSize::Adaptive { tolerance: 1e-4 }, every);
        (scene.step_report().clone(), scene.steps())
    };
    let (free, count) = steps(&[]);
    let (reported, more) = steps(&[Every::Time(4.0)]);
    assert!(more <= count + 2 * 10, "{count} {more}");
    assert!(reported.shortest > 0.3 * free.shortest, "{free:?} {reported:?}");
}

/// A hundred steps of 0.01 up to reports, between steps of a hundred times that length.
#[test]
fn a_step_shortened_for_a_report_does_not_shorten_the_next_one() {
    let later = |reports: bool| {
        let mut scene = empty();
        let drift = |_: &[Vec2], _: &[Vec2], rates: &mut [Vec2]| rates.fill(Vec2::X);
        scene.add(MarkerBody::new("drifting", vec![Vec2::ZERO], |_, _| {}).with_motion(drift));
        let step = StepSize::Adaptive { tolerance: 1e-4 };
        times(&mut scene, 10.0, step, &[]);
        if reports {
            assert_eq!(times(&mut scene, 11.0, step, &[Every::Time(0.01)])[0].len(), 101);
        }
        let (steps, time) = (scene.steps(), scene.time());
        times(&mut scene, time + 100.0, step, &[]);
        scene.steps() - steps
    };
    assert_eq!(later(true), later(false));
}

#[test]
fn an_interval_far_below_the_step_is_refused() {
    for (interval, refused) in [(1e-9, true), (1e-300, true), (1e-3, false)] {
        let mut scene = empty();
        let mut look = |_: &mut System<DragBox>| Ok::<_, Infallible>(());
        let ended = scene.run(2.0).observe(Every::Time(interval), &mut look).go();
        match ended {
            Err(SceneError::Input(InputError::OutOfRange { value, .. })) => {
                assert!(refused && value == interval);
                assert_eq!(scene.steps(), 0);
            }
            other => assert!(!refused && other.is_ok(), "{other:?}"),
        }
        // After every step, since each is longer.
        let mut scene = empty();
        let seen = times(&mut scene, 2.0, StepSize::Fixed(0.5), &[Every::StepAfter(interval)]);
        assert_eq!(seen[0], [0.0, 0.5, 1.0, 1.5, 2.0]);
    }
}

#[test]
fn a_run_needs_a_bound_on_its_steps() {
    let mut scene = empty();
    let point = scene.add(drawn());
    let mut calls = 0;
    let mut look = |_: &mut System<DragBox>| {
        calls += 1;
        Ok::<_, Infallible>(())
    };
    let part = StepSize::OfLimit(0.5);
    let error = scene.run(50.0).step_size(part).observe(Every::Steps(1), &mut look).go().unwrap_err();
    assert!(refused(&error, "no body states a limit of the time step"), "{error}");
    assert!(error.to_string().contains("`StepSize::Fixed`"), "{error}");
    assert_eq!((calls, scene.steps(), scene.time()), (0, 0, 0.0));
    // The method that bounds its errors has no better idea of what is stable.
    let mut scene = scene.advanced_by(IntegratorKind::RungeKuttaChebyshev);
    let error = scene.run(50.0).step_size(part).go().unwrap_err();
    assert!(refused(&error, "no body states a limit of the time step"), "{error}");
    let mut scene = scene.advanced_by(IntegratorKind::Midpoint);
    for step in [StepSize::Fixed(0.01), StepSize::Adaptive { tolerance: 1e-4 }] {
        scene.body_mut(point).unwrap().markers_mut()[0].x = 0.3;
        scene.run(scene.time() + 1.0).step_size(step).go().unwrap();
        assert!(scene.body(point).unwrap().markers()[0].length() < 1e-2, "{step:?}");
    }
    // A bound that a body states.
    let mut scene = empty();
    let point = scene.add(drawn().with_stiffness(100.0).unwrap());
    scene.run(1.0).go().unwrap();
    assert!(scene.body(point).unwrap().markers()[0].length() < 1e-3);
}

#[test]
fn a_scene_without_bodies_or_markers_takes_one_step() {
    for bodies in 0..3 {
        let mut scene = empty();
        for _ in 0..bodies {
            scene.add(MarkerBody::new("none", Vec::new(), |_, _| {}));
        }
        let seen = times(&mut scene, 2.0, StepSize::default(), &[Every::Steps(1), Every::Time(1.5)]);
        assert_eq!((seen, scene.steps()), (vec![vec![0.0, 1.5, 2.0]; 2], 2));
        scene.run(4.0).go().unwrap();
        assert_eq!((scene.steps(), scene.time()), (3, 4.0));
    }
}

/// Explicit Euler, which says nothing of its errors.
#[derive(Debug)]
struct Euler;

impl Integrator for Euler {
    fn name(&self) -> &'static str {
        "Euler's method"
    }

    fn step(&mut self, system: &mut dyn Dynamics, dt: f64) -> Result<(), SceneError> {
        let mut state = Vec::new();
        system.write_state(&mut state);
        let mut rate = vec![0.0; state.len()];
        system.present_rate(&mut rate)?;
        state.iter_mut().zip(&rate).for_each(|(y, f)| *y += dt * f);
        system.read_state(&state)
    }

    fn stability_interval(&self) -> f64 {
        2.0
    }
}

#[test]
fn adaptive_steps_need_an_estimate_of_errors() {
    let mut scene = empty().advanced_by(Euler);
    let point = scene.add(drawn().with_stiffness(100.0).unwrap());
    let adaptive = StepSize::Adaptive { tolerance: 1e-4 };
    let error = scene.run(1.0).step_size(adaptive).go().unwrap_err();
    assert!(refused(&error, "the error of a step of Euler's method cannot be estimated"), "{error}");
    assert_eq!(scene.steps(), 0);
    scene.run(1.0).step_size(StepSize::OfLimit(0.5)).go().unwrap();
    assert!(scene.body(point).unwrap().markers()[0].length() < 1e-3);
    assert_eq!(scene.integrator_work(), IntegratorWork::default());
}

/// Attempts are steps, rejections for the error, and failures: here one by a velocity that is once not a number.
#[test]
fn every_attempt_is_counted() {
    let mut calls = 0;
    let motion = move |positions: &[Vec2], _: &[Vec2], rates: &mut [Vec2]| {
        calls += 1;
        let speed = 1.0 + 40.0 * (1.0 + (100.0 * (positions[0].x - 0.5)).tanh());
        rates[0] = Vec2::X * if calls == 8 { f64::NAN } else { speed };
    };
    let mut scene = empty();
    scene.add(MarkerBody::new("drifting", vec![Vec2::ZERO], |_, _| {}).with_motion(motion));
    scene.run(1.0).step_size(StepSize::Adaptive { tolerance: 1e-4 }).go().unwrap();
    let (report, attempts) = (scene.step_report(), scene.integrator_work().stages / 2);
    assert!(report.failures == 1 && report.rejections > 0, "{report:?}");
    assert_eq!(report.steps + report.rejections + report.failures, attempts, "{report:?}");
}

/// Steps of a part of the limit of stability are that part of it.
#[test]
fn steps_of_a_part_of_the_limit_are_that_part() {
    for part in [0.25, 0.5, 1.0] {
        let mut scene = empty();
        scene.add(drawn().with_stiffness(100.0).unwrap());
        let (limit, ..) = scene.stable_step().unwrap();
        scene.run(20.5 * part * limit).step_size(StepSize::OfLimit(part)).go().unwrap();
        let report = scene.step_report();
        assert!((report.longest / (part * limit) - 1.0).abs() < 1e-12, "{part}: {report:?} {limit}");
        assert_eq!(report.steps, 21);
    }
}

/// Stages of all steps are counted, and the most of one.
#[test]
fn stages_are_counted_over_all_steps() {
    let mut scene = empty().advanced_by(IntegratorKind::RungeKuttaChebyshev);
    scene.add(drawn().with_stiffness(100.0).unwrap());
    let mut stages = Vec::new();
    for k in 1..=3 {
        scene.run(0.02 * f64::from(k)).step_size(StepSize::Fixed(0.01)).go().unwrap();
        let work = scene.integrator_work();
        assert_eq!(scene.steps(), 2 * k as usize);
        stages.push((work.stages, work.most_stages));
    }
    assert!(stages.iter().enumerate().all(|(k, &(all, most))| all == 2 * (k + 1) * most && most >= 2), "{stages:?}");
}

/// A run that a flag or its number of steps stops between two checkpoints saves the state in which it stops.
#[test]
fn runs_that_are_stopped_save_a_last_checkpoint() {
    let path = std::env::temp_dir().join(format!("motile-stopped-{}.checkpoint", std::process::id()));
    let make = || {
        let mut scene = empty();
        scene.add(drawn());
        scene
    };
    let flag = AtomicBool::new(false);
    let mut raise = |system: &mut System<DragBox>| {
        flag.store(system.steps() == 3, Ordering::Relaxed);
        Ok::<_, Infallible>(())
    };
    let mut stopped = make();
    let run = stopped.run(1.0).step_size(StepSize::Fixed(0.01)).observe(Every::Steps(1), &mut raise);
    let error = run.save(100, &path, "").stop_on(&flag).go().unwrap_err();
    assert!(matches!(error, SceneError::Stopped { .. }), "{error}");
    assert_eq!(crate::checkpoint::Checkpoint::read(&path).unwrap(), stopped.checkpoint(""));
    std::fs::remove_file(&path).unwrap();

    let mut limited = make();
    let run = limited.run(1.0).step_size(StepSize::Fixed(0.01)).most_steps(5).save(100, &path, "");
    assert!(matches!(run.go(), Err(SceneError::TooManySteps { .. })));
    let saved = crate::checkpoint::Checkpoint::read(&path).unwrap();
    assert_eq!((saved.steps(), &saved), (5, &limited.checkpoint("")));
    std::fs::remove_file(&path).unwrap();
    let mut resumed = make();
    resumed.resume(&saved).unwrap();
    for scene in [&mut resumed, &mut limited] {
        scene.run(1.0).step_size(StepSize::Fixed(0.01)).go().unwrap();
    }
    assert_eq!(resumed.checkpoint(""), limited.checkpoint(""));
}

/// A run may take as many steps as are allowed, and not one more.
#[test]
fn a_run_takes_no_more_steps_than_allowed() {
    let run = |most: usize| {
        let mut scene = empty();
        scene.add(drawn());
        let outcome = scene.run(1.0).step_size(StepSize::Fixed(0.25)).most_steps(most).go();
        (outcome, scene.steps())
    };
    let (outcome, steps) = run(4);
    assert!(outcome.is_ok() && steps == 4, "{outcome:?} {steps}");
    let (outcome, steps) = run(3);
    assert!(matches!(outcome, Err(SceneError::TooManySteps { most: 3, .. })) && steps == 3, "{outcome:?} {steps}");
}

#[test]
fn a_run_cannot_end_before_the_present() {
    let mut scene = empty();
    scene.run(4.0).go().unwrap();
    let error = scene.run(1.0).go().unwrap_err().to_string();
    assert!(error.starts_with("the run is to end at 1, before the scene's time 4. Give"), "{error}");
}
