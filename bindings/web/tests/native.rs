//! Numbers of runs, printed for the comparison with those of the compiled page.

use motile::setup::Setup;
use motile_web::live::Live;
use motile_web::preset::PRESETS;

/// Steps of each scene.
const STEPS: usize = 12;

#[test]
fn numbers_of_every_preset() {
    let mut lines = Vec::new();
    for preset in PRESETS {
        let mut live = Live::new(Setup::from_toml(preset.scene).expect("a scene")).expect("a scene");
        for _ in 0..STEPS {
            live.step(None).expect("a step");
        }
        let speed = live.speed(0).expect("a flow").expect("a droplet");
        assert!(speed > 0.0, "{}", preset.name);
        lines.push(format!("{{\"name\":\"{}\",\"time\":{:?},\"speed\":{speed:?}}}", preset.name, live.time()));
    }
    if let Some(path) = std::env::var_os("MOTILE_WEB_NUMBERS") {
        std::fs::write(path, format!("[{}]", lines.join(","))).expect("a file");
    }
}
