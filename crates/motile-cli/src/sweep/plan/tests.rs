use std::path::Path;

use super::*;

fn trials(text: &str) -> Result<Vec<Trial>> {
    toml::from_str::<Plan>(text)?.trials(Path::new("runs"))
}

const SCENE: &str = "[[scene.droplets]]\n";

#[test]
fn lists_zips_grids_and_seeds_multiply() {
    let plan = format!(
        "time = 2.0\nseeds = 2\n[grid]\n\"droplets.0.particles.activity\" = [-1, -2.0, -4]\n\
         viscosity = {{ from = 1, to = 100, count = 3, spacing = \"logarithmic\" }}\n\
         [zip]\n\"droplets.0.tension\" = [10.0, 20.0]\n\"droplets.0.angle\" = [0.0, 0.5]\n{SCENE}"
    );
    let trials = trials(&plan).unwrap();
    assert_eq!(trials.len(), 2 * 3 * 3 * 2);
    let first = &trials[0];
    assert_eq!(first.label, "tension=10,angle=0,activity=-1,viscosity=1,seed=1");
    assert_eq!(first.folder, Path::new("runs").join(&first.label));
    let last = &trials[35];
    let droplet = &last.setup.droplets[0];
    assert_eq!((last.setup.viscosity, droplet.tension, droplet.angle, last.time), (100.0, 20.0, 0.5, 2.0));
    assert_eq!(droplet.particles.unwrap().activity, -4.0);
    assert!(matches!(droplet.particles.unwrap().start, motile::setup::Start::Perturbed { amplitude: 0.05, seed: 2 }));
    // The logarithmic range, its middle one too.
    assert!((trials[2].setup.viscosity - 10.0).abs() < 1e-12);
    assert_eq!(last.values.len(), 5);
}

#[test]
fn lists_are_points_one_after_the_other() {
    let plan =
        format!("time = 1.0\n[[list]]\nviscosity = 5.0\n[[list]]\nviscosity = 7.0\ndroplets.0.angle = 1.0\n{SCENE}");
    let trials = trials(&plan).unwrap();
    assert_eq!(trials.iter().map(|trial| trial.setup.viscosity).collect::<Vec<_>>(), [5.0, 7.0]);
    assert_eq!(trials[1].setup.droplets[0].angle, 1.0);
    assert_eq!(trials[1].label, "viscosity=7,angle=1");
    let plan = format!("time = 1.0\n[grid]\n\"droplets.0.centre.1\" = [0.5]\n{SCENE}");
    let centre = self::trials(&plan).unwrap()[0].setup.droplets[0].centre;
    assert_eq!(centre, [0.0, 0.5]);
}

#[test]
fn what_is_no_plan_is_refused_before_any_run() {
    for (text, wanted) in [
        ("[grid]\nviscosty = [1.0]\n", "viscosty"),
        ("[grid]\nviscosity = [-1.0, \"a\"]\n", "viscosity"),
        ("[grid]\n\"droplets.3.angle\" = [1.0]\n", "droplets has 1 entries"),
        ("[grid]\n\"droplets.0.centre.2\" = [1.0]\n", "2 entries"),
        ("[grid]\nviscosity = []\n", "[] is not a range of values. Use a list"),
        ("[grid]\nviscosity = 3.0\n", "3.0 is not a range of values. Use a list"),
        ("[grid]\nviscosity = [3.0, 3.0]\n", "twice"),
        ("[grid]\nviscosity = { from = 0, to = 1, count = 3, spacing = \"logarithmic\" }\n", "neither of them 0"),
        ("[grid]\nviscosity = { from = 1, to = 2, count = 3000000000 }\n", "count"),
        ("[zip]\nviscosity = [1.0, 2.0]\n\"droplets.0.angle\" = [1.0]\n", "equally long"),
        ("seeds = 0\n", "at least one"),
        ("[gird]\nviscosity = [1.0]\n", "gird"),
    ] {
        let error = trials(&format!("time = 1.0\n{text}{SCENE}")).unwrap_err();
        assert!(format!("{error:#}").contains(wanted), "{text}: {error:#}");
    }
}
