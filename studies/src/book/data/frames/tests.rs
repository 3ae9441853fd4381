use super::super::Source;
use super::*;
use crate::book::Making;

#[test]
fn lines_across_a_period_begin_and_end_at_its_ends_in_both_directions() {
    for forwards in [true, false] {
        // From the middle of the period to beyond its end, as loops of a mesh go.
        let mut line: Vec<Vec2> = (0..8).map(|k| Vec2::new(f64::from(k), 0.5)).collect();
        if !forwards {
            line.reverse();
        }
        let [x, y] = across(&line, 8.0);
        assert_eq!((x.len(), y.len()), (9, 9));
        assert!(((x[8] - x[0]).abs() - 8.0).abs() < 1e-12, "{x:?}");
        let steps: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(steps.iter().all(|step| (step - steps[0]).abs() < 1e-12), "{x:?}");
    }
}

/// Shapes and speeds of a run are those at the times that were asked for, and at its end where they are later.
#[test]
fn a_run_is_kept_at_its_times() {
    let out = std::env::temp_dir().join(format!("motile-book-frames-{}", std::process::id()));
    let making = Making { quick: false, threads: 1, quiet: true, out };
    let text = "about = \"a\"\n[frames]\ntimes = [0.0, 9.0]\nevery = 0.02\nstreamlines = true\n[plan]\ntime = 0.04\n\
                [plan.scene.method.integral]\nnodes = 32\nelements = 128\n[[plan.scene.droplets]]\n\
                centre = [-3.0, 0.0]\n";
    let source: Source = toml::from_str(text).expect("a source");
    let data = source.rows("frames", &making).expect("data");
    let row = &data.rows[0];
    let list = |stem: &str| -> Vec<f64> { (0..).map_while(|k| row.get(&format!("{stem}_{k}")).copied()).collect() };
    assert_eq!(list("series_time"), [0.02, 0.04]);
    assert!(list("series_speed").iter().all(|speed| *speed > 0.05));
    let [first, last] = [list("droplet_x_0"), list("droplet_x_1")];
    assert!(list("droplet_x_2").is_empty() && first.len() == last.len());
    let middle = |list: &[f64]| {
        0.5 * (list.iter().copied().fold(f64::MAX, f64::min) + list.iter().copied().fold(f64::MIN, f64::max))
    };
    // At the left edge of the box it stays there; it has moved by less than its speed times the time.
    assert!((middle(&first) + 3.0).abs() < 2e-3 && middle(&last) > middle(&first), "{first:?}");
    assert!((list("centre_x")[0] + 3.0).abs() < 1e-9);
    // The start (2.46) is 0 at the front and 2 c0 behind.
    let concentration = list("concentration");
    let (angle, c0) = (list("angle"), 100.0);
    for (theta, c) in angle.iter().zip(&concentration) {
        assert!((c / c0 - 1.0 + theta.cos()).abs() < 0.01, "{theta}: {c}");
    }
    assert!(!list("streamlines_x_0").is_empty());
    std::fs::remove_dir_all(&making.out).expect("a directory of its own");
}
