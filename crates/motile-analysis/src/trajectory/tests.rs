use super::*;

#[test]
fn parts() {
    let list = vec![0.0, 1.0, 2.0, 4.0];
    let whole = Trajectory::new(list.clone(), list.clone(), list.clone()).unwrap();
    assert_eq!(whole.duration(), 4.0);
    let part = whole.clone().with_lateral_velocities(list).unwrap().between(0.5, 2.0);
    assert_eq!((part.times(), part.lateral_velocities()), (&[1.0, 2.0][..], Some(&[1.0, 2.0][..])));
    assert_eq!((part.heights(), part.speeds()), (&[1.0, 2.0][..], &[1.0, 2.0][..]));
    let none = whole.between(3.0, 1.0);
    assert!(none.times().is_empty() && none.duration() == 0.0);
}

#[test]
fn bad_input_is_refused() {
    let new = |times: &[f64], heights: &[f64], speeds: &[f64]| {
        Trajectory::new(times.to_vec(), heights.to_vec(), speeds.to_vec())
    };
    let good = new(&[0.0, 1.0], &[0.0, 1.0], &[0.0, 1.0]).unwrap();
    let error = new(&[0.0, 0.0], &[0.0; 2], &[0.0; 2]).unwrap_err();
    let text = "entry 1 of the times is 0, not above the entry before it. Sort the times and remove repeated ones";
    assert!(matches!(error, AnalysisError::Refused { .. }) && error.to_string() == text, "{error}");
    assert!(new(&[0.0, 1.0], &[0.0], &[0.0; 2]).is_err() && new(&[0.0, 1.0], &[0.0; 2], &[0.0]).is_err());
    assert!(new(&[0.0, f64::NAN], &[0.0; 2], &[0.0; 2]).is_err());
    assert!(new(&[0.0, 1.0], &[0.0, f64::INFINITY], &[0.0; 2]).is_err());
    assert!(new(&[0.0, 1.0], &[0.0; 2], &[0.0, -1.0]).is_err());
    assert!(good.clone().with_lateral_velocities(vec![0.0]).is_err());
    assert!(good.with_lateral_velocities(vec![0.0, f64::NAN]).is_err());
}
