//! A neo-Hookean strip whose upper edge forces pull up, until the strip is at rest.

use elastic_solids::mesh::{TriangleMesh, fitted_strip};
use elastic_solids::{DeformationGradient, ElasticForces, EnergyDensity, Hyperelastic, Mat2, Moduli, NeoHookean};
use elastic_solids::{Scene, Solid, SolidError, Substrate, Vec2};

/// A hyperelastic law together with given forces on the points.
#[derive(Debug)]
struct Pulled {
    elastic: Hyperelastic<NeoHookean>,
    pulls: Vec<Vec2>,
}

impl ElasticForces for Pulled {
    fn point_count(&self) -> usize {
        self.elastic.point_count()
    }

    fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError> {
        forces.iter_mut().zip(&self.pulls).for_each(|(force, pull)| *force += *pull);
        self.elastic.add_forces(positions, forces)
    }

    fn energy(&self, positions: &[Vec2]) -> Result<f64, SolidError> {
        let work: f64 = self.pulls.iter().zip(positions).map(|(pull, place)| pull.dot(*place)).sum();
        Ok(self.elastic.energy(positions)? - work)
    }

    fn stress(&self, triangle: usize, gradient: &Mat2) -> Option<Mat2> {
        self.elastic.stress(triangle, gradient)
    }

    fn stiffest(&self) -> Moduli {
        self.elastic.stiffest()
    }
}

/// Stress (force per length) that stretches the material by a factor in y alone.
fn stress(material: &NeoHookean, stretch: f64) -> Result<f64, SolidError> {
    let gradient = DeformationGradient::new(Mat2::from_rows_array(&[1.0, 0.0, 0.0, stretch]))?;
    Ok(material.stress(&gradient).to_cols_array()[3])
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let material = NeoHookean::new(1.0, 2.0)?;
    let mesh: TriangleMesh = fitted_strip(Vec2::ZERO, [1.0, 0.5], 0.1)?;
    let top = |point: &Vec2| point.y > 0.49;
    let share = 1.0 / mesh.points().iter().filter(|point| top(point)).count() as f64;
    // The forces that stretch the strip by a fifth, if its width is kept.
    let pull = Vec2::new(0.0, share * stress(&material, 1.2)?);
    let pulls = mesh.points().iter().map(|point| if top(point) { pull } else { Vec2::ZERO }).collect();
    let law = Pulled { elastic: Hyperelastic::new(&mesh, material), pulls };

    let mut scene = Scene::new(Substrate::new(0.02)?);
    let strip = scene.add(Solid::with_forces(mesh, law)?.pinned(|point| point.y < 0.01)?);
    scene.run(20.0).go()?;

    let height = scene.body(strip)?.positions().iter().map(|place| place.y).fold(0.0, f64::max);
    println!("stretched by {:.6}", height / 0.5);
    assert!((height / 0.5 - 1.2).abs() < 1e-6);
    Ok(())
}
