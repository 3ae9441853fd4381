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
