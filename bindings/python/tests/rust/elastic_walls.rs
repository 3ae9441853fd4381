use motile::prelude::*;
use motile::elastic_solids::ChannelShape;
use motile::setup::{Axis, Grading, Hold, Material, SolidOutline, SolidSetup};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let soft = Material::Springs { shear: 187.5 };
    // Four times as stiff in the middle of the channel as at its ends.
    let grading = Grading::Along { axis: Axis::X, factors: vec![[-6.0, 1.0], [0.0, 4.0], [6.0, 1.0]] };
    let mut solids = SolidSetup::walls(&ChannelShape::Straight { width: 4.0 }, &soft);
    solids.iter_mut().for_each(|wall| wall.grading = grading.clone());
    solids.push(SolidSetup {
        name: "island".to_owned(),
        hold: Hold::Tethered { stiffness: 200.0 },
        ..SolidSetup::new(
            SolidOutline::Ellipse { centre: [2.5, 0.0], half_axes: [1.0, 0.5] },
            Material::NeoHookean { shear: 100.0, bulk: 200.0 },
        )
    });
    let setup = Setup {
        region: Region::Channel { length: 12.0, width: 6.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod::of_spacing(0.2)),
        droplets: vec![DropletSetup { centre: [-3.0, 0.0], ..DropletSetup::active(-4.0) }],
        solids,
        ..Setup::default()
    };
    let Built { mut scene, solids, .. } = setup.build()?;
    scene.run(0.5).go()?;
    let island = scene.observe(solids[2])?;
    println!("the island has moved by at most {:.1e}, {} steps", island.largest_displacement, scene.steps());
    Ok(())
}
