//! Your own flow: regularised stokeslets.
//!
//! `cargo run --release --example own_solver` computes the flow of a droplet in unbounded fluid as the sum of the flows
//! of blobs of the size of the marker spacing (Cortez, SIAM J. Sci. Comput. 23, 1204, 2001). A round droplet whose
//! tension is linear in the concentration has an exact speed: 0.125. The error falls to a quarter with half the
//! spacing. Droplets, solids and observers work with your flow as with any other.

use std::f64::consts::PI;

use motile::active_interface::theory::{LinearTheory, RoundDroplet};
use motile::active_interface::{ActiveDroplet, ContractileTension, Curve, ExcludedVolume, InitialConcentration};
use motile::base::{FlowSample, SolveReport};
use motile::prelude::*;
use motile::scene::{FlowError, FlowWork, FluidView, Hydrodynamics, Markers};

#[derive(Debug)]
struct RegularisedStokeslets {
    viscosity: f64,
    /// Size of the blobs.
    size: f64,
    work: FlowWork,
}

impl RegularisedStokeslets {
    fn velocity(&self, at: Vec2, positions: &[Vec2], forces: &[Vec2]) -> Vec2 {
        let flow_of = |(place, force): (&Vec2, &Vec2)| {
            let (d, e) = (at - *place, self.size);
            let r = (d.dot(d) + e * e).sqrt();
            let along = (r + 2.0 * e) / ((r + e).powi(2) * r);
            let isotropic = e * (r + 2.0 * e) / ((r + e) * r) - (r + e).ln();
            isotropic * *force + along * force.dot(d) * d
        };
        positions.iter().zip(forces).map(flow_of).sum::<Vec2>() / (4.0 * PI * self.viscosity)
    }
}

impl Hydrodynamics for RegularisedStokeslets {
    fn fluid_view(&self) -> FluidView {
        FluidView {
            domain: Region::Plane.into(),
            viscosity: self.viscosity,
            spacing: None,
            second_order: false,
            shape_modes: None,
            nodes: None,
            interface_stiffness: 0.25 * PI / self.size,
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let [positions, forces, velocities] = markers.lists_mut();
        for (velocity, at) in velocities.iter_mut().zip(&*positions) {
            *velocity = self.velocity(*at, positions, forces);
        }
        self.work.evaluations += 1;
        Ok(SolveReport::default())
    }

    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        for (sample, point) in out.iter_mut().zip(points) {
            sample.velocity = self.velocity(*point, markers.positions(), markers.forces());
        }
        Ok(())
    }

    fn work(&self) -> FlowWork {
        self.work
    }
}

/// Returns the speeds of a droplet with so many markers, at the start and after a time of 1.
fn speeds(count: usize) -> Result<[f64; 2], Box<dyn std::error::Error>> {
    let (viscosity, size) = (100.0, 2.0 * PI / count as f64);
    let mut scene = Scene::new(RegularisedStokeslets { viscosity, size, work: FlowWork::default() });
    let markers = Curve::circle(1.0)?.markers(count)?;
    let numbers = InitialConcentration::polarised(100.0, 0.0)?.particle_numbers(&markers)?;
    let law = ContractileTension::new(10.0, -1.0, ExcludedVolume::None, 1.0)?;
    let droplet = scene.add(ActiveDroplet::new(&markers, numbers, law, 0.1)?);
    let start = scene.observe(droplet)?.velocity.x;
    scene.run(1.0).go()?;
    Ok([start, scene.observe(droplet)?.velocity.x])
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let exact = LinearTheory::new(RoundDroplet {
        radius: 1.0,
        viscosity_inside: 100.0,
        viscosity_outside: 100.0,
        tension: 110.0,
        activity: -1.0,
        concentration: 100.0,
        diffusivity: 0.1,
    })?
    .swimming_speed(100.0)?;
    let [coarse, fine] = [speeds(96)?, speeds(192)?];
    println!("speed {:.5} with 96 markers, {:.5} with 192, exactly {exact:.5}", coarse[0], fine[0]);
    println!("after a time of 1: {:.5}, {:.5}", coarse[1], fine[1]);
    let fall = (coarse[0] - exact) / (fine[0] - exact);
    assert!((fall - 4.0).abs() < 0.4, "errors fall by {fall}");
    Ok(())
}
