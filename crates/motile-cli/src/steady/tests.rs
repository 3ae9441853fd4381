use super::*;

/// Keys of scene files and names stand for parameters.
#[test]
fn keys_stand_for_parameters() {
    let scene = |text: &str| Setup::from_toml(text).unwrap();
    let droplet = scene("[[droplets]]\nviscosity = 50.0\nparticles.exchange = { binding = 0.1, unbinding = 0.2 }\n");
    for (key, name) in [
        ("droplets.0.particles.activity", "activity"),
        ("droplets.0.particles.excluded-volume.step", "excluded-volume"),
        ("droplets.0.particles.diffusion", "diffusion"),
        ("droplets.0.particles.exchange.binding", "binding"),
        ("droplets.0.particles.exchange.unbinding", "unbinding"),
        ("droplets.0.tension", "tension"),
        ("droplets[0].viscosity", "viscosity-in"),
        ("viscosity", "viscosity-out"),
        ("viscosity-ratio", "viscosity-ratio"),
    ] {
        assert_eq!(parameter(&droplet, key).unwrap().name(), name, "{key}");
    }
    let region = |text: &str| scene(&format!("{text}\n[[droplets]]\n"));
    let channel = region("region.channel = { length = 12.0, width = 3.0 }");
    assert_eq!(parameter(&channel, "region.channel.width").unwrap(), Parameter::Width);
    assert_eq!(parameter(&channel, "region.channel.length").unwrap(), Parameter::Length);
    assert_eq!(parameter(&region("region.tube.radius = 2"), "region.tube.radius").unwrap(), Parameter::TubeRadius);
    let plane = region("region = \"plane\"");
    assert_eq!(parameter(&plane, "flow.shear").unwrap(), Parameter::ShearRate);
    assert_eq!(parameter(&plane, "flow.extension").unwrap(), Parameter::ExtensionRate);
    // Without a viscosity of its own the droplet's changes with that outside.
    for (key, words) in [
        ("viscosity", "cannot be followed along viscosity"),
        ("droplets.0.angle", "cannot be followed along droplets.0.angle"),
        ("droplets.0.activity", "droplets.0.particles.activity"),
    ] {
        let said = parameter(&plane, key).unwrap_err().to_string();
        assert!(said.contains(words), "{said}");
    }
}

/// The key of every parameter of a scene stands for that parameter.
#[test]
fn keys_of_parameters_stand_for_them() {
    for text in [
        "region = \"plane\"\nflow = { shear = 0.1, extension = 0.2 }\n[[droplets]]\nviscosity = 50.0\nfriction = 1.0\n\
         cortex = { viscosity = 1.0, per-concentration = 0.1 }\nparticles.exchange = { binding = 0.1, unbinding = 0.2, \
         number-inside = 10.0, diffusion-inside = 0.3 }\n",
        "region.box.lengths = [6.0, 7.0]\n[[droplets]]\nviscosity = 50.0\nparticles.excluded-volume.step-at = { \
         strength = 10.0, threshold = 200.0, steepness = 20.0 }\n[[rigid-bodies]]\nshape.round.radius = 0.2\n",
        "region.channel = { length = 12.0, width = 3.0, drive.gradient = 0.1 }\nflow.wall-velocity = [0.1, 0.2]\n\
         [[droplets]]\nviscosity = 50.0\nparticles.excluded-volume.quadratic = 0.1\n",
        "region.channel = { length = 12.0, width = 3.0, slip = [0.1, 0.2] }\n[[droplets]]\nviscosity = 50.0\n",
        "region.channel = { length = 12.0, width = 3.0, slip = 0.1 }\n[[droplets]]\nviscosity = 50.0\n",
        "region.tube = { radius = 2.0, drive.flux = 0.1 }\n[[droplets]]\nviscosity = 50.0\n\
         cortex = { viscosity = 1.0, shear-viscosity = 2.0 }\n",
        "region = \"plane\"\nflow.poiseuille = { speed = 0.1, half-width = 3.0 }\n[[droplets]]\nviscosity = 50.0\n",
    ] {
        let setup = Setup::from_toml(text).unwrap();
        let all = Parameter::independent(&setup);
        assert!(all.len() > 8, "{}", all.len());
        for known in all {
            assert_eq!(parameter(&setup, known.key(&setup)).unwrap(), known, "{}", known.key(&setup));
        }
    }
    let sticking = Setup::from_toml("region.channel = { length = 12.0, width = 3.0 }\n[[droplets]]\n").unwrap();
    assert_eq!(parameter(&sticking, "region.channel.slip").unwrap(), Parameter::Slip);
    assert_eq!(parameter(&sticking, "region.channel.slip.1").unwrap(), Parameter::UpperSlip);
}
