//! A drop without particles in a shear flow.
//!
//! `cargo run --release --example drop_in_shear` deforms a drop at a capillary number of 0.02 in unbounded fluid. In
//! two dimensions the deformation D = (L - B)/(L + B) of a drop is the capillary number, to first order and for any
//! ratio of viscosities. The next order is its square, and Newton's method finds the steady shape too.

use motile::prelude::*;
use motile::scene::integrator::IntegratorKind;
use motile_steady_states::SteadyState;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let capillary_number = 0.02;
    for ratio in [1.0, 5.0] {
        let drop = DropletSetup {
            viscosity: Some(ratio),
            area_constraint: true,
            ..DropletSetup::passive(1.0 / capillary_number)
        };
        let setup = Setup {
            region: Region::Plane,
            viscosity: 1.0,
            flow: FlowSetup { shear: 1.0, ..FlowSetup::default() },
            method: Method::Integral(IntegralMethod { nodes: 48, elements: 96 }),
            // Without particles, steps of fourth order are possible.
            integrator: IntegratorKind::RungeKutta,
            droplets: vec![drop],
            ..Setup::default()
        };
        let steady = SteadyState::find(&setup)?.deformation()?.by_moments;
        let Built { mut scene, droplets, .. } = setup.build()?;
        scene.run(2.0).go()?;
        let deformation = scene.system_mut().deformation(droplets[0])?.by_moments;
        println!("viscosity ratio {ratio}: D = {deformation:.6}, by Newton's method {steady:.6}");
        assert!((deformation / steady - 1.0).abs() < 1e-4);
        assert!((deformation / capillary_number - 1.0).abs() < 2.0 * capillary_number);
    }
    Ok(())
}
