use super::*;
use motile::Swimmer;

#[test]
fn two_droplets_are_drawn() {
    let swimmer = Swimmer { spacing: 0.25, lengths: [8.0, 4.0], offset: [-2.0, 0.0], ..Swimmer::default() };
    let mut scene = swimmer.scene().unwrap();
    scene.add(swimmer.droplet().unwrap());
    scene.add(Swimmer { offset: [2.0, 0.0], ..swimmer }.droplet().unwrap());
    let path = std::env::temp_dir().join(format!("motile-two-{}.png", std::process::id()));
    write_scene_picture(scene.system_mut(), 0.25, 100.0, "two", &path).unwrap();
    assert!(std::fs::metadata(&path).unwrap().len() > 10_000);
    assert_eq!(droplets(scene.system()).count(), 2);
    std::fs::remove_file(&path).unwrap();
}
