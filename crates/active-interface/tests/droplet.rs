//! The droplet as a body: forces, state, conservation, invariance.

#[cfg(test)]
mod tests {
    use active_interface::{ActiveDroplet, ContractileTension, Curve, ExcludedVolume, InitialConcentration, Motion};
    use ib_core::{BSpline, ImmersedBoundary};
    use motile_base::Vec2;
    use motile_scene::{Body, FluidView, Hydrodynamics, Scene};
    use proptest::prelude::*;
    use stokes_grid::{Grid, PeriodicStokes};

    fn flow(cells: usize, h: f64) -> ImmersedBoundary<PeriodicStokes, BSpline<4>> {
        let grid = Grid::periodic(cells, cells, h).unwrap();
        ImmersedBoundary::new(PeriodicStokes::new(grid, 1.0).unwrap(), BSpline::<4>)
    }

    fn fluid_view() -> FluidView {
        flow(8, 0.5).fluid_view()
    }

    /// An active droplet on an ellipse, turned and moved.
    fn active(angle: f64, centre: Vec2, motion: Motion) -> ActiveDroplet {
        let curve = Curve::ellipse(1.2, 0.9).unwrap().rotated(angle).translated(centre);
        let markers = curve.markers(96).unwrap();
        let numbers = InitialConcentration::polarised(1.0, angle).unwrap().particle_numbers(&markers).unwrap();
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        ActiveDroplet::new(&markers, numbers, law, 0.05).unwrap().with_motion(motion)
    }

    #[test]
    fn a_bound_on_changes_may_be_zero_and_not_negative() {
        let droplet = active(0.0, Vec2::ZERO, Motion::default());
        assert!(droplet.clone().with_bounds(0.0, 0.0).is_ok());
        for [area, particles] in [[-1e-9, 0.1], [0.1, -1e-9], [f64::NAN, 0.1]] {
            assert!(droplet.clone().with_bounds(area, particles).is_err());
        }
    }

    proptest! {
        // A case of the second property is a run.
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// Constant tension: the forces are minus the gradient of tension times perimeter.
        #[test]
        fn force_is_minus_the_energy_gradient(
            tension in 0.1..20.0_f64,
            bumps in prop::collection::vec(-0.08..0.08_f64, 4),
            marker in 0..40_usize,
        ) {
            let curve = Curve::fourier(1.0, &[0.0, bumps[0], bumps[1]], &[0.0, bumps[2], bumps[3]]).unwrap();
            let mut droplet = ActiveDroplet::passive(&curve.markers(40).unwrap(), tension).unwrap();
            let mut forces = vec![Vec2::ZERO; 40];
            droplet.write_forces(&fluid_view(), &mut forces).unwrap();
            let energy = |markers: &[Vec2]| tension * active_interface::polygon_perimeter(markers).unwrap();
            let step = 1e-6;
            for axis in 0..2 {
                let shifted = |by: f64| {
                    let mut markers = droplet.markers().to_vec();
                    markers[marker][axis] += by;
                    energy(&markers)
                };
                let gradient = (shifted(step) - shifted(-step)) / (2.0 * step);
                prop_assert!((forces[marker][axis] + gradient).abs() < 1e-7 * (1.0 + tension));
            }
            let total: Vec2 = forces.iter().sum();
            prop_assert!(total.length() < 1e-12 * tension);
            let torque: f64 =
                forces.iter().zip(droplet.markers()).map(|(f, x)| x.x * f.y - x.y * f.x).sum();
            prop_assert!(torque.abs() < 1e-12 * tension);
        }

        /// Moving a droplet by whole cells and by a quarter turn of the grid moves everything that happens with it.
        #[test]
        fn a_scene_does_not_know_where_it_is(cells in -20..20_i32, quarter in 0..4_u32) {
            let turn = f64::from(quarter) * std::f64::consts::FRAC_PI_2;
            let shift = Vec2::new(0.25 * f64::from(cells), -0.25 * f64::from(cells / 2));
            let run = |angle: f64, centre: Vec2| {
                let mut scene = Scene::new(flow(20, 0.25));
                let droplet = scene.add(active(angle, centre, Motion::default()));
                (0..5).for_each(|_| scene.step(0.02).unwrap());
                scene.body(droplet).unwrap().markers().to_vec()
            };
            let (here, there) = (run(0.0, Vec2::ZERO), run(turn, shift));
            let rotation = Vec2::from_angle(turn);
            for (a, b) in here.iter().zip(&there) {
                prop_assert!((rotation.rotate(*a) + shift - b).length() < 1e-11);
            }
        }
    }

