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
