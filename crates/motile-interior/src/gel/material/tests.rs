use super::*;

/// The director relaxes by its own viscosity, and by the flow that it drives in the fluid.
#[test]
fn the_largest_diffusivity_by_hand() {
    let material = GelMaterial {
        frank: 6.0,
        bend: None,
        spontaneous_splay: 0.0,
        rotational_viscosity: 3.0,
        alignment: -1.0,
        activity: 5.0,
    };
    for (viscosity, expected) in [(1.0, 2.0 + 6.0), (4.0, 2.0 + 1.5), (100.0, 2.0 + 0.06)] {
        assert!((material.largest_diffusivity(viscosity) - expected).abs() < 1e-12);
    }
}
