use super::*;

/// The method that was measured to be cheaper at an error is recommended.
#[test]
fn the_cheaper_method_is_recommended() {
    let kind = |scene, droplets, error| cheapest(scene, droplets, 0, error).unwrap().method.kind();
    let (boxes, channel) = (SceneKind::Box, SceneKind::Channel);
    for (scene, droplets, error, expected) in [
        (boxes, 1, 0.03, MethodKind::Integral),
        (boxes, 64, 0.01, MethodKind::Integral),
        (boxes, 64, 0.0025, MethodKind::Integral),
        (boxes, 64, 0.001, MethodKind::Integral),
        (boxes, 64, 0.03, MethodKind::Grid),
        (channel, 16, 0.01, MethodKind::Grid),
        (channel, 16, 0.002, MethodKind::Integral),
        (SceneKind::ViscosityContrast, 64, 0.01, MethodKind::Integral),
    ] {
        assert_eq!(kind(scene, droplets, error), expected, "{scene:?} {droplets} {error}");
    }
}
