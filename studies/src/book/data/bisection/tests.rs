use super::*;

#[test]
fn the_boundary_of_each_point_is_found_and_runs_are_kept() {
    let out = std::env::temp_dir().join(format!("motile-book-bisection-{}", std::process::id()));
    let making = Making { quick: false, threads: 1, quiet: true, out };
    // A droplet of tension and no particles goes nowhere: its place is where it starts.
    let text = "about = \"a\"\n[bisect]\nentries = [\"droplets.0.centre.0\"]\nbetween = [0.5, 1.5]\nwithin = 0.02\n\
                outcome = \"furthest_x > viscosity / 100\"\n[plan]\ntime = 0.02\n\
                [plan.grid]\nviscosity = [80.0, 110.0, 400.0]\n\
                [plan.scene.region.channel]\nlength = 6.0\nwidth = 4.0\ndrive = \"zero-gradient\"\n\
                [plan.scene.method.integral]\nnodes = 32\nelements = 128\n\
                [[plan.scene.droplets]]\nparticles.activity = -0.1\n\
                centre = [0.0, 0.0]\n";
    let source: Source = toml::from_str(text).expect("a source");
    let data = source.rows("bisected", &making).expect("data");
    let found: Vec<f64> = data.rows.iter().map(|row| row["boundary"]).collect();
    for (found, exact) in found.iter().zip([0.8, 1.1]) {
        assert!((found - exact).abs() < 0.02 * exact, "{found}, not {exact}");
    }
    assert_eq!((found.len(), data.failures.len()), (2, 1), "{:?}", data.failures);
    assert!(data.failures[0].contains("no boundary"), "{:?}", data.failures);
    // Both ends of three points, and the middles of two.
    assert!(data.wanted > 6 + 2 * 4 && data.wanted < 6 + 2 * 8, "{}", data.wanted);
    let again = source.rows("bisected", &making).expect("data");
    assert_eq!(again.seconds, data.seconds, "the runs that are there");
    std::fs::remove_dir_all(&making.out).expect("a directory of its own");
}

#[test]
fn ends_of_each_point_move_to_the_boundary() {
    let out = std::env::temp_dir().join(format!("motile-book-ends-{}", std::process::id()));
    let making = Making { quick: false, threads: 1, quiet: true, out };
    let text = "about = \"a\"\n[bisect]\nentries = [\"droplets.0.centre.0\"]\n\
                between = [[0.55, 0.65], [1.25, 1.35], [2.0, 2.1]]\nwithin = 0.1\n\
                outcome = \"furthest_x > viscosity / 100\"\n[plan]\ntime = 0.02\n\
                [plan.grid]\nviscosity = [80.0, 112.0, 110.0]\n\
                [plan.scene.region.channel]\nlength = 6.0\nwidth = 4.0\ndrive = \"zero-gradient\"\n\
                [plan.scene.method.integral]\nnodes = 32\nelements = 128\n\
                [[plan.scene.droplets]]\nparticles.activity = -0.1\ncentre = [0.0, 0.0]\n";
    let source: Source = toml::from_str(text).expect("a source");
    let data = source.rows("ends", &making).expect("data");
    let found: Vec<f64> = data.rows.iter().map(|row| row["boundary"]).collect();
    // The third one is too far away.
    assert_eq!((found.len(), data.failures.len()), (2, 1), "{found:?}, {:?}", data.failures);
    for (found, exact) in found.iter().zip([0.8, 1.12]) {
        assert!((found - exact).abs() <= 0.051, "{found}, not {exact}");
    }
    // Two ends, and one run a move, of which there are two, two and three.
    assert_eq!(data.wanted, 4 + 4 + 5);
    std::fs::remove_dir_all(&making.out).expect("a directory of its own");
}

#[test]
fn a_run_that_fails_before_the_second_outcome_has_none() {
    let out = std::env::temp_dir().join(format!("motile-book-sides-{}", std::process::id()));
    let making = Making { quick: false, threads: 1, quiet: true, out };
    for (one_sided, boundaries) in [("", 0), ("one-sided = true\n", 1)] {
        let text = format!(
            "about = \"a\"\n[bisect]\nentries = [\"least-gap\"]\nbetween = [1.5, 0.1]\nwithin = 0.9\n\
             outcome = \"furthest_x > -1 & least_gap < 1\"\n{one_sided}[plan]\ntime = 0.02\n\
             [plan.scene.region.channel]\nlength = 6.0\nwidth = 4.0\ndrive = \"zero-gradient\"\n\
             [plan.scene.method.integral]\nnodes = 32\nelements = 128\n[[plan.scene.droplets]]\n"
        );
        let source: Source = toml::from_str(&text).expect("a source");
        let data = source.rows("sides", &making).expect("data");
        assert_eq!(data.rows.len(), boundaries, "{:?}", data.failures);
    }
    std::fs::remove_dir_all(&making.out).expect("a directory of its own");
}
