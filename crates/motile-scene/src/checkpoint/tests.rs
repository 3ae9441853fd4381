use super::*;
use crate::error::refused;
use crate::hydrodynamics::tests::DragBox;

/// The fault comes to light only after the flow has taken its state over.
#[test]
fn a_refusal_leaves_the_flow_as_it_was() {
    let mut scene = Scene::new(DragBox::new(4.0, 1.0, 0.25));
    let before = scene.checkpoint("");
    let found = SolveReport { iterations: 0, residual: 0.0, mean_pressure_gradient: [0.0; 2] };
    let other = Checkpoint {
        flow: SavedState { reals: vec![1.0; 6], counts: vec![0, 0, 0, 6] },
        known: Some((vec![[0.0; 2]], found)),
        time: 1.0,
        ..before.clone()
    };
    let error = scene.resume(&other).unwrap_err();
    assert!(refused(&error, "the checkpoint is of another scene"), "{error}");
    assert_eq!(scene.checkpoint(""), before);
}

/// A checkpoint of another version of the program, whose numbers may be others, is refused with both versions.
#[test]
fn a_checkpoint_of_another_version_is_refused() {
    let mut scene = Scene::new(DragBox::new(4.0, 1.0, 0.25));
    let saved = scene.checkpoint("");
    assert_eq!(saved.version(), crate::VERSION);
    let older = Checkpoint { version: "0.0.9+1".to_owned(), ..saved };
    let error = scene.resume(&Checkpoint::from_bytes(&older.to_bytes().unwrap()).unwrap()).unwrap_err();
    let words = format!("the checkpoint is of motile 0.0.9+1, and this is motile {}", crate::VERSION);
    assert!(refused(&error, &words), "{error}");
    // The state alone may be taken.
    scene.take_over(&older).unwrap();
}

/// Of two domains the first length that differs, with the digits that tell it.
#[test]
fn another_domain_is_told_by_a_length() {
    let of = |length: f64, walls| Domain { origin: [-0.5 * length, -2.0], periods: [Some(length), None].into(), walls };
    let told = difference(of(6.472_086_375_185_664, None), of(7.236_012_545_582_676, None));
    assert_eq!(told, "the period along x of its domain is 6.47, here 7.24");
    let told = difference(of(6.0, Some([-2.0, 2.0])), of(6.0, None));
    assert_eq!(told, "the lower wall of its domain is -2, here none");
}

#[test]
fn what_keeps_a_file_from_being_read_is_told() {
    use std::io::ErrorKind;
    let told = |kind: ErrorKind| CheckpointError::reading(std::path::Path::new("a/b"), kind.into()).to_string();
    assert_eq!(told(ErrorKind::NotFound), "there is no checkpoint at a/b. Check the path");
    assert_eq!(
        told(ErrorKind::PermissionDenied),
        "there is no permission to read the checkpoint a/b. Change its permissions"
    );
    assert!(told(ErrorKind::IsADirectory).starts_with("a/b is a directory"));
    assert!(told(ErrorKind::Other).starts_with("could not read the checkpoint a/b"));
}

/// Bodies that are the same but for the kind of their markers.
#[test]
fn markers_of_another_kind_are_those_of_another_scene() {
    let kinds = [
        MarkerKind::Points,
        MarkerKind::Rigid,
        MarkerKind::Interface { viscosity_inside: None },
        MarkerKind::Interface { viscosity_inside: Some(2.0) },
        MarkerKind::UnevenInterface { viscosity_inside: None },
        MarkerKind::UnevenInterface { viscosity_inside: Some(2.0) },
        MarkerKind::OpenInterface { viscosity_inside: None, advance: 4.0 },
        MarkerKind::OpenInterface { viscosity_inside: Some(2.0), advance: 4.0 },
    ];
    let of = |kind| {
        let mut scene = Scene::new(DragBox::new(4.0, 1.0, 0.25));
        let places = (0..16).map(|k| Vec2::new(0.25 * f64::from(k), 0.0)).collect();
        scene.add(crate::MarkerBody::new("body", places, |_, _| {}).with_kind(kind));
        scene
    };
    for saved in kinds {
        let checkpoint = of(saved).checkpoint("");
        for here in kinds {
            match of(here).compare(&checkpoint) {
                Ok(()) => assert_eq!(here, saved),
                Err(error) => {
                    assert_ne!(here, saved, "{error}");
                    assert!(error.to_string().contains("the markers of body are of another kind"), "{error}");
                }
            }
        }
    }
}

/// Numbers that are equal but for round-off, and absent ones, are the same; an absent one and a number are not.
#[test]
fn properties_are_compared_one_by_one() {
    let same = |here: f64, saved: f64| {
        let of = |value: f64| [("the size".to_owned(), value)];
        compare_properties("body", &of(here), &of(saved)).is_ok()
    };
    assert!(same(2.0, 2.0) && same(2.0, 2.0 + 1e-12) && same(f64::INFINITY, f64::INFINITY));
    assert!(same(f64::NAN, f64::NAN) && same(0.0, -0.0));
    assert!(!same(2.0, f64::NAN) && !same(f64::NAN, 2.0) && !same(2.0, 2.1) && !same(2.0, f64::INFINITY));
    let named = |name: &str| [(name.to_owned(), 1.0)];
    assert!(compare_properties("body", &named("one"), &named("other")).is_err());
    assert!(compare_properties("body", &named("one"), &[]).is_err() && compare_properties("body", &[], &[]).is_ok());
}

/// A file that goes on, or ends early, is told by its length and not by its checksum.
#[test]
fn files_of_another_length_are_told_by_it() {
    let bytes = Scene::new(DragBox::new(4.0, 1.0, 0.25)).checkpoint("").to_bytes().unwrap();
    assert!(Checkpoint::from_bytes(&bytes).is_ok());
    let longer = [&bytes[..], &[0]].concat();
    for (other, length) in [(&longer[..], bytes.len() + 1), (&bytes[..bytes.len() - 1], bytes.len() - 1)] {
        let told = Checkpoint::from_bytes(other).unwrap_err().to_string();
        assert!(told.contains(&format!("it has {length} bytes where {} are needed", bytes.len())), "{told}");
    }
    let mut damaged = bytes;
    *damaged.last_mut().unwrap() ^= 1;
    let told = Checkpoint::from_bytes(&damaged).unwrap_err().to_string();
    assert!(told.contains("the checkpoint is damaged"), "{told}");
}