    #[test]
    fn the_state_goes_out_and_in() {
        let mut droplet = active(0.3, Vec2::new(0.1, 0.2), Motion::default());
        let mut state = vec![0.0; droplet.state_len()];
        droplet.write_state(&mut state);
        let tensions = droplet.tensions().to_vec();
        state[0] += 0.01;
        droplet.read_state(&state).unwrap();
        assert_ne!(droplet.tensions(), tensions);
        state[0] -= 0.01;
        droplet.read_state(&state).unwrap();
        for (a, b) in droplet.tensions().iter().zip(&tensions) {
            assert!((a - b).abs() < 1e-12);
        }
        state[5] = f64::NAN;
        assert!(droplet.read_state(&state).is_err());
    }

    #[test]
    fn both_motions_keep_particles_and_the_constraint_keeps_area() {
        for motion in [Motion::default(), Motion::WithFluid] {
            let mut scene = Scene::new(flow(24, 0.25));
            let droplet = scene.add(active(0.0, Vec2::ZERO, motion).with_area_constraint(true));
            let before: f64 = scene.body(droplet).unwrap().particle_numbers().iter().sum();
            (0..60).for_each(|_| scene.step(0.05).unwrap());
            let body = scene.body(droplet).unwrap();
            let after: f64 = body.particle_numbers().iter().sum();
            assert!((after / before - 1.0).abs() < 1e-12);
            assert!(body.particle_numbers().iter().all(|&n| n >= 0.0));
            let area = active_interface::polygon_area(body.markers()).unwrap();
            assert!((area / body.initial_area() - 1.0).abs() < 1e-12);
            if motion == Motion::WithFluid {
                (0..300).for_each(|_| scene.step(0.05).unwrap());
                let body = scene.body(droplet).unwrap();
                assert!(body.redistributed().0 + body.redistributed().1 > 0, "markers crowd at the rear");
                let after: f64 = body.particle_numbers().iter().sum();
                assert!((after / before - 1.0).abs() < 1e-12);
            } else {
                let [max, min] = body
                    .element_lengths()
                    .iter()
                    .fold([0.0_f64, f64::INFINITY], |[max, min], &l| [max.max(l), min.min(l)]);
                assert!(max / min < 1.01, "spacing stays equal: {}", max / min);
            }
        }
    }

    #[test]
    fn the_speed_is_known_before_any_step() {
        let mut scene = Scene::new(flow(48, 0.125));
        let droplet = scene.add(active(0.0, Vec2::ZERO, Motion::default()));
        let seen = scene.observe(droplet).unwrap();
        assert!(seen.speed() > 0.01, "{}", seen.speed());
        let mut other = Scene::new(flow(48, 0.125));
        other.add(active(0.0, Vec2::ZERO, Motion::default()));
        assert!(other.observe(droplet).is_err());
    }

    #[test]
    fn wrong_droplets_are_refused() {
        let markers = Curve::circle(1.0).unwrap().markers(32).unwrap();
        let law = || ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        let numbers = vec![1.0; 32];
        assert!(ActiveDroplet::new(&markers, numbers.clone(), law(), 0.1).is_ok());
        assert!(ActiveDroplet::new(&markers[..7], vec![1.0; 7], law(), 0.1).is_err());
        assert!(ActiveDroplet::new(&markers, vec![1.0; 31], law(), 0.1).is_err());
        assert!(ActiveDroplet::new(&markers, numbers.clone(), law(), -0.1).is_err());
        assert!(ActiveDroplet::new(&markers, numbers.clone(), law(), f64::NAN).is_err());
        let mut negative = numbers.clone();
        negative[3] = -1.0;
        assert!(ActiveDroplet::new(&markers, negative, law(), 0.1).is_err());
        let mut crossed = markers.clone();
        crossed.swap(3, 20);
        assert!(ActiveDroplet::new(&crossed, numbers.clone(), law(), 0.1).is_err());
        let mut infinite = markers.clone();
        infinite[5].x = f64::INFINITY;
        assert!(ActiveDroplet::new(&infinite, numbers, law(), 0.1).is_err());
        assert!(ActiveDroplet::passive(&markers, -1.0).is_err());
        let droplet = ActiveDroplet::passive(&markers, 1.0).unwrap();
        assert!(droplet.with_viscosity_inside(0.0).is_err());
    }
}
