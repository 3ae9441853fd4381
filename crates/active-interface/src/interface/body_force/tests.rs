use std::f64::consts::PI;

use motile_base::{Region, Vec2};
use motile_scene::{Body, Deformation, FluidView};

use crate::{ActiveDroplet, Curve, Motion, interface::geometry::Rings};

fn view(region: Region, modes: Option<usize>) -> FluidView {
    FluidView {
        domain: region.into(),
        viscosity: 1.0,
        spacing: None,
        second_order: true,
        shape_modes: modes,
        nodes: modes,
        interface_stiffness: 1.0,
    }
}

fn forces(droplet: &mut ActiveDroplet, view: &FluidView) -> Vec<Vec2> {
    let mut forces = vec![Vec2::ZERO; droplet.markers().len()];
    droplet.write_forces(view, &mut forces).unwrap();
    forces
}

/// The forces add up to the force per area times the area, have no torque about the centroid, and none of it depends on
/// where the droplet is.
#[test]
fn forces_add_up_to_the_weight() {
    let body = Vec2::new(0.3, -2.0);
    let region = Region::Box { lengths: [6.0; 2] };
    for (modes, motion) in [(Some(64), Motion::default()), (Some(64), Motion::WithFluid), (None, Motion::default())] {
        for centre in [Vec2::ZERO, Vec2::new(3e6, -1e6)] {
            let markers = Curve::ellipse(1.3, 0.7).unwrap().rotated(0.4).translated(centre).markers(64).unwrap();
            let droplet = ActiveDroplet::passive(&markers, 0.0).unwrap().with_motion(motion);
            let mut droplet = droplet.with_body_force(body).unwrap();
            let found = forces(&mut droplet, &view(region, modes));
            let sum: Vec2 = found.iter().sum();
            let torque: f64 = found.iter().zip(&markers).map(|(f, x)| (*x - centre).perp_dot(*f)).sum();
            // Curve::markers gives the polygon the area of the curve; the smooth curve through them has another one.
            let area = if modes.is_some() && motion != Motion::WithFluid {
                Deformation::of(&markers, &[Vec2::ZERO; 64]).unwrap().area
            } else {
                PI * 1.3 * 0.7
            };
            let tolerance = if centre == Vec2::ZERO { 1e-6 } else { 1e-5 };
            assert!((sum / area - body).length() < tolerance, "{modes:?} {motion:?}: {sum} {area}");
            assert!(torque.abs() < tolerance, "{torque}");
        }
    }
}

/// A force in all has that sum, also of a body of revolution.
#[test]
fn a_force_in_all_has_its_sum() {
    let markers = Curve::ellipse(1.3, 0.7).unwrap().markers(64).unwrap();
    let region = Region::Box { lengths: [6.0; 2] };
    let total = Vec2::new(0.3, -2.0);
    for modes in [Some(64), None] {
        let mut droplet = ActiveDroplet::passive(&markers, 1.0).unwrap().with_force(total).unwrap();
        let sum: Vec2 = forces(&mut droplet, &view(region, modes)).iter().sum();
        assert!((sum - total).length() < 1e-12, "{sum}");
    }
    // The series through the curve has to resolve products of three functions.
    let errors = [64, 96, 128].map(|count| {
        let markers = Curve::ellipse(1.3, 0.7).unwrap().markers(count).unwrap();
        let droplet = ActiveDroplet::passive(&markers, 1.0).unwrap().axisymmetric().unwrap();
        assert!(droplet.clone().with_force(total).is_err());
        let mut droplet = droplet.with_force(Vec2::new(0.5, 0.0)).unwrap();
        let found = forces(&mut droplet, &view(Region::Space, Some(32)));
        let weights = Rings::quadrature(count);
        let sum: f64 = found.iter().zip(&weights).map(|(force, weight)| weight * force.x).sum();
        (2.0 * sum - 1.0).abs()
    });
    println!("{errors:?}");
    assert!(errors[1] < 0.1 * errors[0] && errors[2] < 0.1 * errors[1], "{errors:?}");
}

#[test]
fn the_plane_is_refused() {
    let markers = Curve::circle(1.0).unwrap().markers(32).unwrap();
    let mut droplet = ActiveDroplet::passive(&markers, 1.0).unwrap().with_body_force(Vec2::X).unwrap();
    let mut out = vec![Vec2::ZERO; 32];
    let error = droplet.write_forces(&view(Region::Plane, Some(32)), &mut out).unwrap_err().to_string();
    assert!(error.contains("no speed"), "{error}");
    assert!(ActiveDroplet::passive(&markers, 1.0).unwrap().with_body_force(Vec2::NAN).is_err());
}
