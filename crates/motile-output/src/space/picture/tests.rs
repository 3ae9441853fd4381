use motile::prelude::*;

use super::*;

/// Two swimmers: a picture with many colours and an animation of all frames.
#[test]
fn swimmers_are_drawn() {
    let droplet = |x: f64, heading: [f64; 3]| DropletSetup {
        position: Some([x, 0.0, 0.0]),
        heading: Some(heading),
        ..DropletSetup::contractile(-1.0, 2.0)
    };
    let droplets = vec![droplet(-1.3, [1.0, 0.0, 1.0]), droplet(1.3, [-1.0, 1.0, 0.0])];
    let method = Method::Harmonics(HarmonicsMethod { degree: 6 });
    let setup = Setup { region: Region::Space, method, droplets, ..Setup::default() };
    let Built { mut scene, space: Some(body), .. } = setup.build().unwrap() else { panic!("no droplets in space") };
    let folder = std::env::temp_dir().join(format!("motile-space-picture-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let look = Look { concentration: Some(100.0), width: 8.0, caption: "two".to_owned(), ..Look::of(&setup) };
    let seen = SpaceSnapshot::take(scene.system_mut(), body, 40).unwrap();
    look.write_space_picture(&seen, &[], folder.join("two.svg")).unwrap();
    let text = std::fs::read_to_string(folder.join("two.svg")).unwrap();
    assert!(text.contains("concentration c/c") && text.contains("t = 0.0   two") && text.contains("width=\"8cm\""));
    look.write_space_picture(&seen, &[vec![[0.0; 3], [0.0, 0.0, 3.0]]], folder.join("two.png")).unwrap();
    assert!(folder.join("two.png").metadata().unwrap().len() > 20_000);
    let mut film = SpaceAnimation::new(look, body);
    scene.run(0.2).observe(Every::Time(0.1), &mut film).go().unwrap();
    assert_eq!((film.frames.len(), film.tracks(0.15)[1].len(), film.begins()), (3, 2, Some(0.0)));
    film.write(folder.join("two.gif")).unwrap();
    assert!(film.write(folder.join("two.png")).is_err());
    // Without particles and flow.
    let plain = SpaceSnapshot { flow: None, ..seen };
    let look = Look { colour_bars: false, ..Look::default() };
    look.write_space_picture(&plain, &[], folder.join("plain.png")).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
}
