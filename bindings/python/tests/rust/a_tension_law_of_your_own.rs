use motile::active_interface::Tension;
use motile::prelude::*;

/// gamma = gamma0 + gamma1 c / (c + c_half)
#[derive(Debug)]
struct Saturating { gamma0: f64, gamma1: f64, c_half: f64 }

impl Tension for Saturating {
    fn value(&self, c: f64) -> f64 {
        self.gamma0 + self.gamma1 * c / (c + self.c_half)
    }
    fn slope(&self, c: f64) -> f64 {
        self.gamma1 * self.c_half / (c + self.c_half).powi(2)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let setup = Setup { method: Method::Grid(GridMethod::of_spacing(0.1)), ..Setup::default() };
    let Built { mut scene, droplets, .. } = setup.build()?;
    let law = Saturating { gamma0: 10.0, gamma1: 400.0, c_half: 100.0 };
    scene.body_mut(droplets[0])?.set_tension(law);
    scene.run(2.0).go()?;
    println!("speed {:.4} after {} steps", scene.observe(droplets[0])?.speed(), scene.steps());
    println!("{:?}", scene.system_mut().warnings());
    Ok(())
}
