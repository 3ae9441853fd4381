use motile::prelude::*;
use motile_output::{Look, ParaView, Raster, Snapshot, TrajectoryCsv};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::temp_dir().join("motile-guide");
    let Built { mut scene, droplets, .. } = Setup::default().build()?;
    let raster = Raster::of(scene.system(), 0.1)?;
    let mut vtk = ParaView::create(&out, raster)?;
    let mut rows = TrajectoryCsv::create(out.join("trajectory.csv"), scene.system_mut(), droplets[0])?;
    scene.run(2.0).observe(Every::Time(0.1), &mut rows).observe(Every::Time(1.0), &mut vtk).go()?;
    rows.finish(scene.system_mut())?;
    let seen = Snapshot::take(scene.system_mut(), raster)?;
    Look::default().write_picture(&seen, &[rows.track()], out.join("final.png"))?;
    println!("speed {:.4}, see {}", scene.observe(droplets[0])?.speed(), out.display());
    Ok(())
}
